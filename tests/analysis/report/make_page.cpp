// Writes a report of a synthetic dig: make_page FILE.html SPHERES FRAMES SECONDS
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "analysis/report/report_page.hpp"
#include "common/mesh/solids.hpp"
#include "tests/analysis/report/synthetic_dig.hpp"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: make_page FILE.html SPHERES FRAMES SECONDS\n";
    return 2;
  }
  using namespace dipper;
  using namespace dipper::analysis::report;
  const double T = std::atof(argv[4]);
  const test::SyntheticDig dig(static_cast<std::size_t>(std::atol(argv[2])),
                               static_cast<std::size_t>(std::atol(argv[3])), T);
  ReportInput input;
  input.replay = &dig;
  // A house that stands, a handle on the dipper, and a rope from one to the other.
  input.figure.bodies = {
      {"house", {{"house", mesh::block({-8, -2, 0}, {-4, 2, 5})}}, [](double) { return Pose{}; }},
      {"handle", {{"handle", mesh::block({-9, -0.5, 1.5}, {1, 0.5, 2.5})}}, [&](double t) {
         return dig.dipper(t).X_WB;
       }}};
  input.figure.ropes = {{0.1, [&](double t) -> std::vector<Vector3d> {
                           return {{-5, 0, 5}, {0, 0, 15}, dig.dipper(t).X_WB.p};
                         }}};
  ReportCurve hoist{"machine/hoist_force", "N", {}}, crowd{"machine/crowd_force", "N", {}},
      dig_force{"dig_force", "N", {}}, load{"rock/mass_in_dipper", "kg", {}};
  for (int i = 0; i <= 5000; ++i) {
    const double t = T * i / 5000;
    input.time_s.push_back(t);
    hoist.values.push_back(1e6 * (1 + std::sin(40 * t / T)) * std::sin(M_PI * t / T));
    crowd.values.push_back(4e5 * std::cos(23 * t / T));
    dig_force.values.push_back(std::hypot(hoist.values.back(), crowd.values.back()));
    load.values.push_back(66e3 * t / T);
  }
  input.curves = {hoist, crowd, dig_force, load};
  input.case_text = "title=\"A synthetic dig\"\nrock.density_kg_m3=3215\n";
  input.metrics = {{"run", {{"operator", {{"passes", 1}}}}},  // of an operator who plans
                   {"sizes", {{{"class", 2}, {"name", "d200"}, {"size_m", 1.25}}}},
                   {"stages", {{{"stage", 1}, {"t_s", 0.2 * T}}, {{"stage", 2}, {"t_s", 0.6 * T}}}},
                   {"passes",
                    {{{"pass", 1},
                      {"t_start_s", 0},
                      {"t_dig_s", 0.3 * T},
                      {"t_end_s", 0.8 * T},
                      {"dig_force_peak_N", 9e6},
                      {"payload_ways", {{"inside_kg", 50e3}, {"truck_kg", 49e3}}}},
                     {{"pass", 2},
                      {"t_start_s", 0.8 * T},
                      {"t_end_s", T},
                      {"payload_ways", {{"inside_kg", 16e3}, {"truck_kg", 16e3}}}}}},
                   {"phases",
                    {{{"phase", "reach"}, {"t_start_s", 0}, {"t_end_s", 0.2 * T}},
                     {{"phase", "fill"}, {"t_start_s", 0.2 * T}, {"t_end_s", T}}}}};
  write_report_page("A synthetic dig", input, argv[1]);
}

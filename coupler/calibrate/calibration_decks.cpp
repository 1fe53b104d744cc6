#include "coupler/calibrate/calibration_decks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "analysis/io/dump_reader.hpp"
#include "analysis/rock/solid_mass.hpp"
#include "common/angles.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/sphere_fit.hpp"

namespace dipper::calibrate {
namespace fs = std::filesystem;
namespace {

// The same values as in the decks.
constexpr double kSheetAngle_deg = 80;
constexpr double kFlattest_deg = 28;
constexpr double kPouredFraction = 0.30;
constexpr double kBoxPour = 2.5;  // height of the pour in edges

struct Row {
  int type = 0;
  long body = -1;
  Sphere ball;
};

std::vector<Row> read_rows(const fs::path& dump) {
  const analysis::io::DumpReader reader({dump});
  std::vector<Row> rows;
  analysis::io::DumpReader::read(reader.frames().back(),
                                 {"type", "id_multisphere", "x", "y", "z", "radius"},
                                 [&](const analysis::io::ParticleChunk& chunk) {
                                   const auto& v = chunk.columns;
                                   for (std::size_t i = 0; i < chunk.rows; ++i)
                                     rows.push_back({static_cast<int>(v[0][i]),
                                                     std::lround(v[1][i]),
                                                     {{v[2][i], v[3][i], v[4][i]}, v[5][i]}});
                                 });
  return rows;
}

std::string number(double v) { return fmt::format("{:.9g}", v); }

}  // namespace

double largest_rock(const cases::Case& c) {
  double largest = 0;
  for (const deck::RockClass& k : deck::rock_classes(c))
    largest = std::max(largest, 2 * k.radius_m);
  return largest;
}

PileRig pile_rig(const cases::Case& c, double size_m) {
  const double d = largest_rock(c);
  const double size = size_m > 0 ? size_m : kPileSize * d;
  return {size, 4 * d, std::max(size, 3.5 * d)};
}

double poured_mass(const cases::Case& c, const PileRig& rig) {
  const double slope = std::tan(radians(kFlattest_deg));
  const double section = rig.size_m * rig.size_m / 2 / slope + rig.depth_m * rig.size_m;
  return kPouredFraction * deck::laden_density(c) * 2 * section * rig.width_m;
}

double poured_mass(const cases::Case& c, const BoxRig& rig) {
  return kPouredFraction * deck::laden_density(c) * kBoxPour * std::pow(rig.edge_m, 3);
}

std::vector<double> poured_rocks(const cases::Case& c, double mass_kg) {
  const std::vector<deck::RockClass> classes = deck::rock_classes(c);
  std::vector<double> out;
  for (std::size_t i = 0; i < classes.size(); ++i)
    out.push_back(mass_kg * c.rock.classes[i].mass_percent / 100 / classes[i].mass_kg);
  return out;
}

DeckRun pile_run(const cases::Case& c, const PileRig& rig) {
  return {"calibrate_pile",
          "pile.dump",
          c,
          {{"size", number(rig.size_m)},
           {"width", number(rig.width_m)},
           {"depth", number(rig.depth_m)},
           {"sheet_angle", number(kSheetAngle_deg)},
           {"flattest", number(kFlattest_deg)}}};
}

DeckRun box_run(const cases::Case& c, const BoxRig& rig) {
  return {"calibrate_box", "box.dump", c, {{"edge", number(rig.edge_m)}}};
}

analysis::rock::PileAngle measure_pile(const fs::path& dump, const PileRig& rig) {
  // Rock that still leans on the back of the sheet does not belong to the flank.
  const double a = radians(kSheetAngle_deg);
  std::vector<Sphere> balls;
  for (const Row& row : read_rows(dump)) {
    const Eigen::Vector3d& p = row.ball.centre_m;
    if (p.x() * std::sin(a) + (p.z() - rig.size_m) * std::cos(a) < 0) balls.push_back(row.ball);
  }
  analysis::rock::PileAngleOptions options;
  options.x_max_m = 0;
  try {
    return analysis::rock::pile_angle(balls, options);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(fmt::format("{}: {}; take a larger --size", dump.string(), e.what()));
  }
}

BulkDensity measure_box(const cases::Case& c, const fs::path& dump, const BoxRig& rig) {
  const std::vector<deck::RockClass> classes = deck::rock_classes(c);
  const std::vector<Row> rows = read_rows(dump);
  std::map<long, std::vector<Sphere>> bodies;
  double smallest = largest_rock(c);
  for (const Row& row : rows) {
    smallest = std::min(smallest, row.ball.radius_m);
    if (row.body >= 0) bodies[row.body].push_back({row.ball.centre_m, row.ball.radius_m});
  }
  std::map<long, double> volume;
  constexpr int kCells = 60;  // across a rock: gives the volume of its spheres within about 0.1 %
  for (const auto& [body, spheres] : bodies) volume[body] = deck::union_volume(spheres, kCells);
  std::vector<Sphere> balls;
  std::vector<double> density;
  for (const Row& row : rows) {
    const deck::RockClass& k = classes.at(static_cast<std::size_t>(row.type - 1));
    const double r = row.ball.radius_m;
    balls.push_back(row.ball);
    density.push_back(k.mass_kg /
                      (row.body >= 0 ? volume.at(row.body) : 4.0 / 3.0 * M_PI * r * r * r));
  }
  const double half = rig.edge_m / 2, d = largest_rock(c), cell = smallest / 5;
  const Box box{{-half, -half, 0}, {half, half, rig.edge_m}};
  const Box interior = {{d - half, d - half, d}, {half - d, half - d, rig.edge_m}};
  return {analysis::rock::mass_inside(balls, density, box, cell) / box.sides_m().prod(),
          analysis::rock::mass_inside(balls, density, interior, cell) / interior.sides_m().prod()};
}

}  // namespace dipper::calibrate

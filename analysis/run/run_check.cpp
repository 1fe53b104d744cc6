#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::run {
namespace {

constexpr double kMassShare = 2e-3;  // six digits a radius, thousands of spheres
constexpr double kWall_m = 0.01;     // six digits a coordinate, tens of metres

[[noreturn]] void another(const std::filesystem::path& file, long line, const std::string& what) {
  throw io::input_error(file, line, what + ": a dump of another run?");
}

/// "[a, b, c]" of case.txt.
bool numbers(std::string text, Eigen::Vector3d& v) {
  for (char& c : text)
    if (c == '[' || c == ']' || c == ',') c = ' ';
  std::string_view words = text;
  for (int k = 0; k < 3; ++k)
    if (!parse_number(io::take_word(words), v[k])) return false;
  return true;
}

int class_count(const RunData& run) {
  int n = 0;
  while (run.case_lines.find(fmt::format("rock.classes.{}.name", n)) != nullptr) ++n;
  return n;
}

double at_time(const RunSignals& s, const std::vector<double>& values, double t) {
  const auto& time = s.pass.time_s;
  const auto after = std::lower_bound(time.begin(), time.end(), t - 1e-9);
  return values[std::min(static_cast<std::size_t>(after - time.begin()), values.size() - 1)];
}

void check_frame(const RunData& run, const io::DumpFrame& frame, double t) {
  double mass = 0;
  const int classes = class_count(run);
  rock::for_each_fragment(frame, run.clumps, [&](const rock::Fragment& r) {
    if (classes > 0 && (r.type < 1 || r.type > classes))
      another(frame.file, frame.line,
              fmt::format("a rock of type {}, but the case has {} classes", r.type, classes));
    mass += r.mass_kg;
  });
  const double recorded = at_time(run.signals, run.signals.rock_kg, t);
  if (std::abs(mass - recorded) > kMassShare * recorded)
    another(frame.file, frame.line,
            fmt::format("{:.1f} t of rock at {:.4g} s, but the record has {:.1f} t", mass / 1e3, t,
                        recorded / 1e3));
}

/// The middle of the wall's corners, in its own frame, is the mesh's.
void check_wall(const RunData& run, const std::string& name, const std::filesystem::path& file,
                double t) {
  const auto middle = [](const mesh::TriangleMesh& m) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < m.triangles.size(); ++i)
      for (const auto& c : m.corners(i)) sum += c;
    return Eigen::Vector3d(sum / static_cast<double>(3 * m.triangles.size()));
  };
  const mesh::TriangleMesh& mesh = run.meshes.at(name);
  const io::WallDump dump = io::read_wall_dump(io::index_vtk(file));
  if (dump.mesh.triangles.size() != mesh.triangles.size())
    another(file, 5,
            fmt::format("{} triangles, but the mesh of {} has {}", dump.mesh.triangles.size(), name,
                        mesh.triangles.size()));
  const Pose X_WB = run.signals.walls.at(name).at(t).X_WB;
  const double off = (middle(dump.mesh) - X_WB * middle(mesh)).norm();
  if (off > kWall_m)
    another(file, 5,
            fmt::format("{} is {:.3g} m from where the record has it at {:.4g} s", name, off, t));
}

}  // namespace

void check_dumps_are_of(const RunData& run, const io::DumpFolder& dumps) {
  Eigen::Vector3d low, high;
  const auto value = [&](const char* key) {
    const CaseLine* line = run.case_lines.find(key);
    return line == nullptr ? std::string() : line->value;
  };
  const bool has_domain =
      numbers(value("domain.min_m"), low) && numbers(value("domain.max_m"), high);
  for (const io::DumpFrame& f : dumps.frames) {
    if (!has_domain || !f.box) continue;
    if ((f.box->min_m - low).norm() > 1e-3 || (f.box->max_m - high).norm() > 1e-3)
      another(f.file, f.line - 3,
              fmt::format("the box {:.4g} ... {:.4g} m along x is not the case's domain, {:.4g} "
                          "... {:.4g}",
                          f.box->min_m.x(), f.box->max_m.x(), low.x(), high.x()));
  }
  for (const std::size_t k : {std::size_t{0}, dumps.frames.size() - 1}) {
    const double t = dumps.time_s[k];
    check_frame(run, dumps.frames[k], t);
    for (const auto& [name, files] : dumps.walls) {
      const auto file = files.find(dumps.frames[k].step);
      if (file == files.end() || run.signals.walls.count(name) == 0) continue;
      if (run.meshes.count(name) != 0) check_wall(run, name, file->second, t);
    }
  }
  const double end_s = run.signals.pass.time_s.back();
  if (dumps.time_s.back() > end_s + dumps.timestep_s)
    another(
        dumps.frames.back().file, 2,
        fmt::format("is of {:.4g} s, but the record ends at {:.4g} s", dumps.time_s.back(), end_s));
}

}  // namespace dipper::analysis::run

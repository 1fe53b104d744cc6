#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"
#include "analysis/run/run_folder.hpp"
#include "common/box.hpp"
#include "common/input_error.hpp"
#include "common/manifest.hpp"

namespace dipper::analysis::run {
namespace {

constexpr double kMassShare = 2e-3;  // six digits a radius, thousands of spheres
constexpr double kWall_m = 0.01;     // six digits a coordinate, tens of metres

// Of what is no run's, where only a wrong unit or origin explains it.
constexpr double kOtherUnit = 3;    // a mesh so many times as long as the dumps' box
constexpr double kFarOff = 5;       // a dipper so many times the box's length from the rock
constexpr double kOtherTime = 100;  // poses so many times as long as the dumps: in ms
constexpr double kHeld = 0.1;       // of the time between two frames, by which poses may end early

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

/// Times of a dipper that moves: before its first pose and after its last one it would stand still.
void check_times(const rock::PoseTrack& dipper, const std::vector<double>& time_s,
                 const std::filesystem::path& poses) {
  const double covered_s = dipper.end_s() - dipper.start_s();
  const double dumped_s = time_s.back() - time_s.front();
  if (covered_s == 0) return;  // one row: a dipper at rest
  const double intervals = std::max(1.0, static_cast<double>(time_s.size()) - 1);
  const double early_s = kHeld * dumped_s / intervals;
  const bool in_ms = dumped_s > 0 && covered_s > kOtherTime * dumped_s;
  if (!in_ms && dipper.start_s() <= time_s.front() + early_s &&
      dipper.end_s() >= time_s.back() - early_s)
    return;
  throw io::input_error(
      poses, 0,
      fmt::format("time_s: the poses cover {:.6g} to {:.6g} s, the frames {:.6g} to {:.6g} s; {}",
                  dipper.start_s(), dipper.end_s(), time_s.front(), time_s.back(),
                  in_ms ? "in ms, perhaps? write them in s"
                        : "write poses from the first frame to the last, in the dumps' own time"));
}

/// All rock of the first frame and the last one.
Box box_of_rock(const RunData& run, const io::DumpFolder& dumps) {
  Box rock;
  for (const std::size_t k : {std::size_t{0}, dumps.frames.size() - 1})
    rock::for_each_fragment(dumps.frames[k], run.clumps,
                            [&](const rock::Fragment& r) { rock.add(r.p_W); });
  return rock;
}

double longest_m(const Box& box) { return box.sides_m().maxCoeff(); }

Box placed(const Box& box, const Pose& X_WB) {
  Box out;
  for (int k = 0; k < Box::kCorners; ++k) out.add(X_WB * box.corner(k));
  return out;
}

}  // namespace

std::vector<Finding> check_dipper_is_among(const RunData& run, const io::DumpFolder& dumps,
                                           const ForeignDipper& given) {
  check_times(run.dipper, dumps.time_s, given.poses);
  const Box rock = box_of_rock(run, dumps);
  if (rock.is_empty()) return {};
  Box room = rock;
  for (const io::DumpFrame& f : dumps.frames) {
    if (!f.box) continue;
    room.add(f.box->min_m);
    room.add(f.box->max_m);
  }
  const Box mesh = mesh::bounding_box(run.vessel);
  const double mesh_m = longest_m(mesh), rock_m = longest_m(rock), room_m = longest_m(room);
  if (mesh_m > kOtherUnit * room_m)
    throw io::input_error(
        given.mesh, 0,
        fmt::format("is {:.4g} m long, and the box of the dumps {:.4g} m: in mm or cm, perhaps? "
                    "scale it to m",
                    mesh_m, room_m));
  double nearest_m = INFINITY, farthest_m = 0;
  for (const double t : dumps.time_s) {
    const double d = placed(mesh, run.dipper.at(t).X_WB).distance_m(rock);
    nearest_m = std::min(nearest_m, d);
    farthest_m = std::max(farthest_m, d);
  }
  // A dipper on its way to the rock or from it may not touch it, but it is about as near as long.
  if (nearest_m > std::max(mesh_m, rock_m) || farthest_m > kFarOff * room_m)
    throw io::input_error(
        given.poses, 0,
        fmt::format("x_m,y_m,z_m: they put the dipper {:.3g} to {:.3g} m from the rock, which is "
                    "{:.3g} m long: write them in m, from the dumps' own origin",
                    nearest_m, farthest_m, rock_m));
  if (mesh_m <= rock_m) return {};
  return {{given.mesh, 0, "",
           fmt::format("is {:.3g} m long, and all the rock {:.3g} m: in ft, perhaps?", mesh_m,
                       rock_m)}};
}

void keep_recorded(const RunData& run, io::DumpFolder& dumps) {
  if (std::filesystem::exists(run.folder / kManifest)) return;
  const double end_s = run.signals.pass.time_s.back() + dumps.timestep_s;
  for (; dumps.frames.size() > 1 && dumps.time_s.back() > end_s; dumps.time_s.pop_back())
    dumps.frames.pop_back();
}

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

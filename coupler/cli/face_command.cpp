#include "coupler/cli/face_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "analysis/io/dump_folder.hpp"
#include "analysis/metrics/pile_surface.hpp"
#include "common/angles.hpp"
#include "common/box.hpp"
#include "common/case_lines.hpp"
#include "common/height_map.hpp"
#include "common/input_error.hpp"
#include "common/json_text.hpp"
#include "common/json_values.hpp"
#include "common/text_file.hpp"
#include "coupler/cli/number_option.hpp"
#include "coupler/cli/output_file.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

struct FaceOptions {
  std::string run, out;
  std::optional<double> at_s;
  double heading_deg = 0;
};

constexpr double kHalfWidth_m = 2;  // of the rock along the boom: as wide as a dipper

/// As an operator sees it (common/height_map.hpp): x out from the swing axis, z over the ground.
/// Throws std::invalid_argument when there is no rock there.
std::vector<Eigen::Vector2d> face_along(const analysis::io::DumpFrame& frame, const Pose& X_WBoom) {
  constexpr double kFar_m = 1e6;
  const Box near{{0, -kHalfWidth_m - 1, -kFar_m}, {kFar_m, kHalfWidth_m + 1, kFar_m}};
  const std::vector<Sphere> balls = analysis::metrics::balls_in(frame, near, X_WBoom);
  if (balls.empty()) throw std::invalid_argument("there is no rock along the boom");
  Box all;
  for (const Sphere& b : balls) all.add(b.centre_m, b.radius_m);
  HeightMap map(face_grid(all.min_m.x(), all.max_m.x(), all.min_m.y(), all.max_m.y()));
  for (const Sphere& b : balls) map.add_ball(b.centre_m, b.radius_m);
  return map.profile(Pose{}, kHalfWidth_m);
}

/// The nearest frame, if the time is at most one interval of the dumps before or after them all.
std::size_t frame_at(const analysis::io::DumpFolder& dumps, double at_s) {
  constexpr double kShown_s = 0.01;  // a frame's time is shown so
  const auto& time_s = dumps.time_s;
  const double first_s = time_s.front(), last_s = time_s.back();
  const double interval_s =
      (last_s - first_s) / std::max(1.0, static_cast<double>(time_s.size()) - 1);
  if (std::max(first_s - at_s, at_s - last_s) > std::max(interval_s, kShown_s))
    throw InputError({{dumps.folder, 0, "--at",
                       fmt::format("there is no frame near {:g} s; {} are from {:.2f} to {:.2f} s",
                                   at_s, time_s.size(), first_s, last_s)}});
  return dumps.nearest(at_s);
}

int face_command(const FaceOptions& o, Reporter& reporter) {
  if (!o.out.empty()) require_output(o.out, "--out", {});
  const analysis::io::DumpFolder dumps = analysis::io::open_dump_folder(o.run);
  const std::size_t frame = frame_at(dumps, o.at_s.value_or(dumps.time_s.back()));
  const CaseLines text = CaseLines::read(fs::path(o.run) / "case.txt");
  Pose X_WBoom;
  X_WBoom.R = from_rotation_vector({0, 0, radians(o.heading_deg)});
  if (const CaseLine* base = text.find("machine.base_position_m")) {
    const Vector3d p_WH = vector_from(parse_json(base->value));
    X_WBoom.p = {p_WH.x(), p_WH.y(), 0};
  }
  const auto face = face_along(dumps.frames[frame], X_WBoom);
  std::string csv = fmt::format(
      "# {} at {:.2f} s: rock along the boom at {:g} deg, x from the swing axis, by dipper face\n"
      "x_m,z_m\n",
      fs::path(o.run).lexically_normal().filename().string(), dumps.time_s[frame], o.heading_deg);
  for (const auto& p : face) csv += fmt::format("{:.2f},{:.2f}\n", p.x(), p.y());
  if (o.out.empty()) {
    reporter.line(csv);
    return 0;
  }
  write_text(o.out, csv);
  return 0;
}

}  // namespace

Command add_face_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<FaceOptions>();
  auto* sub =
      app.add_subcommand("face", "the face that a run leaves, as a CSV for planning the next pass");
  sub->footer(
      "The surface of the rock along the boom at a time, for a cut in plan.yaml (docs/motion.md). "
      "Example:\n  dipper face runs/three --at 46 --out cases/mine/face_2.csv");
  sub->add_option("DIR", o->run, "a run's folder")->required();
  sub->add_option("--at", o->at_s, "time in s (default: the last frame)")
      ->check(number_in({0, 1e5}));
  sub->add_option("--heading", o->heading_deg, "heading of the boom in deg (default: 0)")
      ->check(number_in({-360, 360}));
  sub->add_option("--out", o->out, "the file (default: standard output)");
  return {sub, [o, &reporter] {
            try {
              return face_command(*o, reporter);
            } catch (const InputError& e) {
              reporter.error(e.what());
            } catch (const std::invalid_argument& e) {
              reporter.error(o->run + ": " + e.what());
            }
            return 2;
          }};
}

}  // namespace dipper::cli

#include "analysis/report/report_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/report/page.hpp"
#include "analysis/report/replay_json.hpp"
#include "analysis/report/slice.hpp"
#include "analysis/report/thin_curve.hpp"
#include "common/text_file.hpp"

namespace dipper::analysis::report {
namespace {

using json = nlohmann::json;

constexpr std::size_t kBins = 1500;  // two points a bin: more than a curve is wide on most screens

json round_to(const std::vector<double>& values, int digits) {
  json out = json::array();
  for (const double v : values) {
    // Through text: the shortest number that has these digits.
    out.push_back(std::isfinite(v) ? json(std::stod(fmt::format("{:.{}g}", v, digits))) : json());
  }
  return out;
}

json to_json(const Slice& s) {
  json out = {{"time_s", s.time_s}, {"spheres", json::array()}, {"walls", json::array()}};
  for (const auto& p : s.spheres) {
    out["spheres"].push_back(round_to({p.out, p.up, p.radius, p.relative_speed, p.p_B.x(),
                                       p.p_B.y(), p.p_B.z(), static_cast<double>(p.rock)},
                                      4));
  }
  for (const auto& w : s.walls) {
    out["walls"].push_back(round_to({w.from[0], w.from[1], w.to[0], w.to[1]}, 4));
  }
  return out;
}

/// A slice for each of metrics["stages"], from the frame next to it.
json slices(const ReportInput& input) {
  json out = json::array();
  const auto stages = input.metrics.find("stages");
  if (!input.replay || stages == input.metrics.end() || !stages->is_array()) return out;
  const auto& walls = input.replay->walls();
  const auto& times = input.replay->times_s();
  std::size_t dipper = 0;
  while (dipper < walls.size() && walls[dipper].name != "dipper") ++dipper;
  if (dipper == walls.size() || times.empty()) return out;
  ReplayFrame frame;
  for (const auto& stage : *stages) {
    const double t = stage.at("t_s").get<double>();
    const auto nearest = std::min_element(times.begin(), times.end(), [t](double a, double b) {
      return std::abs(a - t) < std::abs(b - t);
    });
    std::optional<SlicePlane> plane;
    input.replay->read(static_cast<std::size_t>(nearest - times.begin()), frame,
                       [&](const ReplaySphere& s) {
                         if (!plane) plane.emplace(frame.walls.at(dipper), walls[dipper].mesh);
                         return plane->holds(s);
                       });
    json s = to_json(slice(frame, walls, dipper));
    s["stage"] = stage;
    out.push_back(std::move(s));
  }
  return out;
}

}  // namespace

json curves_json(const ReportInput& input) {
  json out = {{"time_s", round_to(thin_times(input.time_s, kBins), 7)},
              {"channels", json::object()}};
  for (const auto& c : input.curves) {
    if (c.values.size() != input.time_s.size()) {
      throw std::invalid_argument("report: " + c.name + " has " + std::to_string(c.values.size()) +
                                  " values for " + std::to_string(input.time_s.size()) + " times");
    }
    out["channels"][c.name] = {{"unit", c.unit},
                               {"values", round_to(thin_values(c.values, kBins), 5)}};
  }
  return out;
}

std::string report_page(const std::string& title, const ReportInput& input,
                        const ReplayLimits& limits) {
  json data = {{"kind", "run"},
               {"title", title},
               {"metrics", input.metrics},
               {"case_text", input.case_text},
               {"curves", curves_json(input)},
               {"slices", slices(input)}};
  if (!input.decisions.is_null()) data["operator"] = input.decisions;
  std::vector<std::vector<std::uint8_t>> blocks;
  if (input.replay && !input.replay->times_s().empty()) {
    auto replay = encode_replay(*input.replay, limits);
    data["replay"] = std::move(replay.head);
    data["replay"]["figure"] = json_of_figure(input.figure, data["replay"]["times_s"]);
    blocks = std::move(replay.blocks);
  }
  return page(data, blocks);
}

void write_report_page(const std::string& title, const ReportInput& input,
                       const std::filesystem::path& file) {
  write_text(file, report_page(title, input));
}

}  // namespace dipper::analysis::report

#include "analysis/report/report_page.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "analysis/report/packing.hpp"
#include "analysis/report/slice.hpp"
#include "analysis/report/thin_curve.hpp"
#include "analysis/report/web_bundle.hpp"

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

json curves(const ReportInput& input) {
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

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

std::string report_page(const std::string& title, const ReportInput& input,
                        const ReplayLimits& limits) {
  json head = {{"title", title},
               {"metrics", input.metrics},
               {"case_text", input.case_text},
               {"curves", curves(input)},
               {"slices", slices(input)}};
  std::vector<std::vector<std::uint8_t>> blocks;
  if (input.replay && !input.replay->times_s().empty()) {
    auto replay = encode_replay(*input.replay, limits);
    head["replay"] = std::move(replay.head);
    blocks = std::move(replay.blocks);
  }
  // Names may hold bytes that are no UTF-8; the page shows a mark in their place.
  const std::string text = head.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{} – Dipper</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>",
      html_text(title));
  page += kReportStyle;
  page +=
      "</style>\n</head>\n<body>\n<noscript>This report draws itself with JavaScript, which is "
      "off here. Its numbers are in metrics.json beside it.</noscript>\n<main "
      "id=\"report\"></main>\n";
  const auto add = [&page](const std::string& kind, const std::vector<std::uint8_t>& bytes) {
    page += "<script type=\"text/plain\" data-" + kind + ">" + base64(bytes) + "</script>\n";
  };
  add("head", gzip(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  for (const auto& block : blocks) add("frames", block);
  page += "<script>";
  page += kReportScript;
  page += "</script>\n</body>\n</html>\n";
  return page;
}

void write_report_page(const std::string& title, const ReportInput& input,
                       const std::filesystem::path& file) {
  const std::string page = report_page(title, input);
  std::filesystem::path part = file;
  part += fmt::format(".part{}", getpid());
  std::ofstream out(part, std::ios::binary);
  out << page;
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(part, file, failed);
  if (!out || failed) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(file.string() +
                             ": cannot be written; is the disk full, or the folder "
                             "not yours?");
  }
}

}  // namespace dipper::analysis::report

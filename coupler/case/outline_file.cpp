#include "coupler/case/outline_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "common/input_error.hpp"

namespace dipper::cases {

double outline_height(const BenchOutline& outline, double x_m) {
  if (outline.empty() || x_m < outline.front().x()) return 0;
  const auto after =
      std::find_if(outline.begin(), outline.end(), [&](const auto& p) { return p.x() > x_m; });
  if (after == outline.end()) return outline.back().y();
  const auto& a = *(after - 1);
  return a.y() + (after->y() - a.y()) * (x_m - a.x()) / (after->x() - a.x());
}

BenchOutline read_outline(const std::filesystem::path& file, std::vector<int>* lines) {
  std::ifstream in(file);
  if (!in) throw InputError({file.string() + ": cannot be opened"});
  std::vector<std::string> faults;
  int at = 0;
  const auto fault = [&](const std::string& what) {
    faults.push_back(fmt::format("{}:{}: {}", file.string(), at, what));
  };
  BenchOutline outline;
  bool header = false;
  for (std::string line; std::getline(in, line);) {
    ++at;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    if (!header) {
      header = true;
      if (line == "x_m,z_m") continue;
      fault(fmt::format("header is \"{}\"; it must be \"x_m,z_m\"", line));
      break;
    }
    std::istringstream words(line);
    Eigen::Vector2d p;
    char comma = 0;
    if (!(words >> p.x() >> comma >> p.y()) || comma != ',' || !(words >> std::ws).eof() ||
        !p.allFinite()) {
      fault(fmt::format("\"{}\"; two numbers belong here: x_m,z_m", line));
      continue;
    }
    if (p.y() < 0) fault(fmt::format("z_m is {:g}; the ground is at 0", p.y()));
    if (!outline.empty() && p.x() < outline.back().x())
      fault(fmt::format("x_m falls from {:g} to {:g}; points run from the toe to the rear",
                        outline.back().x(), p.x()));
    outline.push_back(p);
    if (lines != nullptr) lines->push_back(at);
  }
  if (faults.empty() && outline.size() < 2)
    fault(fmt::format("{} points; an outline has at least two", outline.size()));
  if (!faults.empty()) throw InputError(std::move(faults));
  return outline;
}

std::string to_csv(const BenchOutline& outline) {
  std::string out = "x_m,z_m\n";
  for (const auto& p : outline) out += fmt::format("{:.9g},{:.9g}\n", p.x(), p.y());
  return out;
}

}  // namespace dipper::cases

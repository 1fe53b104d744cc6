#include "coupler/case/outline_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/csv_table.hpp"
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
  std::vector<Finding> faults;
  const auto fault = [&](int line, const std::string& what) {
    faults.push_back({file, line, "", what});
  };
  BenchOutline outline;
  for (const CsvRow& row : read_csv(file, {"x_m", "z_m"}, faults)) {
    const Eigen::Vector2d p(row.values[0], row.values[1]);
    if (p.y() < 0) fault(row.line, fmt::format("z_m is {:g}; the ground is at 0", p.y()));
    if (!outline.empty() && p.x() < outline.back().x())
      fault(row.line,
            fmt::format("x_m falls from {:g} to {:g}; points run from the toe to the rear",
                        outline.back().x(), p.x()));
    outline.push_back(p);
    if (lines != nullptr) lines->push_back(row.line);
  }
  if (faults.empty() && outline.size() < 2)
    fault(0, fmt::format("{} points; an outline has at least two", outline.size()));
  if (faults.empty()) return outline;
  sort_by_line(faults);
  throw InputError(std::move(faults));
}

std::string to_csv(const BenchOutline& outline) {
  std::string out = "x_m,z_m\n";
  for (const auto& p : outline) out += fmt::format("{:.9g},{:.9g}\n", p.x(), p.y());
  return out;
}

}  // namespace dipper::cases

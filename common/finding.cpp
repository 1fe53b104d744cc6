#include "common/finding.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dipper {

std::string to_string(const Finding& f) {
  std::string text = f.file.string();
  if (f.line > 0) text += fmt::format(":{}", f.line);
  if (f.line > 0 && f.column > 0) text += fmt::format(":{}", f.column);
  if (!text.empty()) text += ": ";
  if (!f.key.empty()) text += f.key + ": ";
  return text + f.message;
}

void sort_by_line(std::vector<Finding>& findings, std::size_t first) {
  std::stable_sort(findings.begin() + static_cast<std::ptrdiff_t>(first), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.line < b.line; });
}

}  // namespace dipper

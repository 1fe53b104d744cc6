#include "common/row_faults.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

namespace dipper {
namespace {

constexpr int kFew = 3;  // faults of one kind that are reported one by one

}  // namespace

void RowFaults::add(std::string kind, int line, int column, std::string wrong, std::string right) {
  faults_.push_back({std::move(kind), line, column, std::move(wrong), std::move(right)});
}

void RowFaults::report(const std::filesystem::path& file, std::vector<Finding>& findings) const {
  std::map<std::string, int> count;
  for (const Fault& f : faults_) ++count[f.kind];
  std::set<std::string> seen_kinds;
  for (const Fault& f : faults_) {
    const int n = count.at(f.kind);
    if (n > kFew && !seen_kinds.insert(f.kind).second) continue;
    const std::string more = n > kFew ? fmt::format(", and the same in {} more lines", n - 1) : "";
    findings.push_back({file, f.line, "", f.wrong + more + "; " + f.right, f.column});
  }
}

}  // namespace dipper

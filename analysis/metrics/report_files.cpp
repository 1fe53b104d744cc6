#include "analysis/metrics/report_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "common/text_file.hpp"

namespace dipper::analysis::metrics {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

std::string cell(const json& value) {
  if (!value.is_string()) return value.dump();
  std::string text = value;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

bool is_scalar(const json& v) { return v.is_primitive() && !v.is_null(); }

/// A row's own values, lists of numbers unrolled.
std::vector<std::pair<std::string, std::string>> flat(const json& row) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& [key, value] : row.items()) {
    if (is_scalar(value)) out.emplace_back(key, cell(value));
    if (!value.is_array()) continue;
    for (std::size_t k = 0; k < value.size(); ++k)
      if (value[k].is_number()) out.emplace_back(fmt::format("{}_{}", key, k + 1), cell(value[k]));
  }
  return out;
}

std::string map_csv(const rock::WallField& f) {
  std::string out = "triangle,x_m,y_m,z_m,area_m2,last,mean,max\n";
  for (std::size_t i = 0; i < f.last.size(); ++i) {
    const auto& p = f.middle_m[i];
    out += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", i, p.x(), p.y(),
                       p.z(), f.area_m2[i], f.last[i], f.mean[i], f.max[i]);
  }
  return out;
}

}  // namespace

std::string to_csv(const json& table) {
  std::string out;
  const auto end_row = [&](bool first) { out += first ? "" : ","; };
  if (table.is_object()) {
    std::size_t rows = 0;
    bool first = true;
    for (const auto& [name, column] : table.items()) {
      if (!column.is_array()) continue;
      end_row(first);
      out += name;
      rows = std::max(rows, column.size());
      first = false;
    }
    for (std::size_t i = 0; i < rows; ++i) {
      out += '\n';
      first = true;
      for (const auto& [name, column] : table.items()) {
        if (!column.is_array()) continue;
        end_row(first);
        if (i < column.size()) out += cell(column[i]);
        first = false;
      }
    }
    return out + '\n';
  }
  std::vector<std::string> names;  // of all rows, which may have different columns
  for (const json& row : table)
    for (const auto& [name, value] : flat(row))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  for (std::size_t k = 0; k < names.size(); ++k) {
    end_row(k == 0);
    out += names[k];
  }
  for (const json& row : table) {
    out += '\n';
    const auto values = flat(row);
    for (std::size_t k = 0; k < names.size(); ++k) {
      end_row(k == 0);
      const auto at = std::find_if(values.begin(), values.end(),
                                   [&](const auto& v) { return v.first == names[k]; });
      if (at != values.end()) out += at->second;
    }
  }
  return out + '\n';
}

void write_report(const Metrics& metrics, const fs::path& folder,
                  const std::function<void(const fs::path&)>& more) {
  const fs::path parent = fs::absolute(folder).parent_path();
  const fs::path made = parent / fmt::format(".{}-{}", folder.filename().string(), getpid());
  fs::remove_all(made);
  fs::create_directories(made);
  try {
    write_text(made / "metrics.json", metrics.values.dump(1) + "\n");
    for (const char* name : {"passes", "phases", "stages", "frames", "pile", "sizes", "walls"}) {
      const auto table = metrics.values.find(name);
      if (table == metrics.values.end() || table->empty()) continue;
      write_text(made / (std::string(name) + ".csv"), to_csv(*table));
    }
    for (const rock::WallField& f : metrics.walls)
      write_text(made / fmt::format("wall_{}_{}.csv", f.body, f.field), map_csv(f));
    if (more) more(made);
    fs::remove_all(folder);
    fs::rename(made, folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(made, ignored);
    throw;
  }
}

}  // namespace dipper::analysis::metrics

#include "coupler/result/dump_index.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/io/dump_reader.hpp"
#include "common/draft_file.hpp"
#include "common/text_file.hpp"

namespace dipper::result {
namespace fs = std::filesystem;

void index_dumps(const fs::path& dumps, double timestep_s) {
  std::map<std::string, std::map<std::int64_t, std::string>> frames;  // by body, then by step
  for (const auto& entry : fs::directory_iterator(dumps)) {
    const std::string file = entry.path().filename().string();
    if (entry.path().extension() != ".vtk") continue;
    if (const auto step = analysis::io::step_in_name(file))
      frames[file.substr(0, file.rfind('_'))][*step] = file;
  }
  for (const auto& [body, names] : frames) {
    auto files = nlohmann::json::array();
    for (const auto& [step, name] : names)
      files.push_back({{"name", name}, {"time", static_cast<double>(step) * timestep_s}});
    write_text(dumps / (body + ".vtk.series"),
               nlohmann::json{{"file-series-version", "1.0"}, {"files", files}}.dump(1));
  }
}

void drop_frames_after(const fs::path& dumps, std::int64_t step) {
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(dumps)) {
    const fs::path& file = entry.path();
    if (is_draft(file)) later.push_back(file);
    const fs::path kind = analysis::io::without_gz(file).extension();
    if (kind != ".dump" && kind != ".vtk") continue;
    if (const auto frame = analysis::io::step_in_name(file); frame && *frame > step)
      later.push_back(file);
  }
  for (const fs::path& file : later) fs::remove(file);
}

}  // namespace dipper::result

#include "coupler/run/dump_index.hpp"

#include <charconv>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// The step that ends a frame's name, rocks_1200.dump; none: the file is no frame.
std::optional<std::int64_t> step_of(const fs::path& file) {
  const std::string name = file.stem().string();
  const std::size_t at = name.rfind('_') + 1;
  std::int64_t step = 0;
  const auto [end, fault] = std::from_chars(name.data() + at, name.data() + name.size(), step);
  if (at == 0 || fault != std::errc() || end != name.data() + name.size()) return {};
  return step;
}

void index(const fs::path& dumps, const std::string& stem, double timestep_s) {
  std::map<std::int64_t, std::string> frames;  // by step
  for (const auto& entry : fs::directory_iterator(dumps)) {
    const fs::path file = entry.path().filename();
    if (file.extension() != ".vtk" || file.string().rfind(stem, 0) != 0) continue;
    if (const auto step = step_of(file)) frames[*step] = file.string();
  }
  auto files = nlohmann::json::array();
  for (const auto& [step, name] : frames) {
    files.push_back({{"name", name}, {"time", static_cast<double>(step) * timestep_s}});
  }
  const fs::path out = dumps / (stem.substr(0, stem.size() - 1) + ".vtk.series");
  std::ofstream(out) << nlohmann::json{{"file-series-version", "1.0"}, {"files", files}}.dump(1);
}

}  // namespace

void index_dumps(const fs::path& dumps, double timestep_s) {
  for (const char* wall : {"dipper_", "door_", "truck_"}) index(dumps, wall, timestep_s);
}

void drop_frames_after(const fs::path& dumps, std::int64_t step) {
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(dumps))
    if (const auto frame = step_of(entry.path()); frame && *frame > step)
      later.push_back(entry.path());
  for (const fs::path& file : later) fs::remove(file);
}

}  // namespace dipper::run

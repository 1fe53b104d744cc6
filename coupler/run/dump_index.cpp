#include "coupler/run/dump_index.hpp"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

void index(const fs::path& dumps, const std::string& stem, double timestep_s) {
  std::map<long, std::string> frames;  // by step
  for (const auto& entry : fs::directory_iterator(dumps)) {
    const fs::path file = entry.path();
    const std::string name = file.stem().string();
    if (file.extension() != ".vtk" || name.rfind(stem, 0) != 0) continue;
    try {
      frames[std::stol(name.substr(stem.size()))] = file.filename().string();
    } catch (const std::invalid_argument&) {  // not a frame
    }
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

}  // namespace dipper::run

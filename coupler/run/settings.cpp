#include "coupler/run/settings.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "common/case_lines.hpp"

namespace dipper::run {
namespace {

constexpr const char* kFile = "settings.txt";

}  // namespace

std::vector<cases::Override> read_settings(const std::filesystem::path& run) {
  std::vector<cases::Override> settings;
  if (!std::filesystem::exists(run / kFile)) return settings;
  for (const CaseLine& line : CaseLines::read(run / kFile))
    settings.push_back({line.key, line.value});
  return settings;
}

void write_settings(const std::filesystem::path& run,
                    const std::vector<cases::Override>& settings) {
  std::map<std::string, std::string> last;
  for (const cases::Override& o : settings) {
    std::string& value = last[o.key] = o.value;
    std::replace(value.begin(), value.end(), '\n', ' ');  // a line a key
  }
  std::ofstream out(run / kFile);
  for (const auto& [key, value] : last) out << key << '=' << value << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + (run / kFile).string());
}

}  // namespace dipper::run

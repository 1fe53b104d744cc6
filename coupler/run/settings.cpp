#include "coupler/run/settings.hpp"

#include <algorithm>
#include <map>

#include "common/case_lines.hpp"
#include "common/text_file.hpp"

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
    std::replace(value.begin(), value.end(), '\n', ' ');  // one line for each key
  }
  std::string text;
  for (const auto& [key, value] : last) text += key + '=' + value + '\n';
  write_text(run / kFile, text);
}

}  // namespace dipper::run

#include "coupler/cli/set_option.hpp"

#include <CLI/CLI.hpp>

namespace dipper::cli {

std::vector<cases::Override> overrides_of(const std::vector<std::string>& set,
                                          const std::string& example) {
  std::vector<cases::Override> all;
  for (const std::string& s : set) {
    const auto equals = s.find('=');
    if (equals == std::string::npos)
      throw CLI::ValidationError("--set " + s, "write key=value, as in --set " + example);
    all.push_back({s.substr(0, equals), s.substr(equals + 1)});
  }
  return all;
}

}  // namespace dipper::cli

#include "coupler/cli/page_command.hpp"

#include <fmt/core.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/report/page.hpp"

namespace dipper::cli {

int page_command(const std::string& file) {
  std::string text;
  try {
    text = analysis::report::page(nlohmann::json::parse(std::cin));
  } catch (const nlohmann::json::exception& e) {
    fmt::print(stderr, "dipper: page: standard input is not JSON: {}\n", e.what());
    return 2;
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "dipper: page: {}\n", e.what());
    return 2;
  }
  analysis::report::write_page(text, file);
  return 0;
}

}  // namespace dipper::cli

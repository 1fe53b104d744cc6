#include "coupler/cli/page_command.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/report/page.hpp"
#include "common/json_text.hpp"
#include "common/text_file.hpp"

namespace dipper::cli {
namespace {

int write_page(const std::string& file, Reporter& reporter) {
  std::string text;
  try {
    text = analysis::report::page(read_json(std::cin));
  } catch (const nlohmann::json::exception& e) {
    reporter.error(std::string("page: standard input is not JSON: ") + e.what());
    return 2;
  } catch (const std::invalid_argument& e) {
    reporter.error(std::string("page: ") + e.what());
    return 2;
  }
  write_text(file, text);
  return 0;
}

}  // namespace

Command add_page_command(CLI::App& app, Reporter& reporter) {
  const auto file = std::make_shared<std::string>();
  auto* sub = app.add_subcommand("page", "the page of the JSON on standard input");
  sub->add_option("FILE", *file, "the HTML file to write")->required();
  sub->group("");  // not in --help: dipper gap calls it
  return {sub, [file, &reporter] { return write_page(*file, reporter); }};
}

}  // namespace dipper::cli

#include "coupler/cli/effects_command.hpp"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/resolved_path.hpp"
#include "coupler/case/effects.hpp"
#include "coupler/case/schema.hpp"

namespace dipper::cli {
namespace {

using json = nlohmann::ordered_json;

const char* word(cases::KeyChange::How how) {
  switch (how) {
    case cases::KeyChange::How::add:
      return "add";
    case cases::KeyChange::How::scale:
      return "scale";
    default:
      return "set";
  }
}

/// The earliest stage that has to be made again, over all its keys.
std::string affects(const cases::Effect& e) {
  cases::Affects first = cases::Affects::output;
  for (const cases::KeyChange& change : e.changes)
    if (const cases::KeySpec* spec = cases::spec_of(change.key))
      first = std::min(first, spec->affects);
  return cases::to_string(first);
}

json to_json(const cases::Effect& e) {
  json overlay = json::array();
  for (const cases::KeyChange& change : e.changes)
    overlay.push_back({{"key", change.key}, {"how", word(change.how)}, {"factor", change.factor}});
  json parameter = {{"name", e.parameter}, {"unit", e.unit},   {"low", e.low},
                    {"high", e.high},      {"scale", e.scale}, {"source", e.source}};
  return {{"name", e.name},           {"title", e.title},       {"kind", e.kind},
          {"signature", e.signature}, {"nuisance", e.nuisance}, {"parameter", parameter},
          {"overlay", overlay},       {"affects", affects(e)}};
}

}  // namespace

int effects_command(const std::filesystem::path& case_folder, Reporter& reporter) {
  std::vector<Finding> findings;
  if (!std::filesystem::exists(resolved(case_folder) / "case.yaml"))
    findings.push_back({case_folder, 0, "", "is not a case: it has no case.yaml"});
  json effects = json::array();
  for (const std::string& name : cases::effect_names(case_folder))
    effects.push_back(to_json(cases::read_effect(cases::effect_file(case_folder, name), findings)));
  for (const Finding& finding : findings) reporter.error(to_string(finding));
  if (!findings.empty()) return 2;
  reporter.line(json{{"effects", effects}}.dump());
  return 0;
}

Command add_effects_command(CLI::App& app, Reporter& reporter) {
  const auto folder = std::make_shared<std::string>();
  auto* sub = app.add_subcommand("effects", "effects that a case can take, as JSON");
  sub->footer(
      "Those of the catalogue and the case's own, with parameter, unit and bounds. "
      "Example:\n  dipper effects cases/quick");
  sub->add_option("CASE", *folder, "a folder with a case.yaml")->required();
  return {sub, [folder, &reporter] { return effects_command(*folder, reporter); }};
}

}  // namespace dipper::cli

#include "coupler/cli/check_command.hpp"

#include <memory>

#include "common/source_hash.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/check/cost_estimate.hpp"
#include "coupler/cli/set_option.hpp"

namespace dipper::cli {
namespace {

struct CheckOptions {
  std::string folder;
  std::vector<std::string> set;
  bool json = false;
};

}  // namespace

Command add_check_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<CheckOptions>();
  auto* sub =
      app.add_subcommand("check", "check a case: all errors at once, and what a run will take");
  sub->footer(
      "Reads case.yaml and every file it names, starts nothing, and estimates time, memory and "
      "disk of a run. "
      "Example:\n  dipper check cases/quick --set seed=7");
  sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
  sub->add_option("--set", o->set, "KEY=VALUE: overrides the case");
  sub->add_flag("--json", o->json, "findings, hash, size and values, for programs");
  return {sub, [o, &reporter] {
            const auto set = overrides_of(o->set, "coupling.scheme=serial");
            if (o->json)
              return check::check_as_json(o->folder, set, source_hash(), reporter) ? 0 : 2;
            const auto c = check::checked_case(o->folder, set, reporter);
            if (!c) return 2;
            check::report_full_disk(*c, "runs", reporter);
            return 0;
          }};
}

}  // namespace dipper::cli

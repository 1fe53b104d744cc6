#include "coupler/cli/observe_command.hpp"

#include <memory>

#include "common/manifest.hpp"
#include "common/writable_folder.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/result/observed.hpp"

namespace dipper::cli {
namespace {

struct ObserveOptions {
  std::string folder, out;
  std::vector<std::string> set;
};

int observe(const ObserveOptions& o) {
  namespace fs = std::filesystem;
  require_undamaged(o.folder);
  cases::ObservationCase observation = result::read_observation(fs::path(o.folder) / "case.txt");
  try {
    for (const cases::Override& set : overrides_of(o.set, "observation.lag_s=0.2"))
      result::set_observation(observation, set);
  } catch (const std::invalid_argument& e) {
    throw CLI::ValidationError("--set", e.what());
  }
  const fs::path record = fs::path(o.folder) / "record.h5";
  result::require_no_measured(o.out);
  result::require_readings(record, observation.rate_Hz);
  make_writable(o.out);
  result::write_observed(record, observation, o.out);
  return 0;
}

}  // namespace

Command add_observe_command(CLI::App& app) {
  const auto o = std::make_shared<ObserveOptions>();
  auto* sub = app.add_subcommand("observe", "a run as the mine's instruments would record it");
  sub->footer(
      "Writes a measured folder, which dipper gap reads, with the instruments' rate and lag. "
      "Example:\n  dipper observe runs/quick --out measured");
  sub->add_option("DIR", o->folder, "a run's folder")->required()->check(CLI::ExistingDirectory);
  sub->add_option("--out", o->out, "the folder to write")->required();
  sub->add_option("--set", o->set, "observation.KEY=VALUE: overrides the case of the run");
  return {sub, [o] { return observe(*o); }};
}

}  // namespace dipper::cli

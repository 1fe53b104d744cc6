#include "coupler/cli/preview_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "analysis/report/dry_page.hpp"
#include "common/temporary_folder.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/cli/output_file.hpp"
#include "coupler/cli/own_network.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/launch/interrupt.hpp"

namespace dipper::cli {

namespace fs = std::filesystem;

namespace {

struct PreviewOptions {
  std::string folder, out;
  std::vector<std::string> set;
};

constexpr double kDryWindow_s = 5e-3;  // without rock, shorter ones are no more accurate

int preview(const PreviewOptions& o, Reporter& reporter) {
  launch::catch_interrupts();
  const auto c = check::checked_case(
      o.folder, overrides_of(o.set, "machine.base_position_m=[0,0,0]"), reporter);
  if (!c) return 2;
  const fs::path page = o.out.empty() ? fs::path(c->name + "-preview.html") : fs::path(o.out);
  require_output(page, "--out", inputs_of(*c));
  return write_dry_page(*c, dry::RockModel::none, page, reporter);
}

}  // namespace

int write_dry_page(cases::Case c, dry::RockModel rock, const fs::path& page, Reporter& reporter) {
  dry::require_drives(c);
  c.coupling.sync_steps = std::max(c.coupling.sync_steps,
                                   static_cast<int>(std::lround(kDryWindow_s / c.dem.timestep_s)));
  const TemporaryFolder scratch("dipper-preview");
  const result::RunFolder folder = result::RunFolder::create(scratch.path() / c.name);
  enter_own_network(reporter);
  const run::RunStatus status = dry::dry_run(c, rock, folder, std::nullopt, reporter);
  if (status != run::RunStatus::complete) return static_cast<int>(status);
  analysis::report::write_dry_page(folder.root(), page);
  reporter.line(page.string());
  return 0;
}

Command add_preview_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<PreviewOptions>();
  auto* sub =
      app.add_subcommand("preview", "a case in 3-D, with its motion, before anything is computed");
  sub->footer(
      "Writes one page: the machine at work over the pile, the truck, the path of the teeth in "
      "each pass, and what the motion demands of the drives. "
      "Example:\n  dipper preview cases/quick --out look.html");
  sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
  sub->add_option("--set", o->set, "KEY=VALUE: overrides the case");
  sub->add_option("--out", o->out, "the page (default: NAME-preview.html)");
  return {sub, [o, &reporter] { return preview(*o, reporter); }};
}

}  // namespace dipper::cli

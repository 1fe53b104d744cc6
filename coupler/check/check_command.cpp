#include "coupler/check/check_command.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/seconds.hpp"
#include "coupler/check/check.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/stable_timestep.hpp"
#include "machine/motion.hpp"

namespace dipper::check {
namespace {

std::string summary(const cases::Case& c) {
  double rocks = 0;
  for (const deck::ClassCount& count : deck::rock_counts(c)) rocks += count.rocks;
  const double motion_s = seconds(machine::Motion::load(c.machine.motion).end_ns());
  const double end_s = c.end_s > 0 ? c.end_s : motion_s;
  const double steps = std::ceil(end_s / c.dem.timestep_s - 1e-6);
  const double settle_steps = std::ceil((c.pile.settle_s + c.pile.relax_s) / c.dem.timestep_s);
  return fmt::format(
      "about {:.0f} rocks, {:g} s simulated in {:.0f} steps and {:.0f} windows of {:g} ms, after "
      "{:.0f} steps that settle the pile; the step is {:.0f} % of the largest stable one, {:.3g} s",
      rocks, end_s, steps, std::ceil(steps / c.coupling.sync_steps),
      c.coupling.sync_steps * c.dem.timestep_s * 1e3, settle_steps,
      100 * c.dem.timestep_s / deck::stable_timestep(c), deck::stable_timestep(c));
}

}  // namespace

int check_command(const std::filesystem::path& folder,
                  const std::vector<cases::Override>& overrides, std::ostream& out) {
  std::vector<cases::Finding> findings;
  const cases::Case c = cases::load_case(folder, overrides, findings);
  if (findings.empty()) findings = check::check_case(c);
  for (const cases::Finding& finding : findings) out << cases::to_string(finding) << '\n';
  if (findings.empty()) {
    out << c.name << " is sound: " << summary(c) << '\n';
    return 0;
  }
  out << findings.size() << (findings.size() == 1 ? " error\n" : " errors\n");
  return 2;
}

}  // namespace dipper::check

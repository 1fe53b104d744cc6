#include "coupler/check/checked_case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/case_lines.hpp"
#include "common/json_text.hpp"
#include "common/seconds.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/case/case_text.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/check/check.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/check/cost_estimate.hpp"
#include "coupler/check/dig_sweep.hpp"
#include "coupler/check/warnings.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/stable_timestep.hpp"

namespace dipper::check {
namespace {

using nlohmann::json;

/// How much there is to compute.
struct CaseSize {
  double rocks = 0;
  double simulated_s = 0;
  double steps = 0;
  double windows = 0;
  double settle_steps = 0;
};

CaseSize size_of(const cases::Case& c) {
  CaseSize s;
  for (const deck::ClassCount& count : deck::rock_counts(c)) s.rocks += count.rocks;
  const double motion_s = cases::motion_end_s(c);
  s.simulated_s = c.end_s > 0 ? c.end_s : motion_s;
  s.steps = std::ceil(s.simulated_s / c.dem.timestep_s - 1e-6);
  s.windows = std::ceil(s.steps / c.coupling.sync_steps);
  s.settle_steps = std::ceil((c.pile.settle_s + c.pile.relax_s) / c.dem.timestep_s);
  return s;
}

std::string summary(const cases::Case& c) {
  const CaseSize s = size_of(c);
  return fmt::format(
      "about {:.0f} rocks poured; {:g} s simulated in {:.0f} DEM steps and {:.0f} sync steps of "
      "{:g} ms, "
      "after {:.0f} DEM steps to settle the pile; the DEM step is {:.0f} % of the largest stable "
      "one, {:.3g} s",
      s.rocks, s.simulated_s, s.steps, s.windows, c.coupling.sync_steps * c.dem.timestep_s * 1e3,
      s.settle_steps, 100 * c.dem.timestep_s / deck::stable_timestep(c), deck::stable_timestep(c));
}

/// The volume that the teeth sweep under the bench's nominal surface in each pass.
void report_digs(const CaseParts& parts, Reporter& reporter) {
  int number = 0;
  for (const DigSweep& sweep : dig_sweeps(parts))
    reporter.line(fmt::format(
        "pass {}: the teeth sweep {:.0f} m3{}, up to {:.1f} m deep; the dipper's struck volume is "
        "{:.3g} m3",
        ++number, sweep.volume_m3,
        sweep.first ? "" : " of the remaining face, if no rock comes down", sweep.deepest_m,
        parts.machine.dipper.struck_volume));
}

json as_json(const Finding& f) {
  return {{"file", f.file.string()},
          {"line", f.line},
          {"column", f.column},
          {"key", f.key},
          {"message", f.message}};
}

/// Every key's value: a number, a text, or a list of them.
json values_of(const cases::Case& c) {
  json values = json::object();
  const CaseLines lines(c.text);
  for (const CaseLine& line : lines) {
    const json value = parse_json_or_discard(line.value);
    values[line.key] =
        value.is_discarded() || value.is_string() ? json(lines.text(line.key)) : value;
  }
  return values;
}

}  // namespace

cases::Case read_case(const std::filesystem::path& folder,
                      const std::vector<cases::Override>& overrides,
                      std::vector<Finding>& findings) {
  cases::Case c = cases::load_case(folder, overrides, findings);
  if (!findings.empty()) return c;
  if (c.dem.timestep_s == 0) {
    c.dem.timestep_s = deck::chosen_timestep(without_mixed_classes(c));
    c.text = cases::case_text(c);
  }
  findings = check_case(c);
  return c;
}

std::optional<cases::Case> checked_case(const std::filesystem::path& folder,
                                        const std::vector<cases::Override>& overrides,
                                        Reporter& reporter) {
  std::vector<Finding> findings;
  cases::Case c = read_case(folder, overrides, findings);
  for (const Finding& finding : findings) reporter.line(to_string(finding));
  if (!findings.empty()) {
    reporter.line(fmt::format("{} error{}", findings.size(), findings.size() == 1 ? "" : "s"));
    return std::nullopt;
  }
  reporter.line(c.name + " is sound: " + summary(c));
  const bool plans = c.machine.operated_by == cases::OperatorKind::plan && c.op.passes > 1;
  reporter.line(to_string(cost_estimate(c)) +
                (plans
                     ? fmt::format("; of machine.motion, where the operator makes up to {} passes",
                                   c.op.passes)
                     : ""));
  std::vector<Finding> warned;
  if (c.machine.kind == cases::MachineKind::shovel) {
    const CaseParts parts(c);
    report_digs(parts, reporter);
    warned = warnings(parts);
  } else {
    warned = warnings(c);
  }
  for (const Finding& warning : warned) reporter.line("warning: " + to_string(warning));
  return c;
}

bool check_as_json(const std::filesystem::path& folder,
                   const std::vector<cases::Override>& overrides, const std::string& source_hash,
                   Reporter& reporter) {
  std::vector<Finding> findings;
  const cases::Case c = read_case(folder, overrides, findings);
  json said = {{"case", c.name},
               {"sound", findings.empty()},
               {"findings", json::array()},
               {"source_hash", source_hash}};
  for (const Finding& f : findings) said["findings"].push_back(as_json(f));
  if (!c.text.empty()) said["values"] = values_of(c);  // as far as they could be read
  if (findings.empty()) {
    said["warnings"] = json::array();
    for (const Finding& warning : warnings(c)) said["warnings"].push_back(as_json(warning));
    const CaseSize s = size_of(c);
    said["case_hash"] = cases::case_hash(c);
    said["size"] = {{"rocks", s.rocks},
                    {"simulated_s", s.simulated_s},
                    {"steps", s.steps},
                    {"windows", s.windows},
                    {"settle_steps", s.settle_steps},
                    {"stable_timestep_s", deck::stable_timestep(c)}};
    const CostEstimate cost = cost_estimate(c);
    said["cost"] = {{"spheres", cost.spheres},   {"settle_cpu_s", cost.settle_s},
                    {"dig_cpu_s", cost.dig_s},   {"wall_s", cost.wall_s},
                    {"memory_B", cost.memory_B}, {"disk_B", cost.disk_B},
                    {"record_B", cost.record_B}, {"dumps_B", cost.dumps_B}};
    said["effects"] = c.effects;
    said["files"] = json::array();
    for (const auto& file : cases::referenced_files(c)) said["files"].push_back(file.string());
  }
  reporter.line(said.dump(1, ' ', false, json::error_handler_t::replace));
  return findings.empty();
}

}  // namespace dipper::check

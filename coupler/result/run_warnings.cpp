#include "coupler/result/run_warnings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/check/warnings.hpp"
#include "coupler/deck/stable_timestep.hpp"
#include "coupler/result/truck_load.hpp"
#include "machine/motion.hpp"

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

constexpr double kMuchSlack = 0.05;     // of a dig: below, a dipper that is let down onto rock
constexpr double kMuchResidual = 0.01;  // of the work
constexpr double kLostMass_kg = 1000;
constexpr double kMostMissed = 0.5;   // of a payload
constexpr double kMuchRattle = 0.05;  // of a dig's windows; at true size up to 0.03
constexpr double kHighPeak = 6;       // times the mean; whole digs have 3 to 5
constexpr double kMuchBeyond = 0.33;  // of a dig; at true size up to 0.29

/// `whole`: the run reached its end; one that was interrupted can be resumed.
void warn_of_pass(const cases::Case& c, const json& p, bool whole,
                  std::vector<std::string>& warnings) {
  const int pass = p.at("pass").get<int>();
  const auto number = [&](const char* key) { return p.value(key, 0.0); };
  if (const double slack = number("dig_slack_fraction"); slack > kMuchSlack)
    warnings.push_back(
        fmt::format("pass {}: the hoist ropes are slack in {:.0f} % of the dig and the teeth up to "
                    "{:.1f} m off "
                    "their path: the dipper rides on rock (docs/motion.md)",
                    pass, 100 * slack, number("teeth_deviation_m")));
  const double mean = number("dig_force_mean_N"), peak = number("dig_force_peak_N");
  if (mean > 0 && peak > kHighPeak * mean)
    warnings.push_back(fmt::format(
        "pass {}: the dig force peaks at {:.0f} MN, {:.0f} times its mean, at {:.2f} s: a rock is "
        "caught between the dipper and something rigid",
        pass, peak * 1e-6, peak / mean, number("dig_force_peak_t_s")));
  const bool prescribed = c.machine.drives == machine::DriveMode::prescribed;
  for (const auto& [drive, key] :
       {std::pair{"hoist", "hoist_beyond_fraction"}, std::pair{"crowd", "crowd_beyond_fraction"}})
    if (const double beyond = number(key); beyond > kMuchBeyond && prescribed)
      warnings.push_back(fmt::format(
          "pass {}: the {} takes more force than the machine has in {:.0f} % of the dig; with "
          "machine.drives: limited it stalls instead (docs/drives.md)",
          pass, drive, 100 * beyond));
  if (const double rattle = number("dig_rattle_fraction"); rattle > kMuchRattle)
    warnings.push_back(fmt::format(
        "pass {}: in {:.0f} % of the dig the rock's force jumps from step to step: rocks pressed "
        "between walls rattle and press too hard; a dem.timestep_s below {:.1e} s prevents it, "
        "contact.normal_damping_other: 0.5 reduces it (docs/rock.md#how-long-a-step-may-be)",
        pass, 100 * rattle, deck::pressed_timestep(c)));
  if (const auto dumped = p.find("dumped"); whole && dumped != p.end() && *dumped == false)
    warnings.push_back(
        fmt::format("pass {}: unfinished: the run ends before its load is dumped; continue it with "
                    "a later end_s",
                    pass));
  const double payload_kg = number("payload_kg"), truck_kg = number("truck_kg");
  if (p.value("dumped", false) && payload_kg > kLostMass_kg && truck_kg >= -kLostMass_kg &&
      truck_kg < kMostMissed * payload_kg)
    warnings.push_back(fmt::format(
        "pass {}: of {:.1f} t in the dipper {:.1f} t reach the truck: is it under the door?", pass,
        1e-3 * payload_kg, 1e-3 * truck_kg));
  if (truck_kg < -kLostMass_kg)
    warnings.push_back(fmt::format(
        "pass {}: {:.1f} t more leave the truck than enter it: is it in the pile at the "
        "start?",
        pass, -1e-3 * truck_kg));
}

}  // namespace

std::vector<std::string> run_warnings(const cases::Case& c, const json& summary) {
  std::vector<std::string> warnings;
  try {
    for (const Finding& warning : check::warnings(c)) warnings.push_back(to_string(warning));
  } catch (const InputError&) {  // a file has gone since the run began
  }
  const bool whole = summary.value("status", "complete") == "complete";
  for (const json& p : summary.at("passes")) warn_of_pass(c, p, whole, warnings);
  if (const auto truck = truck_load(c.truck.rated_t, summary.at("passes"))) {
    const std::string overload = overload_warning(*truck);
    if (!overload.empty()) warnings.push_back(overload);
  } else if (const std::string none = no_truck_load(c.truck.rated_t, summary.at("passes"));
             whole && !none.empty()) {
    warnings.push_back(none);
  }
  if (const auto drives = summary.find("drives");
      whole && drives != summary.end() && c.end_s == 0 && !summary.contains("operator")) {
    const double path_s = drives->at("path_time_s").get<double>(),
                 motion_s = cases::motion_end_s(c);
    if (path_s < motion_s - 1e-3)
      warnings.push_back(
          fmt::format("the run ends at {:.1f} s of the motion's {:.1f} s: a drive "
                      "stalls permanently (docs/drives.md)",
                      path_s, motion_s));
  }
  if (whole && c.collapse.height_m > 0 && summary.value("sim_s", 0.0) < c.collapse.at_s)
    warnings.push_back(
        fmt::format("the run ends at {:.1f} s, before collapse.at_s: {:g}; no slab has come down",
                    summary.value("sim_s", 0.0), c.collapse.at_s));
  if (const double lost = summary.at("dem").value("rock_lost_kg", 0.0); lost > kLostMass_kg)
    warnings.push_back(fmt::format(
        "{:.1f} t of rock left the domain: domain.min_m and domain.max_m farther out keep it, "
        "unless it was thrown by contacts too soft (contact.normal_scale) or steps too long",
        1e-3 * lost));
  const json& coupling = summary.at("coupling");
  const double residual = std::abs(coupling.at("energy_residual_J").get<double>()),
               work = std::abs(coupling.at("interface_work_J").get<double>());
  if (residual > kMuchResidual * work && work > 0)
    warnings.push_back(fmt::format(
        "the coupling's energy error is {:.1f} % of the work of {:.0f} MJ; shorter sync steps "
        "(coupling.sync_steps) reduce it (docs/coupling.md)",
        100 * residual / work, work * 1e-6));
  return warnings;
}

}  // namespace dipper::result

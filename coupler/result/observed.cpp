#include "coupler/result/observed.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "analysis/run/run_folder.hpp"
#include "analysis/signals/door_leak.hpp"
#include "analysis/signals/drive_terms.hpp"
#include "analysis/signals/observe.hpp"
#include "common/angles.hpp"
#include "common/case_lines.hpp"
#include "common/input_error.hpp"
#include "common/numbers.hpp"
#include "common/text_file.hpp"
#include "coupler/case/force_laws.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/result/surveyed_faces.hpp"
#include "machine/machine_data.hpp"

namespace dipper::result {
namespace fs = std::filesystem;
namespace {

constexpr const char* kChannels =
    "# What observed/ holds; sigma 0: a simulation has no noise.\n"
    "truck_mass_t: {unit: t, role: response, sigma: 0, common_sigma: 0}\n"
    "hoist_m: {unit: m, role: driven, sigma: 0, common_sigma: 0}\n"
    "crowd_m: {unit: m, role: driven, sigma: 0, common_sigma: 0}\n"
    "swing_rad: {unit: rad, role: driven, sigma: 0, common_sigma: 0}\n"
    "hoist_force_kN: {unit: kN, role: response, sigma: 0, common_sigma: 0}\n"
    "crowd_force_kN: {unit: kN, role: response, sigma: 0, common_sigma: 0}\n";
constexpr double kReadings = 10;  // that dipper gap needs of each pass
constexpr const char* kFaceChannel =
    "face_m: {unit: m, role: response, sigma: 0, common_sigma: 0}\n";

/// The machine of a run, which weighs its load.
analysis::signals::PayloadMonitor monitor_of(const fs::path& run) {
  const fs::path file = run / "case.txt";
  const auto rake_deg = CaseLines::read(file).number("machine.rake_angle_deg");
  if (!rake_deg) throw InputError({{file, 0, "machine.rake_angle_deg", "has no number"}});
  return {machine::load_machine(run / "machine.yaml"), radians(*rake_deg)};
}

}  // namespace

void write_observed(const fs::path& record, const cases::ObservationCase& o, const fs::path& out) {
  const analysis::run::RunSignals s = analysis::run::read_drive_signals(record);
  write_observed(s.drive, s.pass, o, record.parent_path(), out);
}

void write_observed(const analysis::signals::DriveSignals& plain,
                    const analysis::signals::PassSignals& pass_signals,
                    const cases::ObservationCase& o, const fs::path& run, const fs::path& out) {
  const analysis::signals::Instruments instruments{
      o.rate_Hz,         o.lag_s,           o.scale_gain, o.truck_spillage, o.scale_offset_t,
      o.hoist_cell_gain, o.crowd_cell_gain, o.door_leak,  o.hoist_law,      o.crowd_law};
  const std::vector<analysis::signals::Pass> found = analysis::signals::find_passes(pass_signals);
  std::vector<analysis::signals::TimeSpan> spans;
  for (const analysis::signals::Pass& p : found) spans.push_back({p.t_start_s, p.t_end_s});
  analysis::signals::DriveSignals drives = plain;
  if (o.door_leak > 0)
    analysis::signals::leak(o.door_leak, pass_signals, found, monitor_of(run), drives);
  std::string signals = "time_s,hoist_m,crowd_m,swing_rad,hoist_force_kN,crowd_force_kN\n";
  for (const analysis::signals::LoggedSample& l :
       analysis::signals::log_signals(drives, instruments, spans)) {
    signals += fmt::format("{:.6g},{:.5f},{:.5f},{:.6f},{:.4f},{:.4f}\n", l.time_s, l.hoist_m,
                           l.crowd_m, l.swing_rad, l.hoist_force_kN, l.crowd_force_kN);
  }
  std::string passes = "pass,t_start_s,t_end_s,truck_mass_t\n";
  for (const analysis::signals::WeighedPass& p : analysis::signals::weigh(found, instruments)) {
    passes +=
        fmt::format("{},{:.4f},{:.4f},{:.5f}\n", p.pass, p.t_start_s, p.t_end_s, p.truck_mass_t);
  }
  fs::create_directories(out);
  const bool surveyed = write_profiles(run / "faces", drives, found, out);
  if (!surveyed) fs::remove(out / "profile.csv");  // of an earlier observation
  write_text(out / "channels.yaml", std::string(kChannels) + (surveyed ? kFaceChannel : ""));
  write_text(out / "signals.csv", signals);
  write_text(out / "passes.csv", passes);
}

void require_no_measured(const fs::path& out) {
  const std::string channels = read_bytes(out / "channels.yaml").value_or("");
  const std::string_view ours = kChannels, first_line = ours.substr(0, ours.find('\n'));
  if (channels.compare(0, first_line.size(), first_line) == 0) return;
  for (const char* name : {"channels.yaml", "passes.csv", "signals.csv", "profile.csv"})
    if (fs::exists(out / name))
      throw InputError(
          {{out / name, 0, "--out", "is no observation, and would be lost; name another folder"}});
}

void require_readings(const fs::path& record, double rate_Hz) {
  const auto time_s = analysis::run::read_drive_signals(record).drive.time_s;
  const double span_s = time_s.empty() ? 0 : time_s.back();
  if (rate_Hz * span_s >= 2) return;
  throw InputError(
      {{record, 0, "observation.rate_Hz",
        fmt::format("{:g} Hz gives no two readings of this run of {:.4g} s; write {:.2g} or more",
                    rate_Hz, span_s, kReadings / span_s)}});
}

void set_observation(cases::ObservationCase& observation, const cases::Override& set) {
  const cases::KeySpec* spec = cases::spec_of(set.key);
  if (spec == nullptr || spec->affects != cases::Affects::instruments) {
    throw std::invalid_argument(
        fmt::format("{}: not a key of the instruments; known are observation.{{{}}}", set.key,
                    fmt::join(cases::children_of("observation"), ", ")));
  }
  const std::string name = set.key.substr(set.key.rfind('.') + 1);
  if (cases::is_law(*spec) && !analysis::signals::is_drive_term(name))
    throw std::invalid_argument(set.key + ": " + cases::no_term(name));
  cases::Case c;
  c.observation = observation;
  double value = 0;
  if (!parse_number(set.value, value) || !spec->range.holds(value)) {
    throw std::invalid_argument(fmt::format("{}: is '{}'; write {}, {}", set.key, set.value,
                                            spec->expected(), spec->range.text()));
  }
  *std::get<double*>(spec->slot(c, {0, name})) = value;
  observation = c.observation;
}

cases::ObservationCase read_observation(const fs::path& case_txt) {
  cases::ObservationCase observation;
  for (const CaseLine& line : CaseLines::read(case_txt)) {
    const cases::KeySpec* spec = cases::spec_of(line.key);
    if (spec == nullptr || spec->affects != cases::Affects::instruments) continue;
    try {
      set_observation(observation, {line.key, line.value});
    } catch (const std::invalid_argument& e) {
      throw InputError({{case_txt, line.line, "", e.what()}});
    }
  }
  return observation;
}

}  // namespace dipper::result

#include "coupler/run/machine_replay.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "analysis/run/run_folder.hpp"
#include "common/case_lines.hpp"
#include "common/input_error.hpp"
#include "common/record/columns.hpp"
#include "common/record/record.hpp"
#include "common/temporary_folder.hpp"
#include "coupler/result/observed.hpp"
#include "coupler/run/lone_machine.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/sides/dipper_layers.hpp"
#include "coupler/sides/sides_setup.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// The rock's mean wrench on a body, one row for each sync step.
class RecordedWrench {
 public:
  RecordedWrench(const record::Columns& record, const std::string& body) {
    for (std::size_t k = 0; k < 6; ++k) columns_[k] = record.get(channel(body), k);
  }
  static void read(record::Columns& record, const std::string& body) {
    for (std::size_t k = 0; k < 6; ++k) record.read(channel(body), k);
  }
  Wrench at(std::size_t row) const {
    const auto& c = columns_;
    return {{c[0][row], c[1][row], c[2][row]}, {c[3][row], c[4][row], c[5][row]}};
  }

 private:
  static std::string channel(const std::string& body) { return "bodies/" + body + "/wrench_mean"; }
  std::array<std::vector<double>, 6> columns_;
};

}  // namespace

cases::Case case_of_run(const fs::path& run, const std::string& case_folder,
                        const std::vector<cases::Override>& changes,
                        std::vector<Finding>& findings) {
  // The effects of the case have already changed the values in this text.
  std::vector<cases::Override> all = {{"effects", "{}"}};
  try {
    for (const CaseLine& line : CaseLines::read(run / "case.txt"))
      all.push_back({line.key, line.value});
  } catch (const InputError& e) {
    findings.insert(findings.end(), e.findings().begin(), e.findings().end());
  }
  const fs::path record = run / "record.h5";
  std::string folder = case_folder;
  if (folder.empty() && findings.empty()) folder = record::read_attribute(record, "case_folder");
  if (folder.empty())
    findings.push_back(
        {record, 0, "case_folder", "does not name the run's case; name it with --case"});
  all.insert(all.end(), changes.begin(), changes.end());
  if (!findings.empty()) return {};
  return cases::load_case(folder, all, findings);
}

void observe_changed_machine(const fs::path& run, const cases::Case& changed, const fs::path& out) {
  const fs::path record = run / "record.h5";
  record::Columns columns(record);
  columns.read("time_s");
  for (const char* body : {"dipper", "door"}) RecordedWrench::read(columns, body);
  const auto time_s = columns.get("time_s");
  if (time_s.empty()) throw InputError({{record, 0, "", "holds no rows"}});
  const RecordedWrench dipper(columns, "dipper"), door(columns, "door");

  setup::PeerConfig config = setup::read_peer_config(run / "logs" / "mbs.json");
  config.settings = to_json(sides::machine_setup(
      changed, sides::dipper_layers(changed, sides::read_mesh_facts(changed).dipper.cavity)));
  analysis::signals::DriveSignals s;
  {
    const TemporaryFolder scratch("dipper-replay");
    LoneMachine lone(config, scratch.path());
    const core::ServerInfo info = lone.machine().info();
    const auto put = [&](double t_s, const core::MachineState& state) {
      s.time_s.push_back(t_s);
      s.hoist_m.push_back(state.channels[core::channel_index(info, "hoist")]);
      s.crowd_m.push_back(state.channels[core::channel_index(info, "crowd")]);
      s.swing_rad.push_back(state.channels[core::channel_index(info, "swing")]);
      s.hoist_force_N.push_back(state.channels[core::channel_index(info, "hoist_force")]);
      s.crowd_force_N.push_back(state.channels[core::channel_index(info, "crowd_force")]);
    };
    put(time_s.at(0), lone.machine().state(0));
    // The corrected scheme repeats a sync step with its own mean wrench; the serial scheme uses the
    // wrench of the previous step.
    const std::size_t late = changed.coupling.scheme == core::Scheme::serial ? 1 : 0;
    for (std::size_t i = 1; i < time_s.size(); ++i) {
      core::MachineStep step{std::llround(time_s[i] * 1e9),
                             {dipper.at(i - late), door.at(i - late)}};
      step.step_index = static_cast<std::int64_t>(i) - 1;
      put(time_s[i], lone.machine().step(step));
    }
  }
  result::write_observed(s, analysis::run::read_drive_signals(record).pass, changed.observation,
                         run, out);
}

}  // namespace dipper::run

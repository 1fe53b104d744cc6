// The figures of a pass and of each of its phases, for summary.json, metrics.json, its CSV and the
// page.
#pragma once

#include <optional>
#include <vector>

#include "analysis/metrics/drive_limits.hpp"
#include "analysis/metrics/load_in_dipper.hpp"
#include "analysis/metrics/pass_signals.hpp"
#include "analysis/metrics/rattle.hpp"
#include "analysis/run/run_folder.hpp"
#include "analysis/signals/drive_work.hpp"
#include "analysis/signals/machine_demand.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "analysis/signals/payload_monitor.hpp"

namespace dipper::analysis::metrics {

/// Of a phase.
struct PhaseFigures {
  signals::Phase phase;
  Effort effort;
  double slack_fraction = 0;              ///< fraction of its time with slack hoist ropes
  std::optional<signals::Demand> demand;  ///< empty without the machine's data
  std::optional<LimitsMet> limits;        ///< empty if the drives have no limits
};

/// The payload by the shovel's own monitor.
struct MonitorFigures {
  signals::MonitorReading reading;
  double inside_kg = 0;  ///< rock in the dipper in that time
};

struct PassFigures {
  signals::PassPhases found;
  /// The payload divided by the mass of rock, at the settled pile's density, in the struck volume.
  std::optional<double> fill_factor;
  /// The same with the density of the load itself. Empty if no dump shows the load.
  std::optional<double> fill_factor_load;
  std::optional<LoadInDipper> load;
  std::optional<signals::DigEnergy> dig_energy;
  std::optional<signals::Demand> dig_demand;
  std::optional<double> dig_rattle_fraction;
  std::optional<MonitorFigures> monitor;
  std::vector<PhaseFigures> phases;  ///< as found.phases
};

/// Computes the figures of a run's passes from its signals and data of machine and rock.
class PassFigureMaker {
 public:
  struct Known {
    std::optional<machine::MachineData> machine;  ///< empty: neither monitor nor demand
    double rake_rad = 0;
    bool limited_drives = false;
    double struck_volume_m3 = 0;    ///< 0: not known
    double bulk_density_kg_m3 = 0;  ///< of the settled pile, with its fines; 0: not known
  };

  /// \param signals  must outlive this; complete (run::read_signals)
  /// \param record  of the same run. Throws std::runtime_error naming file and dataset.
  PassFigureMaker(const run::RunSignals& signals, const std::filesystem::path& record, Known known);

  /// \param load  of the pass; null if no dump shows it
  PassFigures figures(const signals::PassPhases& pass,
                      const std::optional<LoadInDipper>& load) const;

 private:
  PhaseFigures of_phase(const signals::Phase& phase) const;
  std::optional<signals::Demand> demand(const signals::TimeSpan& time) const;

  const run::RunSignals& signals_;
  Known known_;
  Rattle rattle_;
  std::optional<signals::PayloadMonitor> monitor_;
  std::optional<signals::MachineDemand> demand_;
  std::optional<DriveLimits> limits_;
};

}  // namespace dipper::analysis::metrics

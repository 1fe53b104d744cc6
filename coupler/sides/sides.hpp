// The two processes of a run.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "coupler/launch/mpirun.hpp"
#include "coupler/launch/process.hpp"
#include "coupler/setup/machine_setup.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "coupler/transport/remote.hpp"

namespace dipper::sides {

/// Input of both sides.
struct SidesSetup {
  std::string run_id;
  std::string case_hash;
  launch::MpiPlaces places;  ///< hosts of the ranks
  double timeout_s = 60;
  setup::RockSetup rock;
  setup::MachineSetup machine;
  std::filesystem::path logs;         ///< folder
  std::filesystem::path checkpoints;  ///< folder
  std::filesystem::path dem_screen;   ///< LIGGGHTS's output, with its errors
  std::string segment;                ///< "", or "-N" for a segment resumed after N sync steps
  std::filesystem::path message_log;  ///< all messages of the segment, as an LCM log
};

/// The two processes of a run and the links to them. Waiting on a link also watches both processes:
/// when one ends, PeerError names it and gives its last message.
class Sides {
 public:
  explicit Sides(const SidesSetup& setup);
  ~Sides();

  transport::RemoteMachine& machine() { return *machine_; }
  transport::RemoteRock& rock() { return *rock_; }
  const transport::Link& machine_link() const { return *mbs_link_; }
  const transport::Link& rock_link() const { return *dem_link_; }

  /// Sends "stop" to both and waits for their end.
  void stop();
  /// Ends the processes that still run.
  void end();
  /// CPU time so far of all ranks. Ranks on other hosts count as much as those here: ranks wait for
  /// each other at full load.
  double dem_cpu_s() const { return dem_->cpu_s() / setup_.places.part_here; }
  double mbs_cpu_s() const { return mbs_->cpu_s(); }

 private:
  void watch();
  /// What a side prints, in each segment of the run apart.
  std::filesystem::path log_of(const std::string& side) const;

  SidesSetup setup_;
  std::unique_ptr<transport::Transport> from_dem_, from_mbs_;
  std::unique_ptr<launch::Process> dem_, mbs_;
  std::unique_ptr<transport::Link> dem_link_, mbs_link_;
  std::unique_ptr<transport::RemoteMachine> machine_;
  std::unique_ptr<transport::RemoteRock> rock_;
};

}  // namespace dipper::sides

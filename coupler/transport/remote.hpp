// The two sides of a run when they live in other processes.
#pragma once

#include "coupler/core/server.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::transport {

class RemoteMachine final : public core::Machine {
 public:
  explicit RemoteMachine(Link& link);
  core::ServerInfo info() const override { return info_; }
  core::MachineState state() override;
  core::MachineState step(std::int64_t t_end_ns, const std::vector<Wrench>& F_Bo_W,
                          bool commit) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;
  void set_sync_time(const core::SyncTime& now) override { now_ = now; }
  void stop();  ///< may be called again until the process has ended

 private:
  Link& link_;
  core::ServerInfo info_;
  core::SyncTime now_;  ///< for the headers of messages
};

class RemoteRock final : public core::Rock {
 public:
  explicit RemoteRock(Link& link);
  core::ServerInfo info() const override { return info_; }
  core::RockState place(const std::vector<Pose>& X_WB) override;
  core::RockState step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) override;
  void save(const std::filesystem::path& file) override;
  std::string state_hash() override;
  void set_sync_time(const core::SyncTime& now) override { now_ = now; }
  void set_contact(bool on) override { contact_ = on; }
  void stop();  ///< may be called again until the process has ended

 private:
  core::RockState move(std::int64_t n_steps, const std::vector<Pose>& X_WB);
  Link& link_;
  core::ServerInfo info_;
  std::int64_t dt_ns_ = 0;
  core::SyncTime now_;
  bool contact_ = true;
};

}  // namespace dipper::transport

// The two sides of a run when they live in other processes.
#pragma once

#include "coupler/core/server.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::transport {

class RemoteMachine final : public core::Machine {
 public:
  explicit RemoteMachine(Link& link);
  core::ServerInfo info() const override { return info_; }
  core::MachineState state(std::int64_t t_next_ns) override;
  core::MachineState step(const core::MachineStep& step) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;
  void stop();  ///< may be called again until the process has ended

 private:
  Link& link_;
  core::ServerInfo info_;
  std::int64_t step_index_ = 0, t_ns_ = 0;  ///< of the last window, for the headers of commands
};

class RemoteRock final : public core::Rock {
 public:
  explicit RemoteRock(Link& link);
  core::ServerInfo info() const override { return info_; }
  core::RockState place(const std::vector<Pose>& X_WB) override;
  void start(const core::RockStep& step) override;
  core::RockState finish() override;
  void save(const std::filesystem::path& file) override;
  std::string state_hash() override;
  void stop();  ///< may be called again until the process has ended

 private:
  Link& link_;
  core::ServerInfo info_;
  std::int64_t step_index_ = 0, t_ns_ = 0;  ///< of the last window, for the headers of commands
};

}  // namespace dipper::transport

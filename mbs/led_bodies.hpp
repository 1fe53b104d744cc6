// Bodies that follow a table of poses, regardless of the forces on them.
#pragma once

#include <string>
#include <vector>

#include "coupler/core/server.hpp"
#include "machine/pose_table.hpp"

namespace dipper::mbs {

/// machine.kind poses: no mechanism, so no dynamics. The record has the rock's wrench on each body.
class LedBodies final : public core::Machine {
 public:
  /// Throws std::invalid_argument for a body without a row in the table.
  LedBodies(machine::PoseTable poses, std::vector<std::string> bodies);

  core::ServerInfo info() const override;
  core::MachineState state(std::int64_t t_next_ns) override;
  core::MachineState step(const core::MachineStep& step) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;

 private:
  machine::PoseTable poses_;
  std::vector<std::string> bodies_;
  std::int64_t t_ns_ = 0;
};

}  // namespace dipper::mbs

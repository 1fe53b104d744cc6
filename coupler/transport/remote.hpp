// The two sides of a run as clients of their processes.
#pragma once

#include "coupler/core/server.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::transport {

/// Common to both. The constructor asks the side for its description.
template <class Side>
class Remote : public Side {
 public:
  explicit Remote(Link& link);
  core::ServerInfo info() const override { return info_; }
  void save(const std::filesystem::path& file) override { command(core::Action::save, file); }
  /// May be called repeatedly until the process has ended.
  void stop() { link_.tell(core::Command{core::Action::stop, ""}, step_index_, t_ns_); }

 protected:
  /// The text of the reply.
  std::string command(core::Action action, const std::string& text = "");

  Link& link_;
  std::int64_t step_index_ = 0, t_ns_ = 0;  ///< of the last window, for the headers of commands
  core::ServerInfo info_;
};

class RemoteMachine final : public Remote<core::Machine> {
 public:
  using Remote::Remote;
  core::MachineState state(std::int64_t t_next_ns) override;
  core::MachineState step(const core::MachineStep& step) override;
  void load(const std::filesystem::path& file) override { command(core::Action::load, file); }
  void follow(const std::string& rows) override { command(core::Action::follow, rows); }
};

class RemoteRock final : public Remote<core::Rock> {
 public:
  using Remote::Remote;
  core::RockState place(const std::vector<Pose>& X_WB) override;
  void start(const core::RockStep& step) override;
  core::RockState finish() override;
  HeightMap look(const HeightGrid& grid) override {
    return height_map_from(command(core::Action::look, to_json_text(grid)));
  }
  std::string state_hash() override { return command(core::Action::hash); }
};

}  // namespace dipper::transport

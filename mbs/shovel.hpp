// The shovel's interface to the master: wrenches of the rock in, motion of dipper and door out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "coupler/core/server.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/operator.hpp"

namespace dipper::mbs {

constexpr std::int64_t kLongestSubstep_ns = 1'200'000;

/// Bodies "dipper" (frame B) and "door" (frame D); the pose of each is X_WB, X_WD.
///
/// At construction the shovel stands still with the drives as at t = 0 and the saddle angle at
/// which the stretched ropes carry the weight. Its drives are prescribed, or go where an operator
/// (operator.hpp) sends them within their limits (limited_drives.hpp); then there are
/// more channels, of both.
///
/// Powers: a drive's is positive when it puts energy into the machine. Works (drive_work,
/// interface_work, dissipated_energy) are integrated from t = 0 along with the motion, and
/// energy_residual = energy gained - drive_work - interface_work + dissipated_energy is the
/// integrator's error.
///
/// Errors: std::runtime_error naming what, where, when if a wrench or the result is not finite,
/// or a joint leaves the range in which the ropes' path exists; std::invalid_argument for a wrong
/// number of wrenches or a window that does not go forward.
class Shovel : public core::Machine {
 public:
  /// \param X_W0 pose of the crawlers' ring (the house at swing 0) in W
  /// \param rake handle centre line to dipper floor, rad
  /// \param max_substep_ns the longest integrator step; windows are cut into equal ones.
  ///        The stiffest mode, the empty dipper on the ropes, has a period of about 200 ms.
  /// \param contact_on_return  whether the bodies meet rock on the motion's way back from the truck
  ///        (machine/return_legs.hpp), where an operator comes later
  /// \param from  who sends limited drives; none: they are prescribed, by the motion
  Shovel(const machine::MachineData& machine, std::shared_ptr<machine::Motion> motion,
         const Pose& X_W0, double rake, std::unique_ptr<Operator> from,
         std::int64_t max_substep_ns = kLongestSubstep_ns, bool contact_on_return = true);

  /// The same; limited drives are sent by a PathFollower (path_follower.hpp).
  Shovel(const machine::MachineData& machine, machine::Motion motion, const Pose& X_W0, double rake,
         std::int64_t max_substep_ns = kLongestSubstep_ns,
         machine::DriveMode mode = machine::DriveMode::prescribed, bool contact_on_return = true);
  ~Shovel() override;

  core::ServerInfo info() const override;
  core::MachineState state(std::int64_t t_next_ns) override;
  core::MachineState step(const core::MachineStep& step) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;
  /// Throws InputError for rows that are none, std::invalid_argument for rows that are not later.
  void follow(const std::string& rows) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dipper::mbs

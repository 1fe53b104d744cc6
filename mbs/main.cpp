// dipper-mbs CONFIG: the machine side of a paired run.
#include <fmt/core.h>

#include <memory>
#include <utility>
#include <variant>

#include "common/angles.hpp"
#include "coupler/setup/machine_setup.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/serve.hpp"
#include "machine/machine_condition.hpp"
#include "machine/motion.hpp"
#include "mbs/feeling_operator.hpp"
#include "mbs/led_bodies.hpp"
#include "mbs/path_follower.hpp"
#include "mbs/program_operator.hpp"
#include "mbs/shovel.hpp"

namespace dipper::mbs {
namespace {

std::unique_ptr<core::Machine> make(const setup::ShovelSetup& s) {
  Pose X_W0;
  X_W0.p = s.base_position_m;
  const machine::MachineData data =
      machine::in_condition(machine::load_machine(s.model), s.condition);
  const machine::Motion whole = machine::Motion::load(s.motion);
  const auto motion = std::make_shared<machine::Motion>(s.planned ? whole.standing() : whole);
  std::unique_ptr<Operator> from;
  if (s.program_drives)
    from = std::make_unique<ProgramOperator>(motion->value(0));
  else if (s.drives == machine::DriveMode::limited && s.planned)
    from = std::make_unique<FeelingOperator>(motion, data, radians(s.rake_angle_deg), s.full_kg);
  else if (s.drives == machine::DriveMode::limited)
    from = std::make_unique<PathFollower>(motion, data.limits.crowd_min);
  return std::make_unique<Shovel>(data, motion, X_W0, radians(s.rake_angle_deg), std::move(from),
                                  kLongestSubstep_ns, s.contact_on_return);
}

std::unique_ptr<core::Machine> make(const setup::PosesSetup& s) {
  return std::make_unique<LedBodies>(machine::PoseTable::load(s.table), s.bodies);
}

void run(const char* config_file) {
  const setup::PeerConfig config = setup::read_peer_config(config_file);
  const auto machine =
      std::visit([](const auto& s) { return make(s); }, setup::machine_setup_from(config.settings));
  transport::LcmTransport lcm(config.lcm_url, transport::Channels::to_mbs, config.secret);
  transport::serve(lcm, transport::Channels::from_mbs, config.checkpoints,
                   [&](const core::Message& m) { return transport::answer(*machine, m); });
}

}  // namespace
}  // namespace dipper::mbs

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: dipper-mbs CONFIG   (started by `dipper run`)\n");
    return 2;
  }
  try {
    dipper::mbs::run(argv[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "dipper-mbs: {}\n", e.what());
    return 3;
  }
  return 0;
}

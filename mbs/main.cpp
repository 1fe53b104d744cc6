// dipper-mbs CONFIG: the machine side of a paired run.
#include <fmt/core.h>

#include "common/angles.hpp"
#include "common/json_values.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/serve.hpp"
#include "machine/machine_condition.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/shovel.hpp"

namespace dipper::mbs {
namespace {

void run(const char* config_file) {
  const setup::PeerConfig config = setup::read_peer_config(config_file);
  const auto& settings = config.settings;
  Pose X_W0;
  X_W0.p = vector_from(settings.at("base_position_m"));
  const double rake = radians(settings.at("rake_angle_deg").get<double>());
  machine::MachineCondition condition;
  condition.crowd_friction_N = settings.at("crowd_friction_N").get<double>();
  condition.hoist_loss = settings.at("hoist_loss").get<double>();
  condition.rope_compliance = settings.at("rope_compliance").get<double>();
  condition.added_mass_kg = settings.at("added_mass_kg").get<double>();
  condition.added_center_m = vector_from(settings.at("added_center_m"));
  condition.added_inertia_kg_m2 = vector_from(settings.at("added_inertia_kg_m2"));
  Shovel shovel(machine::in_condition(
                    machine::load_machine(settings.at("model").get<std::string>()), condition),
                machine::Motion::load(settings.at("motion").get<std::string>()), X_W0, rake,
                kLongestSubstep_ns,
                machine::drive_mode_from(settings.value("drives", "prescribed")),
                settings.value("contact_on_return", "on") == "on");
  transport::LcmTransport lcm(config.lcm_url, transport::Channels::to_mbs, config.secret);
  transport::serve(lcm, transport::Channels::from_mbs, config.checkpoints,
                   [&](const core::Message& m) { return transport::answer(shovel, m); });
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

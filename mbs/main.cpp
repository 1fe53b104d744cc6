// dipper-mbs CONFIG: the machine side of a paired run.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupler/motion/machine_data.hpp"
#include "coupler/motion/motion.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/peer_config.hpp"
#include "coupler/transport/serve.hpp"
#include "mbs/shovel.hpp"

namespace dipper {
namespace {

void run(const char* config_file) {
  const PeerConfig config = read_peer_config(config_file);
  const auto& settings = config.settings;
  const auto base = settings.at("base_position_m").get<std::array<double, 3>>();
  Pose X_W0;
  X_W0.p = Vector3d(base[0], base[1], base[2]);
  const double rake = settings.at("rake_angle_deg").get<double>() * M_PI / 180;
  Shovel shovel(load_machine(settings.at("model").get<std::string>()),
                Motion::load(settings.at("motion").get<std::string>()), X_W0, rake);
  LcmTransport transport(config.lcm_url, {Channels::to_mbs});
  serve(transport, Channels::to_mbs, Channels::from_mbs, config.identity,
        [&](const Message& m) { return answer(shovel, m); });
}

}  // namespace
}  // namespace dipper

int main(int argc, char** argv) {
  dipper::die_with_parent();
  if (argc != 2) {
    fmt::print(stderr, "usage: dipper-mbs CONFIG   (started by `dipper run`)\n");
    return 2;
  }
  try {
    dipper::run(argv[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "dipper-mbs: {}\n", e.what());
    return 3;
  }
  return 0;
}

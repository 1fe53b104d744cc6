#include "coupler/run/lone_machine.hpp"

#include "common/installation.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/transport/sealed_transport.hpp"

namespace dipper::run {

LoneMachine::LoneMachine(const transport::PeerConfig& config, const std::filesystem::path& folder)
    : log_(folder / "mbs.log"),
      process_((transport::write_peer_config(folder / "mbs.json", config),
                std::vector<std::string>{installed_program("dipper-mbs"),
                                         (folder / "mbs.json").string()}),
               log_),
      transport_(
          transport::sealed_lcm(config.lcm_url, config.secret, transport::Channels::from_mbs)),
      link_("mbs", *transport_, transport::Channels::to_mbs, transport::Channels::from_mbs,
            config.identity, options()),
      machine_(link_) {}

LoneMachine::~LoneMachine() {
  machine_.stop();
  process_.wait(std::chrono::seconds(5));
  process_.end();
}

transport::LinkOptions LoneMachine::options() {
  transport::LinkOptions o;
  o.watch = [this] {
    if (process_.ended())
      throw transport::PeerError("mbs", launch::failure_message(process_, log_));
    if (launch::interrupts() > 1) throw launch::Interrupted();
  };
  return o;
}

}  // namespace dipper::run

#include "coupler/run/lone_machine.hpp"

#include "common/installation.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/interrupt.hpp"

namespace dipper::run {

LoneMachine::LoneMachine(const setup::PeerConfig& config, const std::filesystem::path& folder)
    : log_(folder / "mbs.log"),
      process_((setup::write_peer_config(folder / "mbs.json", config),
                std::vector<std::string>{installed_program("dipper-mbs"),
                                         (folder / "mbs.json").string()}),
               log_),
      transport_(config.lcm_url, transport::Channels::from_mbs, config.secret),
      link_("mbs", transport_, transport::Channels::to_mbs, config.identity, options()),
      machine_(link_) {}

LoneMachine::~LoneMachine() {
  try {
    machine_.stop();
  } catch (const transport::PeerError&) {  // it has ended already
  }
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

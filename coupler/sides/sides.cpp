#include "coupler/sides/sides.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <lcm/lcm-cpp.hpp>

#include "common/installation.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/lcm_transport.hpp"

namespace dipper::sides {
namespace {

/// A log of messages that only its owner can read, since it contains the run's results.
std::shared_ptr<lcm::LogFile> open_log(const std::filesystem::path& file) {
  const mode_t old = umask(077);
  auto log = std::make_shared<lcm::LogFile>(file.string(), "w");
  umask(old);
  if (!log->good()) throw std::runtime_error("cannot write " + file.string());
  return log;
}

void write(lcm::LogFile& log, const std::filesystem::path& file, transport::Packet packet) {
  lcm::LogEvent event;
  event.channel = packet.channel;
  event.timestamp = std::chrono::duration_cast<std::chrono::microseconds>(
                        std::chrono::system_clock::now().time_since_epoch())
                        .count();
  event.data = packet.bytes.data();
  event.datalen = static_cast<std::int32_t>(packet.bytes.size());
  errno = 0;
  if (log.writeEvent(&event) != 0)
    throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno));
}

}  // namespace

Sides::Sides(const SidesSetup& setup) : setup_(setup) {
  const std::string url = transport::kLcmUrl;
  core::Envelope identity;
  identity.run_id = setup.run_id;
  identity.case_hash = setup.case_hash;

  const std::string secret = setup::random_secret();
  const auto listen = [&](const char* channel) {
    return std::make_unique<transport::LcmTransport>(url, channel, secret);
  };
  from_dem_ = listen(transport::Channels::from_dem);
  from_mbs_ = listen(transport::Channels::from_mbs);
  const auto dem_config = setup.logs / ("dem" + setup.segment + ".json");
  const auto mbs_config = setup.logs / ("mbs" + setup.segment + ".json");
  setup::write_peer_config(dem_config,
                           {url, secret, identity, setup.checkpoints, to_json(setup.rock)});
  setup::write_peer_config(mbs_config,
                           {url, secret, identity, setup.checkpoints, to_json(setup.machine)});
  std::filesystem::remove(setup.dem_screen);  // its errors would be taken for this start's
  dem_ = std::make_unique<launch::Process>(
      launch::mpirun(setup.rock.ranks, {installed_program("dipper-dem"), dem_config.string()},
                     setup.places),
      log_of("dem"),
      setup.logs);  // working folder: LIGGGHTS writes a restart file there when it is ended
  mbs_ = std::make_unique<launch::Process>(
      std::vector<std::string>{installed_program("dipper-mbs"), mbs_config.string()},
      log_of("mbs"));

  transport::LinkOptions options;
  options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * setup.timeout_s));
  options.watch = [this] { watch(); };
  options.wants_end = [] { return launch::interrupts() > 0; };
  options.record = [this, log = open_log(setup.message_log)](const transport::Packet& packet) {
    write(*log, setup_.message_log, packet);
  };
  options.starved = [this] { return std::chrono::duration<double>(dem_->starved_s()); };
  dem_link_ = std::make_unique<transport::Link>("dem", *from_dem_, transport::Channels::to_dem,
                                                identity, options);
  options.starved = [this] { return std::chrono::duration<double>(mbs_->starved_s()); };
  mbs_link_ = std::make_unique<transport::Link>("mbs", *from_mbs_, transport::Channels::to_mbs,
                                                identity, options);
  machine_ = std::make_unique<transport::RemoteMachine>(*mbs_link_);
  rock_ = std::make_unique<transport::RemoteRock>(*dem_link_);
}

std::filesystem::path Sides::log_of(const std::string& side) const {
  return setup_.logs / (side + setup_.segment + ".log");
}

Sides::~Sides() = default;  // ends the processes

void Sides::watch() {
  if (dem_->ended())
    throw transport::PeerError("dem",
                               launch::failure_message(*dem_, log_of("dem"), setup_.dem_screen));
  if (mbs_->ended())
    throw transport::PeerError("mbs", launch::failure_message(*mbs_, log_of("mbs")));
  if (launch::interrupts() > 1) throw launch::Interrupted();
}

void Sides::end() {
  mbs_->end();
  dem_->end();
}

void Sides::stop() {
  for (int said = 0; said < 200 && !(mbs_->ended() && dem_->ended()); ++said) {
    machine_->stop();  // no reply comes: repeated in case the first was lost
    rock_->stop();
    mbs_->wait(std::chrono::milliseconds(50));
    dem_->wait(std::chrono::milliseconds(50));
  }
  end();
}

}  // namespace dipper::sides

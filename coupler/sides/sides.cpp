#include "coupler/sides/sides.hpp"

#include <fmt/core.h>
#include <sys/random.h>

#include <array>
#include <chrono>

#include "common/installation.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/last_words.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/logged_transport.hpp"
#include "coupler/transport/peer_config.hpp"

namespace dipper::sides {
namespace {

constexpr const char* kLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the kernel gives no random bytes for a run token");
  }
  std::string token;
  for (const auto b : bytes) token += fmt::format("{:02x}", b);
  return token;
}

}  // namespace

Sides::Sides(const SidesSetup& setup) : setup_(setup) {
  const std::string url = kLcmUrl;
  core::Envelope identity;
  identity.run_token = random_token();
  identity.run_id = setup.run_id;
  identity.case_hash = setup.case_hash;

  const auto log = std::make_shared<lcm::LogFile>(setup.message_log.string(), "w");
  if (!log->good()) throw std::runtime_error("cannot write " + setup.message_log.string());
  const auto listen = [&](const char* channel) {
    return std::make_unique<transport::LoggedTransport>(
        std::make_unique<transport::LcmTransport>(url, std::vector<std::string>{channel}), log);
  };
  from_dem_ = listen(transport::Channels::from_dem);
  from_mbs_ = listen(transport::Channels::from_mbs);
  const auto dem_config = setup.logs / "dem.json";
  const auto mbs_config = setup.logs / "mbs.json";
  nlohmann::json dem = setup.dem;
  dem["ranks"] = setup.ranks;  // for a replay
  transport::write_peer_config(dem_config, {url, identity, dem});
  transport::write_peer_config(mbs_config, {url, identity, setup.mbs});
  dem_ = std::make_unique<launch::Process>(
      launch::mpirun(setup.ranks, {installed_program("dipper-dem"), dem_config.string()}),
      setup.logs / "dem.log");
  mbs_ = std::make_unique<launch::Process>(
      std::vector<std::string>{installed_program("dipper-mbs"), mbs_config.string()},
      setup.logs / "mbs.log");

  transport::LinkOptions options;
  options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * setup.timeout_s));
  options.watch = [this] { watch(); };
  dem_link_ = std::make_unique<transport::Link>("dem", *from_dem_, transport::Channels::to_dem,
                                                transport::Channels::from_dem, identity, options);
  mbs_link_ = std::make_unique<transport::Link>("mbs", *from_mbs_, transport::Channels::to_mbs,
                                                transport::Channels::from_mbs, identity, options);
  machine_ = std::make_unique<transport::RemoteMachine>(*mbs_link_);
  rock_ = std::make_unique<transport::RemoteRock>(*dem_link_);
}

Sides::~Sides() = default;  // the processes end with their handles

void Sides::watch() {
  check(*dem_, "dem", setup_.logs / "dem.log", setup_.dem_screen);
  check(*mbs_, "mbs", setup_.logs / "mbs.log", {});
  if (launch::interrupts() > 1) throw launch::Interrupted();
}

void Sides::check(launch::Process& process, const std::string& side,
                  const std::filesystem::path& log, const std::filesystem::path& screen) {
  const auto end = process.ended();
  if (!end) return;
  const std::string words = launch::last_words(log, screen);
  throw transport::PeerError(side, words.empty() ? *end : fmt::format("{} ({})", words, *end));
}

void Sides::end() {
  mbs_->end();
  dem_->end();
}

void Sides::stop() {
  machine_->stop();
  rock_->stop();
  for (auto* process : {mbs_.get(), dem_.get()}) {
    if (!process->wait(std::chrono::seconds(20))) process->end();
  }
}

}  // namespace dipper::sides

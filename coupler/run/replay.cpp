#include "coupler/run/replay.hpp"

#include <fmt/core.h>

#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>

#include "common/input_error.hpp"
#include "common/installation.hpp"
#include "common/numbers.hpp"
#include "common/temporary_folder.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/mpirun.hpp"
#include "coupler/launch/process.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "coupler/transport/codec.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// A request and the answer it got.
struct Exchange {
  core::Message request;
  core::Body reply;
  std::int64_t asked_us = 0, answered_us = 0;
};

/// A side's exchanges in order; resent requests and repeated replies count once.
std::vector<Exchange> read_log(const fs::path& file, const std::string& to,
                               const std::string& from) {
  lcm::LogFile log(file.string(), "r");
  if (!log.good()) {
    throw InputError({{file, 0, "", "no recording to replay: it cannot be read"}});
  }
  std::map<std::int64_t, Exchange> by_number;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (event->channel != to && event->channel != from) continue;
    core::Message m;
    try {
      m = transport::decode(
          {static_cast<const char*>(event->data), static_cast<std::size_t>(event->datalen)});
    } catch (const transport::DecodeError& e) {
      throw std::runtime_error(file.string() + ": " + e.what());
    }
    Exchange& e = by_number[m.envelope.sequence];
    if (event->channel == to && e.asked_us == 0) {
      e.asked_us = event->timestamp;
      e.request = std::move(m);
    } else if (event->channel == from && e.answered_us == 0) {
      e.answered_us = event->timestamp;
      e.reply = std::move(m.body);
    }
  }
  std::vector<Exchange> all;
  for (auto& [number, e] : by_number) {
    if (e.asked_us == 0 || e.answered_us == 0)
      break;  // the recording ends here: "stop", or a fault
    all.push_back(std::move(e));
  }
  return all;
}

/// The segments of a run in order, by the suffix of their files: "", then "-N" for each one resumed
/// after N sync steps.
std::vector<std::string> segments(const fs::path& run) {
  std::map<std::int64_t, std::string> by_start;
  for (const auto& entry : fs::directory_iterator(run)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".lcmlog" || name.rfind("events", 0) != 0) continue;
    const std::string segment = name.substr(6);
    std::int64_t start = -1;
    if (segment.empty() || (segment[0] == '-' && parse_number(segment.substr(1), start)))
      by_start[start] = segment;  // not a copy of the user's
  }
  std::vector<std::string> all;
  for (const auto& [start, segment] : by_start) all.push_back(segment);
  return all;
}

/// The setup with all output of the rock side directed to `scratch`.
setup::RockSetup redirected(setup::RockSetup rock, const fs::path& scratch) {
  rock.log = (scratch / "dem.liggghts").string();
  rock.screen = (scratch / "dem.screen").string();
  for (auto& [name, value] : rock.variables)
    if (name == "out") value = scratch.string();
  return rock;
}

void compare(const core::Body& now, const core::Body& before, ReplayResult& result) {
  if (transport::encode({{}, now}) != transport::encode({{}, before})) ++result.different;
  const auto* a = std::get_if<core::RockState>(&now);
  const auto* b = std::get_if<core::RockState>(&before);
  for (std::size_t i = 0; a != nullptr && b != nullptr && i < a->bodies.size(); ++i) {
    const auto off = (a->bodies[i].mean.force - b->bodies[i].mean.force).cwiseAbs().maxCoeff();
    result.force_N = std::max(result.force_N, off);
    result.position_m = std::max(result.position_m,
                                 (a->bodies[i].X_WB.p - b->bodies[i].X_WB.p).cwiseAbs().maxCoeff());
  }
  const auto* c = std::get_if<core::MachineState>(&now);
  const auto* d = std::get_if<core::MachineState>(&before);
  for (std::size_t i = 0; c != nullptr && d != nullptr && i < c->bodies.size(); ++i) {
    result.position_m = std::max(result.position_m,
                                 (c->bodies[i].X_WB.p - d->bodies[i].X_WB.p).cwiseAbs().maxCoeff());
  }
}

bool is_window(const Exchange& e) { return !std::holds_alternative<core::Command>(e.request.body); }

/// Where a run was, and where its folder is now.
struct Move {
  std::string from, to;
  std::string operator()(const std::string& path) const {
    return path.rfind(from + "/", 0) == 0 ? to + path.substr(from.size()) : path;
  }
  void operator()(nlohmann::json& j) const {
    if (j.is_string()) j = (*this)(j.get<std::string>());
    if (j.is_structured())
      for (auto& part : j) (*this)(part);
  }
};

/// The request with its file names directed to `scratch`; a file that it reads is copied there.
core::Body redirected(core::Body request, const Move& moved, const fs::path& scratch) {
  auto* c = std::get_if<core::Command>(&request);
  if (c == nullptr || (c->action != core::Action::save && c->action != core::Action::load))
    return request;
  const fs::path file = moved(c->text);
  c->text = (scratch / file.filename()).string();
  if (c->action == core::Action::load) {
    fs::copy_file(file, c->text, fs::copy_options::overwrite_existing);
  }
  return request;
}

void replay_segment(const fs::path& run, const std::string& side, const std::string& segment,
                    ReplayResult& result) {
  const bool dem = side == "dem";
  const char* to = dem ? transport::Channels::to_dem : transport::Channels::to_mbs;
  const char* from = dem ? transport::Channels::from_dem : transport::Channels::from_mbs;
  const auto exchanges = read_log(run / ("events" + segment + ".lcmlog"), to, from);
  setup::PeerConfig config = setup::read_peer_config(run / "logs" / (side + segment + ".json"));
  const Move moved{config.checkpoints.parent_path().string(), fs::absolute(run).string()};
  moved(config.settings);
  const TemporaryFolder temporary("dipper-replay");
  const fs::path& scratch = temporary.path();
  int ranks = 1;
  if (dem) {
    const auto rock = redirected(setup::rock_setup_from(config.settings), scratch);
    ranks = rock.ranks;
    config.settings = to_json(rock);
  }
  config.checkpoints = scratch;
  const fs::path config_file = scratch / (side + ".json");
  setup::write_peer_config(config_file, config);

  const fs::path log = scratch / (side + ".log");
  const std::vector<std::string> command = {installed_program("dipper-" + side),
                                            config_file.string()};
  launch::Process process(dem ? launch::mpirun(ranks, command) : command, log);
  transport::LcmTransport lcm(config.lcm_url, from, config.secret);
  transport::LinkOptions options;
  options.timeout = std::chrono::minutes(10);
  options.watch = [&] {
    if (process.ended())
      throw transport::PeerError(side,
                                 launch::failure_message(process, log, scratch / "dem.screen"));
  };
  transport::Link link(side, lcm, to, config.identity, options);

  // After the earlier segments.
  const double wall_s = result.wall_s, recorded_wall_s = result.recorded_wall_s;
  std::optional<std::chrono::steady_clock::time_point> began;
  std::int64_t recorded_us = 0;
  for (const auto& e : exchanges) {
    if (is_window(e) && !began) {
      began = std::chrono::steady_clock::now();
      recorded_us = e.asked_us;
    }
    const core::Body reply = link.ask(redirected(e.request.body, moved, scratch),
                                      e.request.envelope.step_index, e.request.envelope.t_ns);
    ++result.requests;
    if (!is_window(e)) continue;
    ++result.windows;
    compare(reply, e.reply, result);
    result.wall_s =
        wall_s + std::chrono::duration<double>(std::chrono::steady_clock::now() - *began).count();
    result.recorded_wall_s =
        recorded_wall_s + static_cast<double>(e.answered_us - recorded_us) * 1e-6;
  }
  link.tell(core::Command{core::Action::stop, ""}, 0, 0);
  process.wait(std::chrono::seconds(20));
  process.end();
  ++result.segments;
}

}  // namespace

ReplayResult replay(const fs::path& run, const std::string& side) {
  ReplayResult result;
  if (fs::is_directory(run)) {
    for (const std::string& segment : segments(run)) replay_segment(run, side, segment, result);
  }
  if (result.segments == 0)
    throw InputError({{run, 0, "", "no recording to replay: it has no events.lcmlog"}});
  if (result.windows == 0)
    throw InputError({{run, 0, "", "no recording to replay: it has no sync step"}});
  return result;
}

}  // namespace dipper::run

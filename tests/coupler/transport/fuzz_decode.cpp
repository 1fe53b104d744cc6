// fuzz_decode INPUTS [SEED]: what comes in from the network and from recordings, damaged in every
// way, given to all that reads it. Ends with status 0 when each input was read or refused; built
// with sanitizers (scripts/bench/fuzz) it also ends on the first read or write out of place.
#include <fmt/core.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "coupler/setup/info_json.hpp"
#include "coupler/transport/codec.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "tests/coupler/transport/memory_transport.hpp"

namespace dipper::transport {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : static_cast<std::size_t>(random() % n);
}

std::vector<std::string> whole_messages() {
  const core::Envelope envelope{"run", std::string(64, 'a'), 12, 34, 56};
  core::MachineState machine;
  machine.bodies.resize(2);
  machine.X_WB_next.resize(2);
  machine.channels = {1, 2, 3};
  core::RockState rock;
  rock.bodies.resize(2);
  rock.channels = {4, 5};
  const std::vector<Pose> poses(2);
  core::ServerInfo info;
  info.version = "LIGGGHTS 3.8";
  info.bodies = {"dipper", "door"};
  info.channels = {{"mass", "kg", "-"}};
  std::vector<std::string> all;
  for (const core::Body& body :
       {core::Body{machine}, core::Body{rock}, core::Body{core::MachineState{}},
        core::Body{core::MachineStep{0, {{}, {}}}}, core::Body{core::RockPlace{poses}},
        core::Body{core::RockStep{1, poses}},
        core::Body{core::Command{core::Action::save, "checkpoints/000000600/rock.restart"}},
        core::Body{core::Status{true, setup::to_json(info)}}}) {
    all.push_back(encode({envelope, body}));
  }
  all.push_back(setup::to_json(info));
  return all;
}

/// One to four damages, one after the other.
std::string damaged(std::string s, const std::vector<std::string>& others, Random& random) {
  for (auto n = 1 + below(random, 4); n > 0; --n) {
    const std::size_t at = below(random, s.size());
    switch (below(random, 7)) {
      case 0:  // a bit
        if (!s.empty()) s[at] = static_cast<char>(s[at] ^ (1 << below(random, 8)));
        break;
      case 1:  // a byte
        if (!s.empty()) s[at] = static_cast<char>(random());
        break;
      case 2:  // a cut
        s.resize(at);
        break;
      case 3: {  // a length, a count: at either end of what 32 bits hold, or a little off
        constexpr std::uint32_t kWild[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffff8};
        const std::uint32_t n32 =
            below(random, 2) ? kWild[below(random, 6)] : static_cast<std::uint32_t>(random() % 64);
        for (std::size_t k = 0; k < 4 && at + k < s.size(); ++k) {
          s[at + k] = static_cast<char>(n32 >> (24 - 8 * k));
        }
        break;
      }
      case 4:  // more
        s.append(below(random, 100), static_cast<char>(random()));
        break;
      case 5: {  // the end of another one
        const std::string& other = others[below(random, others.size())];
        s = s.substr(0, at) + other.substr(below(random, other.size()));
        break;
      }
      default:  // noise
        s.resize(below(random, 300));
        for (char& c : s) c = static_cast<char>(random());
    }
  }
  return s;
}

/// What is made of the input, by the reader that the draw names.
std::string fed(const std::string& input, std::size_t reader) {
  try {
    switch (reader) {
      case 0: {
        const core::Message m = decode(input);
        core::require_sound(m, "side", {});
        // What is understood is understood the same way again. (A truth value may be any byte.)
        const std::string again = encode(m);
        if (again.size() != input.size() || encode(decode(again)) != again) std::abort();
        return "message understood";
      }
      case 1: {
        const auto packet = read_lcm_packet("LC02\x01\x02\x03\x04" + input);
        if (!packet) return "packet refused";
        decode(packet->bytes);
        return "packet with a message";
      }
      case 2:
        return read_lcm_packet(input) ? "packet read" : "packet refused";
      default:
        setup::info_from_json(input);
        return "description understood";
    }
  } catch (const DecodeError&) {
    return "message refused";
  } catch (const nlohmann::json::exception&) {
    return "description refused";
  } catch (const std::runtime_error&) {
    return "message of no sound numbers";
  }
}

}  // namespace
}  // namespace dipper::transport

int main(int argc, char** argv) {
  using namespace dipper::transport;
  const long inputs = argc > 1 ? std::atol(argv[1]) : 20000;
  Random random(argc > 2 ? static_cast<unsigned long>(std::atol(argv[2])) : 1);
  const std::vector<std::string> seeds = whole_messages();
  std::map<std::string, long> counts;

  MemoryNetwork network;
  const auto stranger = network.connect({});
  const auto sealed = network.connect({"A"}, "secret");
  for (long k = 0; k < inputs; ++k) {
    const std::string input = damaged(seeds[below(random, seeds.size())], seeds, random);
    ++counts[fed(input, below(random, 4))];
    if (k % 8 != 0) continue;
    stranger->publish("A", input);
    if (sealed->receive(std::chrono::microseconds(0))) std::abort();  // nobody knows the secret
    ++counts["seal refused"];
  }
  for (const auto& [what, n] : counts) fmt::print("{:10}  {}\n", n, what);
  fmt::print("{:10}  inputs\n", inputs);
}

#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <vector>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// How badly a MemoryNetwork behaves: probabilities, each in [0, 1).
struct Faults {
  double drop = 0;
  double duplicate = 0;
  double reorder = 0;  ///< a message is held back and overtaken by the next one
  unsigned seed = 1;
};

/// A network in memory that loses, repeats and swaps messages as told; safe across threads.
class MemoryNetwork {
 public:
  explicit MemoryNetwork(Faults faults = {}) : faults_(faults), random_(faults.seed) {}
  /// An endpoint that hears the given channels. The network must outlive it.
  std::unique_ptr<Transport> connect(const std::set<std::string>& channels);

 private:
  class Endpoint;
  struct Inbox {
    std::set<std::string> channels;
    std::deque<Packet> packets;
    std::optional<Packet> held;
  };
  void publish(const Packet& packet);
  std::optional<Packet> receive(Inbox& inbox, std::chrono::microseconds timeout);

  Faults faults_;
  std::mt19937 random_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::shared_ptr<Inbox>> inboxes_;
};

}  // namespace dipper::transport

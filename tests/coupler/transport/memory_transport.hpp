#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "coupler/transport/seal.hpp"
#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// How badly a MemoryNetwork behaves: probabilities, each in [0, 1).
struct Faults {
  double drop = 0;
  double duplicate = 0;
  double reorder = 0;  ///< a message is held back and overtaken by the next one
  unsigned seed = 1;
};

/// A network in memory that loses, repeats and swaps messages as asked; safe across threads.
class MemoryNetwork {
 public:
  explicit MemoryNetwork(Faults faults = {}) : faults_(faults), random_(faults.seed) {}

  /// An endpoint that hears the given channels; with a secret it seals, and hears what is sealed
  /// only. The network must outlive it.
  std::unique_ptr<Transport> connect(const std::set<std::string>& channels,
                                     const std::string& secret = "") {
    const std::lock_guard lock(mutex_);
    inboxes_.push_back(std::make_shared<Inbox>());
    inboxes_.back()->channels = channels;
    return std::make_unique<Endpoint>(*this, inboxes_.back(), secret);
  }

  /// From then on every receive throws.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    arrived_.notify_all();
  }

 private:
  struct Inbox {
    std::set<std::string> channels;
    std::deque<Packet> packets;
    std::optional<Packet> held;
  };

  class Endpoint final : public Transport {
   public:
    Endpoint(MemoryNetwork& network, std::shared_ptr<Inbox> inbox, std::string secret)
        : network_(network), inbox_(std::move(inbox)), secret_(std::move(secret)) {}
    void publish(const std::string& channel, const std::string& bytes) override {
      Packet packet{channel, bytes};
      if (!secret_.empty()) seal(secret_, packet);
      network_.publish(packet);
    }
    std::optional<Packet> receive(std::chrono::microseconds timeout) override {
      while (auto packet = network_.receive(*inbox_, timeout)) {
        if (secret_.empty() || unseal(secret_, *packet)) return packet;
        ++foreign_;
      }
      return std::nullopt;
    }
    std::int64_t foreign() const override { return foreign_; }

   private:
    MemoryNetwork& network_;
    std::shared_ptr<Inbox> inbox_;
    std::string secret_;
    std::int64_t foreign_ = 0;
  };

  void publish(const Packet& packet) {
    const std::lock_guard lock(mutex_);
    std::uniform_real_distribution<double> chance(0, 1);
    for (auto& inbox : inboxes_) {
      if (inbox->channels.count(packet.channel) == 0) continue;
      if (chance(random_) < faults_.drop) continue;
      const int copies = chance(random_) < faults_.duplicate ? 2 : 1;
      for (int k = 0; k < copies; ++k) {
        if (!inbox->held && chance(random_) < faults_.reorder) {
          inbox->held = packet;
          continue;
        }
        inbox->packets.push_back(packet);
        if (inbox->held) {
          inbox->packets.push_back(*inbox->held);
          inbox->held.reset();
        }
      }
    }
    arrived_.notify_all();
  }

  std::optional<Packet> receive(Inbox& inbox, std::chrono::microseconds timeout) {
    std::unique_lock lock(mutex_);
    const auto ready = [&] { return closed_ || !inbox.packets.empty(); };
    if (!arrived_.wait_for(lock, timeout, ready)) return std::nullopt;
    if (closed_) throw std::runtime_error("the network is closed");
    Packet packet = std::move(inbox.packets.front());
    inbox.packets.pop_front();
    return packet;
  }

  Faults faults_;
  bool closed_ = false;
  std::mt19937 random_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::shared_ptr<Inbox>> inboxes_;
};

}  // namespace dipper::transport

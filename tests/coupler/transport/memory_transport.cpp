#include "tests/coupler/transport/memory_transport.hpp"

namespace dipper::transport {

class MemoryNetwork::Endpoint final : public Transport {
 public:
  Endpoint(MemoryNetwork& network, std::shared_ptr<Inbox> inbox)
      : network_(network), inbox_(std::move(inbox)) {}
  void publish(const std::string& channel, const std::string& bytes) override {
    network_.publish({channel, bytes});
  }
  std::optional<Packet> receive(std::chrono::microseconds timeout) override {
    return network_.receive(*inbox_, timeout);
  }

 private:
  MemoryNetwork& network_;
  std::shared_ptr<Inbox> inbox_;
};

std::unique_ptr<Transport> MemoryNetwork::connect(const std::set<std::string>& channels) {
  const std::lock_guard lock(mutex_);
  inboxes_.push_back(std::make_shared<Inbox>());
  inboxes_.back()->channels = channels;
  return std::make_unique<Endpoint>(*this, inboxes_.back());
}

void MemoryNetwork::publish(const Packet& packet) {
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

std::optional<Packet> MemoryNetwork::receive(Inbox& inbox, std::chrono::microseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, timeout, [&] { return !inbox.packets.empty(); })) {
    return std::nullopt;
  }
  Packet packet = std::move(inbox.packets.front());
  inbox.packets.pop_front();
  return packet;
}

}  // namespace dipper::transport

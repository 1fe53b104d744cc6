#include "coupler/transport/serve.hpp"

#include "coupler/transport/codec.hpp"
#include "coupler/transport/info_json.hpp"

namespace dipper {
namespace {

Body motion(const MachineState& s) { return TargetMotion{0, s.bodies, s.channels}; }
Body load(const RockState& s) { return WallWrench{s.step, false, s.bodies, s.channels}; }

template <class Side>
Body obey(Side& side, const Command& c) {
  switch (c.action) {
    case Action::hello:
      return Status{true, to_json(side.info())};
    case Action::save:
      side.save(c.file);
      return Status{};
    case Action::load:
      side.load(c.file);
      return Status{};
    case Action::stop:
      return Status{};
    default:
      throw ProtocolError("a command this side does not know");
  }
}

}  // namespace

Body answer(Machine& machine, const Message& request) {
  if (const auto* c = std::get_if<Command>(&request.body)) {
    return c->action == Action::state ? motion(machine.state()) : obey(machine, *c);
  }
  if (const auto* m = std::get_if<WallWrench>(&request.body)) {
    std::vector<Wrench> F_Bo_W;
    for (const auto& b : m->bodies) F_Bo_W.push_back(b.mean);
    return motion(machine.step(request.envelope.t_ns, F_Bo_W, m->commit));
  }
  throw ProtocolError("a machine answers wrenches and commands only");
}

Body answer(Rock& rock, const Message& request) {
  if (const auto* c = std::get_if<Command>(&request.body)) {
    return c->action == Action::hash ? Body{Status{true, rock.state_hash()}} : obey(rock, *c);
  }
  if (const auto* m = std::get_if<TargetMotion>(&request.body)) {
    std::vector<Pose> X_WB;
    for (const auto& b : m->bodies) X_WB.push_back(b.X_WB);
    return load(m->n_steps == 0 ? rock.place(X_WB) : rock.step(m->n_steps, X_WB));
  }
  throw ProtocolError("a rock answers motions and commands only");
}

void serve(Transport& transport, const std::string& in, const std::string& out,
           const Envelope& identity, const std::function<Body(const Message&)>& handle,
           const std::function<bool()>& alive) {
  Responder responder(identity);
  while (alive()) {
    const auto packet = transport.receive(std::chrono::milliseconds(50));
    if (!packet || packet->channel != in) continue;
    Message request;
    try {
      request = decode(packet->bytes);
    } catch (const DecodeError&) {
      continue;  // not one of ours: ours are whole
    }
    switch (responder.judge(request.envelope)) {
      case Responder::Verdict::ignore:
        continue;
      case Responder::Verdict::repeat:
        transport.publish(out, responder.reply());
        continue;
      case Responder::Verdict::execute:
        break;
    }
    try {
      require_sound(request, "the coupler", {});
      responder.remember(encode({request.envelope, handle(request)}));
    } catch (const std::exception& e) {
      transport.publish(out, encode({request.envelope, Status{false, e.what()}}));
      throw;
    }
    transport.publish(out, responder.reply());
    const auto* c = std::get_if<Command>(&request.body);
    if (c != nullptr && c->action == Action::stop) return;
  }
}

}  // namespace dipper

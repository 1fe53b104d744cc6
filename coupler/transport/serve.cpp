#include "coupler/transport/serve.hpp"

#include "coupler/core/protocol.hpp"
#include "coupler/setup/info_json.hpp"
#include "coupler/transport/codec.hpp"

namespace dipper::transport {
namespace {

template <class Side>
core::Body execute(Side& side, const core::Command& c) {
  if (c.action == core::Action::hello) return core::Status{true, setup::to_json(side.info())};
  if (c.action == core::Action::save) {
    side.save(c.text);
  } else if (c.action != core::Action::stop) {
    throw std::runtime_error("unknown command for this side");
  }
  return core::Status{};
}

void require_in_checkpoints(const core::Message& request, const std::filesystem::path& folder) {
  const auto* c = std::get_if<core::Command>(&request.body);
  if (c == nullptr || (c->action != core::Action::save && c->action != core::Action::load)) return;
  const auto file = std::filesystem::weakly_canonical(c->text);
  const auto below = file.lexically_relative(std::filesystem::weakly_canonical(folder));
  if (!below.empty() && *below.begin() != "..") return;
  throw std::runtime_error("refused to save or load " + file.string() + ": it is not below " +
                           folder.string());
}

}  // namespace

core::Body answer(core::Machine& machine, const core::Message& request) {
  if (const auto* step = std::get_if<core::MachineStep>(&request.body)) return machine.step(*step);
  if (const auto* c = std::get_if<core::Command>(&request.body)) {
    if (c->action == core::Action::state) return machine.state(request.envelope.t_ns);
    if (c->action == core::Action::follow) {
      machine.follow(c->text);
      return core::Status{};
    }
    if (c->action != core::Action::load) return execute(machine, *c);
    machine.load(c->text);
    return core::Status{};
  }
  throw std::runtime_error("a machine answers steps and commands only");
}

core::Body answer(core::Rock& rock, const core::Message& request) {
  if (const auto* step = std::get_if<core::RockStep>(&request.body)) {
    rock.start(*step);
    return rock.finish();
  }
  if (const auto* place = std::get_if<core::RockPlace>(&request.body))
    return rock.place(place->X_WB);
  if (const auto* c = std::get_if<core::Command>(&request.body)) {
    if (c->action == core::Action::hash) return core::Status{true, rock.state_hash()};
    if (c->action == core::Action::look)
      return core::Status{true, to_json_text(rock.look(height_grid_from(c->text)))};
    return execute(rock, *c);
  }
  throw std::runtime_error("a rock answers placement, steps and commands only");
}

void serve(Transport& transport, const std::string& out, const std::filesystem::path& checkpoints,
           const std::function<core::Body(const core::Message&)>& handle) {
  using Handling = core::Responder::Handling;
  core::Responder responder;
  std::string reply;
  for (bool stop = false; !stop;) {
    const auto packet = transport.receive(std::chrono::seconds(1));
    if (!packet) continue;
    const core::Message request = decode(packet->bytes);
    const Handling handling = responder.classify(request.envelope.sequence);
    if (handling == Handling::ignore) continue;
    if (handling == Handling::execute) {
      try {
        core::require_sound(request, "the coupler", {});
        require_in_checkpoints(request, checkpoints);
        reply = encode({request.envelope, handle(request)});
      } catch (const std::exception& e) {
        transport.publish(out, encode({request.envelope, core::Status{false, e.what()}}));
        throw;
      }
    }
    transport.publish(out, reply);
    const auto* c = std::get_if<core::Command>(&request.body);
    stop = c != nullptr && c->action == core::Action::stop;
  }
}

}  // namespace dipper::transport

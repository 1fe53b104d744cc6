#include "coupler/run/checkpointer.hpp"

#include <utility>

namespace dipper::run {

Checkpointer::Checkpointer(std::filesystem::path checkpoints, double every_s, Sources sources)
    : folder_(std::move(checkpoints)),
      every_s_(every_s),
      sources_(std::move(sources)),
      saved_ns_(sources_.coupling.t_ns()) {}

bool Checkpointer::needs_rest(const core::Window& w) const {
  const double since_s = static_cast<double>(w.rock.t_ns - saved_ns_) * 1e-9;
  return w.step_index > 0 && every_s_ > 0 && since_s >= every_s_ - 1e-9;
}

void Checkpointer::window(const core::Window& w) {
  if (!needs_rest(w)) return;
  save();
  saved_ns_ = w.rock.t_ns;
}

void Checkpointer::save() {
  sources_.record.sync();
  save_checkpoint(folder_,
                  {{},
                   sources_.coupling.state(),
                   sources_.record.position(),
                   sources_.cost(),
                   sources_.desk ? sources_.desk() : nlohmann::json()},
                  sources_.rock, sources_.machine);
}

}  // namespace dipper::run

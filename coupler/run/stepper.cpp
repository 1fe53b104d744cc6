#include "coupler/run/stepper.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dipper::run {

Stepper::Stepper(core::Coupling& coupling, std::int64_t window_steps, std::int64_t end_step)
    : coupling_(coupling), window_steps_(window_steps), end_step_(end_step) {}

void Stepper::tell(core::Window w) {
  last_ = std::move(w);
  for (Observer* o : observers_) o->window(last_);
}

const core::Window& Stepper::start() {
  tell(coupling_.start());
  return last_;
}

bool Stepper::at_end() const {
  return coupling_.state().dem_step >= end_step_ || (done_ && done_(coupling_.machine_state()));
}

bool Stepper::run(const std::function<bool()>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  while (!at_end() && !stop()) {
    core::Window w =
        coupling_.advance(std::min(window_steps_, end_step_ - coupling_.state().dem_step));
    wall_s_ = std::chrono::duration<double>(Clock::now() - began).count();
    tell(std::move(w));
  }
  for (Observer* o : observers_) o->end();
  return at_end();
}

}  // namespace dipper::run

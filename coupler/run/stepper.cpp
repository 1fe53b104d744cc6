#include "coupler/run/stepper.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dipper::run {

Stepper::Stepper(core::Coupling& coupling, std::int64_t window_steps, std::int64_t end_step)
    : coupling_(coupling), window_steps_(window_steps), end_step_(end_step) {}

void Stepper::notify() {
  if (notified_) return;
  notified_ = true;
  for (Observer* o : observers_) o->window(last_);
}

const core::Window& Stepper::start() {
  last_ = coupling_.start();
  notified_ = false;
  notify();
  return last_;
}

std::int64_t Stepper::steps_from(std::int64_t dem_step) const {
  // After an end within a sync step, the next one is shorter.
  return std::min(window_steps_ - dem_step % window_steps_, end_step_ - dem_step);
}

bool Stepper::at_end() const {
  return coupling_.state().dem_step >= end_step_ || (done_ && done_(coupling_.machine_state()));
}

bool Stepper::run(const std::function<bool()>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  while (!at_end() && !stop()) {
    const std::int64_t from = coupling_.state().dem_step, steps = steps_from(from);
    coupling_.begin(steps);
    notify();
    last_ = coupling_.finish(steps_from(from + steps));
    wall_s_ = std::chrono::duration<double>(Clock::now() - began).count();
    notified_ = false;
    if (std::any_of(observers_.begin(), observers_.end(),
                    [this](const Observer* o) { return o->needs_rest(last_); })) {
      notify();
    }
  }
  notify();
  for (Observer* o : observers_) o->end();
  return at_end();
}

}  // namespace dipper::run

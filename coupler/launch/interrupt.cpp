#include "coupler/launch/interrupt.hpp"

#include <csignal>

namespace dipper::launch {
namespace {

volatile std::sig_atomic_t count = 0;

void on_signal(int) { count = count + 1; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interrupts() { return count; }

}  // namespace dipper::launch

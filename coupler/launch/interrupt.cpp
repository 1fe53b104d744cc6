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
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup has ignored it
  // A run whose output nobody reads (`dipper run CASE | head`) continues.
  signal(SIGPIPE, SIG_IGN);
}

int interrupts() { return count; }

}  // namespace dipper::launch

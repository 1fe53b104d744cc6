#include "coupler/launch/process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "coupler/launch/process_tree.hpp"

namespace dipper::launch {

Process::Process(const std::vector<std::string>& command, const std::filesystem::path& log,
                 const std::filesystem::path& folder, const Streams& streams)
    : name_(std::filesystem::path(command[0]).filename()) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (auto& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (out < 0) throw std::runtime_error("cannot write " + log.string() + ": " + strerror(errno));
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    // Its own group, so that Ctrl-C reaches only the launcher, which then ends all in order.
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    signal(SIGPIPE, SIG_DFL);  // an ignored signal would stay ignored
    const int in = streams.in >= 0 ? streams.in : open("/dev/null", O_RDONLY);
    dup2(in, 0);
    dup2(streams.out >= 0 ? streams.out : out, 1);
    dup2(out, 2);
    if (!folder.empty() && chdir(folder.c_str()) != 0) {
      dprintf(2, "cannot work in %s: %s\n", folder.c_str(), strerror(errno));
      _exit(127);
    }
    execvp(argv[0], argv.data());
    dprintf(2, "cannot start %s: %s\n", argv[0], strerror(errno));
    _exit(127);
  }
  close(out);
  if (pid_ < 0) throw std::runtime_error("cannot start " + command[0] + ": " + strerror(errno));
  running_ = true;
}

Process::~Process() { end(); }

std::optional<std::string> Process::ended() {
  if (running_) {
    rusage usage{};
    if (wait4(pid_, &status_, WNOHANG, &usage) != pid_) return std::nullopt;
    running_ = false;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    cpu_s_ = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  if (WIFSIGNALED(status_)) {
    return fmt::format("killed by signal {} ({})", WTERMSIG(status_), strsignal(WTERMSIG(status_)));
  }
  return fmt::format("exit status {}", WEXITSTATUS(status_));
}

namespace {

/// Time on a core, and waiting for one.
struct SchedTime {
  double run_s = 0, wait_s = 0;
};

/// The least value over the leaf processes under a process, or its own when it has no children.
double least(pid_t pid, double (*of)(const SchedTime&)) {
  const std::string at = fmt::format("/proc/{}/", pid);
  std::ifstream children(at + fmt::format("task/{}/children", pid));
  std::optional<double> lowest;
  for (pid_t child = 0; children >> child;) {
    const double s = least(child, of);
    if (!lowest || s < *lowest) lowest = s;
  }
  if (lowest) return *lowest;
  double run_ns = 0, wait_ns = 0;  // proc(5): schedstat
  std::ifstream(at + "schedstat") >> run_ns >> wait_ns;
  return of({1e-9 * run_ns, 1e-9 * wait_ns});
}

}  // namespace

double Process::starved_s() const {
  return running_ ? least(pid_, [](const SchedTime& t) { return t.wait_s; }) : 0;
}

double Process::active_s() const {
  return running_ ? least(pid_, [](const SchedTime& t) { return t.run_s + t.wait_s; }) : 0;
}

bool Process::succeeded() { return ended() && WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

bool Process::was_killed() {
  if (!ended() || !WIFSIGNALED(status_)) return false;
  const int signal = WTERMSIG(status_);
  return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP;
}

double Process::cpu_s() const { return running_ ? tree_cpu_s(pid_) : cpu_s_; }

bool Process::wait(std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!ended()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

void Process::end() {
  if (ended()) return;
  kill(pid_, SIGTERM);  // mpirun passes it on to its ranks
  wait(std::chrono::milliseconds(1500));
  kill(-pid_, SIGKILL);  // and the rest of its group
  wait(std::chrono::milliseconds(1500));
}

}  // namespace dipper::launch

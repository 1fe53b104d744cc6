#include "coupler/launch/process_tree.hpp"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "common/text_file.hpp"

namespace dipper::launch {
namespace fs = std::filesystem;
namespace {

struct ProcessTimes {
  pid_t parent = 0;
  long ticks = 0;
};

/// /proc/PID/stat after the name, which is in brackets and may hold anything; see proc(5).
bool read(const fs::path& stat, ProcessTimes& p) {
  const std::string text = read_bytes(stat).value_or("");  // the process may have ended
  const auto bracket = text.rfind(')');
  if (bracket == std::string::npos) return false;
  std::istringstream fields(text.substr(bracket + 1));
  std::string skipped;
  fields >> skipped >> p.parent;  // 3: state, 4: ppid
  for (int k = 5; k <= 13; ++k) fields >> skipped;
  for (int k = 14; k <= 17; ++k) {  // utime, stime, cutime, cstime
    long ticks = 0;
    fields >> ticks;
    p.ticks += ticks;
  }
  return static_cast<bool>(fields);
}

}  // namespace

double tree_cpu_s(pid_t root) {
  std::map<pid_t, ProcessTimes> all;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator("/proc", gone)) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    const char* end = name.data() + name.size();
    const auto r = std::from_chars(name.data(), end, pid);
    ProcessTimes p;
    if (r.ec == std::errc{} && r.ptr == end && read(entry.path() / "stat", p)) all[pid] = p;
  }
  long ticks = 0;
  for (const auto& [pid, p] : all) {
    auto at = all.find(pid);
    while (at != all.end() && at->first != root) at = all.find(at->second.parent);
    if (at != all.end()) ticks += p.ticks;
  }
  return static_cast<double>(ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace dipper::launch

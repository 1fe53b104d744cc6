#include "coupler/launch/failure_message.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "coupler/launch/mpirun.hpp"

namespace dipper::launch {
namespace {

std::vector<std::string> lines(const std::filesystem::path& file) {
  std::vector<std::string> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    // Open MPI's own errors in passing a message on are not the cause.
    // "[host:pid] PMIX ERROR: ...", "[host:pid] [[1,0],0] ORTE_ERROR_LOG: ...".
    const bool mpis = line[0] == '[' && line.find("ERROR") != std::string::npos;
    if (!line.empty() && !mpis) all.push_back(line);
  }
  return all;
}

/// The last line that contains `word`, or "".
std::string last_with(const std::vector<std::string>& all, const std::string& word) {
  const auto found = std::find_if(all.rbegin(), all.rend(), [&](const std::string& line) {
    return line.find(word) != std::string::npos;
  });
  return found == all.rend() ? "" : *found;
}

/// The cause as LIGGGHTS, one of Dipper's programs or mpirun names it; "" where none does.
std::string named_cause(const std::vector<std::string>& all, const std::filesystem::path& screen) {
  if (!screen.empty()) {
    const std::string error = last_with(lines(screen), "ERROR");
    if (!error.empty()) return error;
  }
  // mpirun of another host: "  Remote daemon: [[1,0],1] on node h2".
  const std::string lost = last_with(all, "Remote daemon:"), on = " on node ";
  if (const auto at = lost.find(on); at != std::string::npos)
    return "mpirun has lost the host " + lost.substr(at + on.size());
  for (const char* word : {"ERROR", "exited on signal 9", "dipper-dem:", "dipper-liggghts:",
                           "dipper-mbs:", "exited on signal", "cannot start"}) {
    const std::string line = last_with(all, word);
    if (!line.empty()) return line;
  }
  return "";
}

/// The last line before what mpirun says.
std::string last_line(const std::vector<std::string>& all) {
  // mpirun's message is between rules, after the output of its program.
  const auto rule = [](const std::string& line) { return line.rfind("---", 0) == 0; };
  const auto boxed = std::find_if(all.begin(), all.end(), rule);
  const auto end = boxed == all.begin() ? all.end() : boxed;
  const auto plain =
      std::find_if(std::make_reverse_iterator(end), all.rend(), [&](const std::string& line) {
        return !rule(line) && line.find("mpirun") == std::string::npos;
      });
  return plain == all.rend() ? "" : *plain;
}

}  // namespace

std::string error_line(const std::filesystem::path& log, const std::filesystem::path& screen) {
  const auto all = lines(log);
  const std::string cause = named_cause(all, screen);
  return cause.empty() ? last_line(all) : cause;
}

std::string failure_message(Process& process, const std::filesystem::path& log,
                            const std::filesystem::path& screen) {
  const std::string end = process.ended().value_or("still runs");
  if (process.was_killed()) return process.name() + " was " + end;
  const auto all = lines(log);
  std::string line = named_cause(all, screen);
  const bool no_mpirun = line.find("cannot start mpirun") != std::string::npos;
  if (process.name() == "mpirun" && (line.empty() || no_mpirun)) {  // it may have started nothing
    line = mpirun_fault();
    if (!line.empty() && !all.empty() && !no_mpirun) line += "; it says '" + all.front() + "'";
  }
  if (line.empty()) line = last_line(all);
  return line.empty() ? process.name() + ": " + end : line + " (" + end + ")";
}

}  // namespace dipper::launch

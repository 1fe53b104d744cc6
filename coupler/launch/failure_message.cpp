#include "coupler/launch/failure_message.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

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

}  // namespace

std::string error_line(const std::filesystem::path& log, const std::filesystem::path& screen) {
  if (!screen.empty()) {
    const std::string error = last_with(lines(screen), "ERROR");
    if (!error.empty()) return error;
  }
  const auto all = lines(log);
  // mpirun of another host: "  Remote daemon: [[1,0],1] on node h2".
  const std::string lost = last_with(all, "Remote daemon:"), on = " on node ";
  if (const auto at = lost.find(on); at != std::string::npos)
    return "mpirun has lost the host " + lost.substr(at + on.size());
  for (const char* word : {"ERROR", "exited on signal 9", "dipper-dem:", "dipper-liggghts:",
                           "dipper-mbs:", "exited on signal", "cannot start"}) {
    const std::string line = last_with(all, word);
    if (!line.empty()) return line;
  }
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

std::string failure_message(Process& process, const std::filesystem::path& log,
                            const std::filesystem::path& screen) {
  const std::string end = process.ended().value_or("still runs");
  if (process.was_killed()) return process.name() + " was " + end;
  const std::string line = error_line(log, screen);
  return line.empty() ? process.name() + ": " + end : line + " (" + end + ")";
}

}  // namespace dipper::launch

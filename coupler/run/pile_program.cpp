#include "coupler/run/pile_program.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/installation.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/hang_watch.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

std::string last_line(const fs::path& screen) {
  std::ifstream in(screen);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

/// For the message about a settling that hangs.
std::string how_far(const fs::path& screen) {
  const std::string last = last_line(screen);
  return last.empty() ? screen.string() + " is empty"
                      : fmt::format("the last line of {} is '{}'", screen.string(), last);
}

/// LIGGGHTS prints rows of step, time, ... while it steps. \param all_s  simulated time of the
/// script, 0: not known.
std::string progress_line(const fs::path& screen, double all_s, double wall_s) {
  std::istringstream row(last_line(screen));
  std::int64_t step = 0;
  double time_s = 0;
  if (!(row >> step >> time_s)) return fmt::format("pile: settling, {:.0f} s", wall_s);
  const std::string all = all_s > 0 ? fmt::format(" of {:.1f}", all_s) : "";
  return fmt::format("pile: settling, {:.1f}{} s simulated in {:.0f} s", time_s, all, wall_s);
}

}  // namespace

PileLinks::PileLinks(fs::path folder, const fs::path& deck) : folder_(std::move(folder)) {
  fs::create_symlink(data_folder() / "dem_in", folder_ / "dem_in");
  fs::create_symlink(fs::absolute(deck), folder_ / "deck");
  fs::create_symlink(installed_program("bench-cut"), folder_ / "bench-cut");
}

PileLinks::~PileLinks() {
  std::error_code ignored;
  for (const char* name : {"dem_in", "deck", "bench-cut"}) fs::remove(folder_ / name, ignored);
}

void heed_interrupts() {
  if (launch::interrupts() > 0) throw launch::Interrupted();
}

std::string PilePrograms::settler() const { return deck::settler(c.dem.loop); }

void PilePrograms::settle(const fs::path& folder, const std::string& script, int ranks,
                          const std::string& makes, std::vector<std::string> variables) const {
  run(folder, script, ranks,
      {installed_program("dipper-liggghts"), "--loop", cases::word_of(c, "dem.loop"), "--ranks",
       std::to_string(ranks), "-in", "dem_in/" + script + ".in"},
      makes, std::move(variables));
}

void PilePrograms::place(const fs::path& folder, const std::vector<std::string>& words,
                         const std::string& makes, std::vector<std::string> variables) const {
  std::vector<std::string> command = {installed_program("place-rocks")};
  command.insert(command.end(), words.begin(), words.end());
  command.insert(command.end(), {"-in", "dem_in/place.in"});
  run(folder, "place", 1, std::move(command), makes, std::move(variables));
}

void PilePrograms::run(const fs::path& folder, const std::string& name, int ranks,
                       std::vector<std::string> command, const std::string& makes,
                       std::vector<std::string> variables) const {
  const auto began = std::chrono::steady_clock::now();
  const fs::path screen = logs / (name + ".screen"), log = logs / (name + ".log");
  command.insert(command.end(), {"-log", fs::absolute(logs / (name + ".liggghts")).string(),
                                 "-screen", fs::absolute(screen).string()});
  variables.insert(variables.end(), {"deck", "deck"});
  for (std::size_t i = 0; i + 1 < variables.size(); i += 2)
    command.insert(command.end(), {"-var", variables[i], variables[i + 1]});
  launch::Process process(launch::mpirun(ranks, std::move(command), places), log, folder);
  launch::HangWatch watch(c.coupling.timeout_s);
  const double all_s = name == "settle" ? c.pile.settle_s + c.pile.relax_s : 0;
  while (!process.wait(std::chrono::milliseconds(100))) {
    std::error_code none_yet;
    const auto written = fs::file_size(screen, none_yet);
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - began;
    reporter.progress(progress_line(screen, all_s, now.count()));
    const std::string hung = watch.look(now.count(), process.active_s(), none_yet ? 0 : written);
    if (!hung.empty()) {
      process.end();
      throw std::runtime_error(
          fmt::format("settling the pile failed: LIGGGHTS hangs: {}; {}", hung, how_far(screen)));
    }
    if (launch::interrupts() > 0) {
      process.end();
      throw launch::Interrupted();
    }
  }
  if (!process.succeeded() || !fs::exists(folder / makes))
    throw std::runtime_error("settling the pile failed: " +
                             launch::failure_message(process, log, screen));
}

}  // namespace dipper::run

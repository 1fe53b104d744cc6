#include "coupler/run/pile.hpp"

#include <fmt/core.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/case_lines.hpp"
#include "common/installation.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/deck/bench_cut.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/hang_watch.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// Everything the bench depends on: the case's keys that affect the settling, the deck that settles
/// it, the files that deck includes, and the program that runs it.
std::string pile_hash(const cases::Case& c, const fs::path& deck) {
  std::string all =
      fmt::format("{}, bench-cut {}\n", deck::settler(c.dem.loop), deck::kBenchCutVersion);
  for (const CaseLine& line : CaseLines(c.text)) {
    const cases::KeySpec& spec = *cases::spec_of(line.key);
    // A path says where a file is, not what is in it: the deck's spheres, outline and surface are
    // hashed below. The settler's word has the loop.
    const bool said = cases::is_path(spec) || line.key == "dem.loop";
    if (spec.affects == cases::Affects::settling && !said)
      all += line.key + '=' + line.value + '\n';
  }
  std::vector<fs::path> scripts;
  for (const char* name : {"settle.in", "contact.in", "check_pour.in", "check_lost.in"})
    scripts.push_back(data_folder() / "dem_in" / name);
  return deck_hash(all, scripts, deck);
}

/// For the message about a settling that has stopped.
std::string how_far(const fs::path& screen) {
  std::ifstream in(screen);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last.empty() ? screen.string() + " holds nothing"
                      : fmt::format("the last line of {} is '{}'", screen.string(), last);
}

/// What the script names, linked into the folder that LIGGGHTS is started in: neither a script nor
/// the shell it calls reads a path that a user has chosen.
class Links {
 public:
  Links(fs::path folder, const fs::path& deck) : folder_(std::move(folder)) {
    fs::create_symlink(data_folder() / "dem_in", folder_ / "dem_in");
    fs::create_symlink(fs::absolute(deck), folder_ / "deck");
    fs::create_symlink(installed_program("bench-cut"), folder_ / "bench-cut");
  }
  ~Links() {
    std::error_code ignored;
    for (const char* name : {"dem_in", "deck", "bench-cut"}) fs::remove(folder_ / name, ignored);
  }
  Links(const Links&) = delete;
  Links& operator=(const Links&) = delete;

 private:
  fs::path folder_;
};

}  // namespace

Pile settled_pile(const cases::Case& c, const fs::path& deck, const fs::path& logs,
                  const launch::MpiPlaces& places) {
  const fs::path entry = cache_folder() / "piles" / pile_hash(c, deck);
  const auto heed_interrupts = [] {
    if (launch::interrupts() > 0) throw launch::Interrupted();
  };
  const auto began = std::chrono::steady_clock::now();
  const auto settle = [&](const fs::path& out) {
    const fs::path screen = logs / "settle.screen";
    const Links links(out, deck);
    launch::Process liggghts(launch::mpirun(c.dem.ranks,
                                            {installed_program("dipper-liggghts"),
                                             "--loop",
                                             cases::word_of(c, "dem.loop"),
                                             "--ranks",
                                             std::to_string(c.dem.ranks),
                                             "-in",
                                             "dem_in/settle.in",
                                             "-log",
                                             fs::absolute(logs / "settle.liggghts").string(),
                                             "-screen",
                                             fs::absolute(screen).string(),
                                             "-var",
                                             "deck",
                                             "deck",
                                             "-var",
                                             "out",
                                             ".",
                                             "-var",
                                             "bench_cut",
                                             "./bench-cut"},
                                            places),
                             logs / "settle.log", out);
    launch::HangWatch watch(c.coupling.timeout_s);
    while (!liggghts.wait(std::chrono::milliseconds(100))) {
      std::error_code none_yet;
      const auto written = fs::file_size(screen, none_yet);
      const std::chrono::duration<double> now = std::chrono::steady_clock::now() - began;
      const std::string hung = watch.look(now.count(), liggghts.active_s(), none_yet ? 0 : written);
      if (!hung.empty()) {
        liggghts.end();
        throw std::runtime_error(
            fmt::format("settling the pile failed: LIGGGHTS hangs: {}; {}", hung, how_far(screen)));
      }
      if (launch::interrupts() > 0) {
        liggghts.end();
        throw launch::Interrupted();
      }
    }
    if (!liggghts.succeeded() || !fs::exists(out / "pile.restart"))
      throw std::runtime_error("settling the pile failed: " +
                               launch::failure_message(liggghts, logs / "settle.log", screen));
  };
  const bool settled = make_once(entry, settle, heed_interrupts);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  return {entry / "pile.restart", !settled, settled ? took.count() : 0};
}

}  // namespace dipper::run

#include "coupler/run/pile.hpp"

#include <fmt/core.h>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/installation.hpp"
#include "coupler/deck/bench_cut.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/last_words.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// Everything the bench depends on: the case's keys about rock, its bench and the DEM, the deck
/// that settles it, the files that deck includes, and the program that runs it.
std::string pile_hash(const cases::Case& c, const fs::path& deck) {
  std::string all = fmt::format("LIGGGHTS 3.8.0, bench-cut {}\n", deck::kBenchCutVersion);
  std::istringstream lines(c.text);
  for (std::string line; std::getline(lines, line);) {
    for (const char* section : {"rock.", "contact.", "pile.", "domain.", "dem.", "seed"}) {
      // Of the dig, not of the settling:
      if (line.rfind("dem.hold", 0) == 0 || line.rfind("pile.clear_machine", 0) == 0 ||
          line.rfind("pile.held_layer", 0) == 0)
        continue;
      // A path says where a file is, not what is in it: the deck's spheres, outline and
      // surface are hashed below.
      const bool path =
          line.rfind("rock.shape_folder", 0) == 0 || line.rfind("pile.profile", 0) == 0;
      if (line.rfind(section, 0) == 0 && !path) all += line + '\n';
    }
  }
  return deck_hash(all, {data_folder() / "dem_in" / "settle.in"}, deck);
}

}  // namespace

Pile settled_pile(const cases::Case& c, const fs::path& deck, const fs::path& logs) {
  const fs::path entry = cache_folder() / "piles" / pile_hash(c, deck);
  const auto heed_interrupts = [] {
    if (launch::interrupts() > 0) throw launch::Interrupted();
  };
  const auto began = std::chrono::steady_clock::now();
  const auto settle = [&](const fs::path& out) {
    const fs::path screen = logs / "settle.screen";
    const std::string binary = deck::sticks(c) ? installed_program("dipper-liggghts") : "liggghts";
    launch::Process liggghts(
        launch::mpirun(c.dem.ranks,
                       {binary, "-in", (data_folder() / "dem_in" / "settle.in").string(), "-log",
                        (logs / "settle.liggghts").string(), "-screen", screen.string(), "-var",
                        "deck", deck.string(), "-var", "out", out.string(), "-var", "bench_cut",
                        installed_program("bench-cut")}),
        logs / "settle.log");
    while (!liggghts.wait(std::chrono::milliseconds(100))) {
      if (launch::interrupts() > 0) {
        liggghts.end();
        throw launch::Interrupted();
      }
    }
    if (!liggghts.succeeded() || !fs::exists(out / "pile.restart"))
      throw std::runtime_error(fmt::format("settling the pile failed: {} ({})",
                                           launch::last_words(logs / "settle.log", screen),
                                           *liggghts.ended()));
  };
  const bool settled = make_once(entry, settle, heed_interrupts);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  return {entry / "pile.restart", !settled, settled ? took.count() : 0};
}

}  // namespace dipper::run

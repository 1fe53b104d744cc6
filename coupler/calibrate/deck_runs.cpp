#include "coupler/calibrate/deck_runs.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/installation.hpp"
#include "common/temporary_folder.hpp"
#include "common/text_file.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/launch/failure_message.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::calibrate {
namespace fs = std::filesystem;
namespace {

/// The files of dem_in that the deck reads.
std::vector<fs::path> scripts(const DeckRun& run) {
  std::vector<fs::path> files;
  for (const std::string& name :
       {run.deck + ".in", std::string("contact.in"), std::string("check_pour.in"),
        std::string("check_lost.in"), std::string("sheet.stl")})
    files.push_back(data_folder() / "dem_in" / name);
  return files;
}

/// A deck in a temporary folder.
class WrittenDeck {
 public:
  explicit WrittenDeck(const DeckRun& run) {
    // The cache may be shared; a temporary folder is 0700.
    fs::permissions(folder(), fs::perms(0755));
    deck::write_deck(run.c, run.c.rock.shape_folder, folder());
    // The case's pile is not used here.
    for (const char* unused : {"funnel.stl", "sides.stl", "outline.csv", "surface.stl", "walls"})
      fs::remove_all(folder() / unused);
  }

  const fs::path& folder() const { return temporary_.path(); }

 private:
  TemporaryFolder temporary_{"dipper-deck"};
};

/// The part of case.in that the calibration decks read: the rest is for the bench and the machine.
std::string run_hash(const DeckRun& run, const fs::path& deck) {
  std::string all = fmt::format("{}\nseed {}\ntimestep {:.17g}\n", deck::settler(run.c.dem.loop),
                                run.c.seed, run.c.dem.timestep_s);
  for (const auto& [name, value] : run.variables) all += name + ' ' + value + '\n';
  return deck_hash(all, scripts(run), deck);
}

fs::path entry_of(const std::string& hash) { return cache_folder() / "calibrations" / hash; }

/// CPU time of the run that wrote an entry.
double cost_of(const fs::path& entry) {
  double cpu_s = 0;
  std::ifstream(entry / "cpu_s") >> cpu_s;
  return cpu_s;
}

/// A run in progress.
struct Active {
  std::size_t index;
  std::string hash;
  std::unique_ptr<CacheWriter> writer;
  std::unique_ptr<launch::Process> liggghts;
};

std::vector<std::string> command(const DeckRun& run) {
  std::vector<std::string> words = {installed_program("dipper-liggghts"),
                                    "--loop",
                                    cases::word_of(run.c, "dem.loop"),
                                    "-in",
                                    "dem_in/" + run.deck + ".in",
                                    "-log",
                                    "liggghts.log",
                                    "-screen",
                                    "screen",
                                    "-var",
                                    "deck",
                                    "deck",
                                    "-var",
                                    "out",
                                    "."};
  for (const auto& [name, value] : run.variables) words.insert(words.end(), {"-var", name, value});
  return words;
}

/// Puts a finished run into the cache.
DeckResult keep(const DeckRun& run, Active& active) {
  const fs::path entry = entry_of(active.hash), work = active.writer->part();
  fs::remove(work / "dem_in");
  write_text(work / "cpu_s", fmt::format("{}\n", active.liggghts->cpu_s()));
  active.writer->keep();
  return {entry / run.dump, active.hash, false, cost_of(entry)};
}

}  // namespace

std::vector<bool> cached_runs(const std::vector<DeckRun>& runs) {
  std::vector<bool> out;
  for (const DeckRun& run : runs) {
    const WrittenDeck deck(run);
    out.push_back(is_sound(entry_of(run_hash(run, deck.folder()))));
  }
  return out;
}

std::vector<DeckResult> run_decks(
    const std::vector<DeckRun>& runs, int jobs, Reporter& reporter,
    const std::function<void(std::size_t, const DeckResult&)>& finished) {
  std::vector<DeckResult> results(runs.size());
  std::vector<Active> active;
  std::size_t next = 0;
  std::exception_ptr failure;  // the first one; runs in progress are then finished and kept
  const auto done = [&](std::size_t i, DeckResult result) {
    results[i] = std::move(result);
    finished(i, results[i]);
  };
  const auto may_fail = [&](const auto& step) {
    try {
      step();
    } catch (const std::exception& e) {
      if (failure) return;
      failure = std::current_exception();
      if (active.size() > 1)
        reporter.error(
            fmt::format("{}\nruns in progress are finished first; Ctrl-C ends them", e.what()));
    }
  };
  while ((next < runs.size() && !failure) || !active.empty()) {
    while (next < runs.size() && !failure && active.size() < static_cast<std::size_t>(jobs)) {
      const DeckRun& run = runs[next];
      const WrittenDeck deck(run);
      const std::string hash = run_hash(run, deck.folder());
      const fs::path entry = entry_of(hash);
      auto writer = CacheWriter::begin(entry);
      if (!writer) {  // another process is making it
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        break;
      }
      if (!writer->is_needed()) {
        may_fail([&] { done(next++, {entry / run.dump, hash, true, cost_of(entry)}); });
        continue;
      }
      const fs::path work = writer->part();
      fs::copy(deck.folder(), work / "deck", fs::copy_options::recursive);
      fs::create_symlink(data_folder() / "dem_in", work / "dem_in");
      // In its own folder: on an error LIGGGHTS writes a restart file into its working folder.
      auto liggghts = std::make_unique<launch::Process>(command(run), work / "stderr", work);
      active.push_back({next++, hash, std::move(writer), std::move(liggghts)});
    }
    if (launch::interrupts() > 0) throw launch::Interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (auto it = active.begin(); it != active.end();) {
      if (!it->liggghts->ended()) {
        ++it;
        continue;
      }
      may_fail([&] {
        const DeckRun& run = runs[it->index];
        const fs::path work = it->writer->part();
        if (!it->liggghts->succeeded() || !fs::exists(work / run.dump)) {
          throw std::runtime_error(fmt::format(
              "{}.in failed with seed {}: {}", run.deck, run.c.seed,
              launch::failure_message(*it->liggghts, work / "stderr", work / "screen")));
        }
        done(it->index, keep(run, *it));
      });
      it = active.erase(it);
    }
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace dipper::calibrate

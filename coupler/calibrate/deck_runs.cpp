#include "coupler/calibrate/deck_runs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/installation.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/last_words.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::calibrate {
namespace fs = std::filesystem;
namespace {

/// All that a run of the deck reads of dem_in.
std::vector<fs::path> scripts(const DeckRun& run) {
  std::vector<fs::path> files;
  for (const std::string& name :
       {run.deck + ".in", std::string("contact.in"), std::string("check_pour.in"),
        std::string("check_lost.in"), std::string("sheet.stl")})
    files.push_back(data_folder() / "dem_in" / name);
  return files;
}

const char* const kWorkplace = "part.";  // its name begins so

/// A file descriptor that holds the lock on a folder; -1 when another process does, or the folder
/// is gone. The kernel drops the lock with the process, however that ends.
int lock_folder(const fs::path& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0 && fs::exists(folder)) return fd;
  const int why = errno;
  if (fd >= 0) close(fd);
  if (why != EWOULDBLOCK && fs::exists(folder))
    throw std::system_error(why, std::generic_category(), folder.string());
  return -1;
}

/// A deck written to a folder of its own in the cache, gone at the end.
class Workplace {
 public:
  explicit Workplace(const DeckRun& run) {
    const fs::path all = cache_folder() / "calibrations";
    fs::create_directories(all);
    do {
      std::string name = (all / kWorkplace).string() + "XXXXXX";
      if (mkdtemp(name.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), all.string());
      folder_ = name;
      std::error_code gone;
      fs::permissions(folder_, fs::perms(0755), gone);  // a cache may be shared; mkdtemp's are 0700
      lock_ = lock_folder(folder_);                     // unless another's sweep has taken it first
    } while (lock_ < 0);
    deck::write_deck(run.c, run.c.rock.shape_folder, folder_ / "deck");
    // The case's own bench: of no use here.
    for (const char* unused : {"funnel.stl", "sides.stl", "outline.csv", "surface.stl", "walls"})
      fs::remove_all(folder_ / "deck" / unused);
    fs::create_symlink(data_folder() / "dem_in", folder_ / "dem_in");
  }
  ~Workplace() {
    std::error_code gone;
    fs::remove_all(folder_, gone);
    close(lock_);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
  int lock_ = -1;
};

/// Removes the workplaces of processes that were killed.
void sweep() {
  const fs::path all = cache_folder() / "calibrations";
  std::vector<fs::path> workplaces;
  std::error_code none;  // no folder yet
  for (const auto& f : fs::directory_iterator(all, none))
    if (f.path().filename().string().rfind(kWorkplace, 0) == 0) workplaces.push_back(f.path());
  for (const fs::path& workplace : workplaces) {
    const int lock = lock_folder(workplace);
    if (lock < 0) continue;
    fs::remove_all(workplace, none);
    close(lock);
  }
}

/// Of case.in only what the calibration decks read: the rest is the bench and the machine.
std::string run_hash(const DeckRun& run, const fs::path& deck) {
  std::string all =
      fmt::format("LIGGGHTS 3.8.0\nseed {}\ntimestep {:.17g}\n", run.c.seed, run.c.dem.timestep_s);
  for (const auto& [name, value] : run.variables) all += name + ' ' + value + '\n';
  return deck_hash(all, scripts(run), deck);
}

fs::path entry_of(const std::string& hash) { return cache_folder() / "calibrations" / hash; }

/// CPU time of the run that made an entry.
double cost_of(const fs::path& entry) {
  double cpu_s = 0;
  std::ifstream(entry / "cpu_s") >> cpu_s;
  return cpu_s;
}

bool is_there(const DeckRun& run, const fs::path& entry) { return fs::exists(entry / run.dump); }

/// A run at work.
struct Active {
  std::size_t index;
  std::string hash;
  std::unique_ptr<Workplace> place;
  std::unique_ptr<launch::Process> liggghts;
};

std::vector<std::string> command(const DeckRun& run, const fs::path& work) {
  // Started in its own folder: on an error LIGGGHTS leaves a restart file where it stands.
  const std::string binary =
      deck::sticks(run.c) ? installed_program("dipper-liggghts") : "liggghts";
  std::vector<std::string> words = {
      "env",  "-C",           work.string(), binary,   "-in",  "dem_in/" + run.deck + ".in",
      "-log", "liggghts.log", "-screen",     "screen", "-var", "deck",
      "deck", "-var",         "out",         "."};
  for (const auto& [name, value] : run.variables) words.insert(words.end(), {"-var", name, value});
  return words;
}

/// Moves a finished run into the cache. Another may have been faster: its result is the same.
DeckResult keep(const DeckRun& run, Active& active) {
  const fs::path entry = entry_of(active.hash), work = active.place->folder();
  fs::remove(work / "dem_in");
  std::ofstream(work / "cpu_s") << active.liggghts->cpu_s() << '\n';
  std::error_code lost_race;
  fs::rename(work, entry, lost_race);
  if (!is_there(run, entry)) throw std::runtime_error(entry.string() + ": cannot be written");
  return {entry / run.dump, active.hash, false, cost_of(entry)};
}

}  // namespace

std::vector<bool> cached_runs(const std::vector<DeckRun>& runs) {
  std::vector<bool> out;
  for (const DeckRun& run : runs) {
    const Workplace place(run);
    out.push_back(is_there(run, entry_of(run_hash(run, place.folder() / "deck"))));
  }
  return out;
}

std::vector<DeckResult> run_decks(
    const std::vector<DeckRun>& runs, int jobs,
    const std::function<void(std::size_t, const DeckResult&)>& finished) {
  sweep();
  std::vector<DeckResult> results(runs.size());
  std::vector<Active> active;
  std::size_t next = 0;
  std::exception_ptr failure;  // the first: what is at work then is finished and kept
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
        fmt::print(stderr, "dipper: {}\nthose at work are finished first, Ctrl-C ends them\n",
                   e.what());
    }
  };
  while ((next < runs.size() && !failure) || !active.empty()) {
    while (next < runs.size() && !failure && active.size() < static_cast<std::size_t>(jobs)) {
      const DeckRun& run = runs[next];
      auto place = std::make_unique<Workplace>(run);
      const std::string hash = run_hash(run, place->folder() / "deck");
      const fs::path entry = entry_of(hash);
      if (is_there(run, entry)) {
        may_fail([&] { done(next++, {entry / run.dump, hash, true, cost_of(entry)}); });
        continue;
      }
      auto liggghts = std::make_unique<launch::Process>(command(run, place->folder()),
                                                        place->folder() / "stderr");
      active.push_back({next++, hash, std::move(place), std::move(liggghts)});
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
        const fs::path work = it->place->folder();
        if (!it->liggghts->succeeded() || !fs::exists(work / run.dump)) {
          throw std::runtime_error(fmt::format(
              "{}.in failed with seed {}: {} ({})", run.deck, run.c.seed,
              launch::last_words(work / "stderr", work / "screen"), *it->liggghts->ended()));
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

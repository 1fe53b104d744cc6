#include "coupler/cli/clean_command.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <system_error>
#include <vector>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/file_lock.hpp"
#include "common/input_error.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

struct CleanOptions {
  std::vector<std::string> places;
  bool yes = false;
};

/// Files that are removed together, and what is lost with them.
struct Load {
  std::string name, lost;
  std::vector<fs::path> paths;
};

std::uintmax_t size_B(const fs::path& path) {
  std::error_code gone;  // files come and go while others run
  if (!fs::is_directory(path)) return fs::is_regular_file(path) ? fs::file_size(path, gone) : 0;
  std::uintmax_t sum = 0;
  for (const auto& f : fs::recursive_directory_iterator(path, gone))
    if (f.is_regular_file(gone)) sum += f.file_size(gone);
  return sum;
}

std::vector<Load> load_of_run(const fs::path& run) {
  if (!fs::exists(run / "record.h5"))
    throw InputError({{run, 0, "", "is not a run; name a run's folder, or `cache`"}});
  std::vector<Load> loads = {
      {"dumps", "frames of rock and walls: without them no new report, nothing for ParaView", {}},
      {"checkpoints", "without them the run cannot continue (--resume)", {}},
      {"messages", "without them the run cannot be replayed", {}}};
  for (const auto& entry : fs::directory_iterator(run)) {
    const fs::path name = entry.path().filename();
    if (name == "dumps") loads[0].paths.push_back(entry.path());
    if (name == "checkpoints") loads[1].paths.push_back(entry.path());
    if (name.extension() == ".lcmlog") loads[2].paths.push_back(entry.path());
  }
  return loads;
}

std::vector<Load> of_cache() {
  std::vector<Load> loads;
  if (!fs::is_directory(cache_folder())) return loads;
  for (const auto& kind : fs::directory_iterator(cache_folder())) {
    if (!kind.is_directory()) continue;
    Load load{kind.path().filename().string(), "made again when needed", {}};
    for (const auto& entry : fs::directory_iterator(kind.path()))
      if (entry.path().extension() != ".lock") load.paths.push_back(entry.path());
    loads.push_back(std::move(load));
  }
  return loads;
}

/// A run's folder or the cache, held against other writers while it is emptied.
struct Place {
  Place(const std::string& word, bool empties)
      : cache(word == "cache" && !fs::exists(fs::path(word) / "record.h5")),
        folder(cache ? cache_folder() : fs::path(word)),
        loads(cache ? of_cache() : load_of_run(folder)),
        writer(folder / "run.lock") {
    if (empties && !cache && !writer.try_lock())
      throw InputError({{folder, 0, "", "a run is writing it; wait for its end"}});
  }

  bool cache;
  fs::path folder;
  std::vector<Load> loads;
  FileLock writer;
};

int clean(const CleanOptions& o, Reporter& reporter) {
  std::map<fs::path, Place> places;  // all of them are sound before anything is removed
  for (const std::string& word : o.places) {
    const fs::path file = word == "cache" ? fs::path(word) : fs::weakly_canonical(word);
    if (places.count(file) == 0) places.try_emplace(file, word, o.yes);
  }
  std::uintmax_t sum_B = 0;
  for (const auto& [file, place] : places) {
    for (const Load& load : place.loads) {
      std::uintmax_t load_B = 0;
      for (const fs::path& path : load.paths) {
        FileLock maker(writers_lock(path));
        if (o.yes && place.cache && !maker.try_lock()) continue;  // another process is making it
        load_B += size_B(path);
        if (o.yes) fs::remove_all(path);
      }
      sum_B += load_B;
      reporter.line(fmt::format("{:>9.1f} MB  {}: {}", static_cast<double>(load_B) * 1e-6,
                                (place.folder / load.name).string(), load.lost));
    }
  }
  reporter.line(fmt::format("{:>9.1f} MB  {}", static_cast<double>(sum_B) * 1e-6,
                            o.yes ? "freed" : "can be freed with --yes"));
  return 0;
}

}  // namespace

Command add_clean_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<CleanOptions>();
  auto* sub = app.add_subcommand("clean", "disk space of runs and the cache: list it, or free it");
  sub->footer(
      "Of a run: frames, checkpoints and messages; record, summary and report stay. Removes "
      "nothing without --yes. "
      "Example:\n  dipper clean runs/quick cache");
  sub->add_option("PLACE", o->places, "folders of runs, or the word cache")->required();
  sub->add_flag("--yes", o->yes, "remove it; without this, only list it");
  return {sub, [o, &reporter] { return clean(*o, reporter); }};
}

}  // namespace dipper::cli

#include "coupler/result/run_folder.hpp"

#include "common/input_error.hpp"
#include "common/manifest.hpp"
#include "common/writable_folder.hpp"

namespace dipper::result {
namespace fs = std::filesystem;

RunFolder::RunFolder(const fs::path& folder, bool resume)
    : root_(fs::absolute(folder)), lock_(root_ / "run.lock") {
  const auto refuse = [&](const std::string& why) { throw InputError({{folder, 0, "", why}}); };
  if (resume && !fs::exists(record()))
    refuse("holds no run to resume; leave out --resume, or name the run's folder with --out");
  make_writable(root_);
  if (!lock_.try_lock()) {
    const auto owner = lock_.owner();
    refuse("another run is writing it" +
           (owner ? " (process " + std::to_string(*owner) + ")" : std::string()) +
           "; wait for its end, or choose another --out");
  }
  if (!resume && fs::exists(record()))
    refuse("holds a run already; choose another --out, or --resume it");
  for (const auto& sub : {deck(), dumps(), checkpoints(), logs()}) fs::create_directories(sub);
  fs::permissions(logs(), fs::perms::owner_all);  // they hold the secret of the run's messages
}

void RunFolder::seal() const {
  dipper::seal(root_,
               {"case.txt", "inputs.sha256", "motion.csv", "machine.yaml", "poses.csv", "operator",
                "faces", "deck", record().filename(), scales().filename(), summary().filename()});
}

void RunFolder::unseal() const { fs::remove(root_ / kManifest); }

}  // namespace dipper::result

#include "coupler/cli/python_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/installation.hpp"
#include "coupler/cli/environment.hpp"

namespace dipper::cli {
namespace {

// Debian's, for which scripts/setup installs the packages; another python3 may not have them.
constexpr const char* kPython = "/usr/bin/python3";
// Each holds one package.
constexpr std::array kFolders = {"analysis/gap", "analysis/logs", "analysis/runs", "analysis/study",
                                 "analysis/survey"};

/// Becomes `python3 -m package words...`. Returns only when that cannot be started; throws
/// std::runtime_error.
int run_python(const std::string& package, const std::vector<std::string>& words) {
  std::string path;
  for (const char* folder : kFolders)
    path += (path.empty() ? "" : ":") + (data_folder() / folder).string();
  // Before what a user has installed for the whole system: another numpy than the one that Debian's
  // packages are built with.
  path += ":/usr/lib/python3/dist-packages";
  // The user's settings are for other programs: PYTHONINSPECT waits for input after the end,
  // PYTHONOPTIMIZE removes texts, MPLBACKEND is a notebook's.
  unset_variables("PYTHON");
  unset_variables("MPLBACKEND");
  setenv("PYTHONPATH", path.c_str(), 1);
  // Excludes the current folder's modules and the user's packages: a csv.py there would be run. Set
  // in the environment, so that programs started by this one do the same.
  setenv("PYTHONSAFEPATH", "1", 1);
  setenv("PYTHONNOUSERSITE", "1", 1);
  setenv("PYTHONUTF8", "1", 1);  // whatever the locale
  setenv("DIPPER", installed_program("dipper").c_str(), 1);
  // The runs use all cores; threads in the linear algebra would only slow them down.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  std::vector<std::string> all = {kPython, "-B", "-m", package};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(kPython, argv.data());
  throw std::runtime_error(fmt::format("cannot start {}: {}", kPython, std::strerror(errno)));
}

Command python_command(CLI::App* sub, const char* package, const std::vector<std::string>& words) {
  return {sub, [=] { return run_python(package, {words.begin() + 1, words.end()}); }};
}

CLI::Option* add_word(CLI::App* sub, const char* name, const char* type, const char* what) {
  return sub->add_option(name)->type_name(type)->description(what);
}

}  // namespace

Command add_import_command(CLI::App& app, const std::vector<std::string>& words) {
  auto* sub = app.add_subcommand("import", "a mine's logger file as motion.csv and measured data");
  sub->footer(
      "Makes motion.csv, and a measured folder where the log has forces or masses, and says what "
      "it "
      "did to the data (docs/import.md). Example:\n  dipper import shift.csv --map shift.yaml "
      "--out mine/shift --dry");
  add_word(sub, "LOG", "FILE", "the logger's CSV")->required();
  add_word(sub, "--map", "FILE",
           "which column is which channel, in what unit, and the machine's limits")
      ->required();
  add_word(sub, "--out", "DIR",
           "folder of motion.csv, measured/, import.png and import.txt (default: named as LOG)");
  sub->add_flag("--dry", "write DIR/import.png only, and say what would be done");
  return python_command(sub, "dipper_import", words);
}

Command add_survey_command(CLI::App& app, const std::vector<std::string>& words) {
  auto* sub = app.add_subcommand("survey", "a surveyed point cloud as the face of a case's pile");
  sub->footer(
      "Reads x y z text, CSV, PLY or LAS in the mine's coordinates and writes the surface that "
      "pile.profile takes, with a picture and what was left out and filled (docs/survey.md). "
      "Example:\n  dipper survey scan.las --case cases/mine --origin 512345.2,7443210.9,182.4 "
      "--azimuth 37");
  add_word(sub, "CLOUD", "FILE", "the points")->required();
  add_word(sub, "--case", "DIR", "the case: width of the bench, domain, and site where it has one")
      ->required();
  add_word(sub, "--origin", "E,N,Z",
           "easting, northing and elevation of the case's origin in m (default: site.origin_m)");
  add_word(sub, "--azimuth", "DEG",
           "direction of the dig, clockwise from grid north (default: site.azimuth_deg)");
  add_word(sub, "--rear", "X",
           "x of the bench's rear wall in m (default: the case's, or as far as the cloud shows)");
  add_word(sub, "--out", "FILE",
           "a surface, .stl, or a section, .csv (default: face.stl in the case's folder)");
  return python_command(sub, "dipper_survey", words);
}

Command add_study_command(CLI::App& app, const std::vector<std::string>& words) {
  auto* sub = app.add_subcommand("study", "many runs of a case, over parameters and seeds");
  sub->footer(
      "Runs every combination that is not in the cache, and writes a table and a page with "
      "intervals (docs/study.md). Example:\n  dipper study studies/screening_rake.yaml");
  add_word(sub, "STUDY", "FILE", "case, seeds and parameters, as YAML")->required();
  add_word(sub, "--out", "DIR", "folder of the results (default: runs/study-STUDY)");
  sub->add_flag("--detach", "with Slurm: submit and exit; the same command collects");
  sub->add_flag("--cancel", "with Slurm: cancel what an earlier call submitted");
  return python_command(sub, "dipper_study", words);
}

Command add_gap_command(CLI::App& app, const std::vector<std::string>& words) {
  auto* sub = app.add_subcommand("gap", "what a case misses that the mine's measurements show");
  sub->footer(
      "Compares a case with measured passes, names the missing effect, and confirms it with fresh "
      "runs (docs/gap.md). Example:\n  dipper gap cases/screening --measured mine/shift/measured");
  add_word(sub, "CASE", "DIR", "a folder with a case.yaml")->required();
  add_word(sub, "--measured", "DIR", "channels.yaml, passes.csv and signals.csv of the mine");
  add_word(sub, "--reference", "DIR",
           "the same for earlier trucks, before the problem: what has changed since?");
  sub->add_flag(
      "--plan",
      "before data are taken: the smallest effect that 2, 4 and 8 trucks would show and name");
  add_word(sub, "--jobs", "N", "runs at a time (default: 2)")->check(CLI::Range(1, 256));
  sub->add_flag("--masses-only",
                "compare masses where the folder has no forces; they rarely identify an effect");
  add_word(sub, "--out", "DIR", "folder of the results (default: runs/gap-CASE)");
  return python_command(sub, "dipper_gap", words);
}

}  // namespace dipper::cli

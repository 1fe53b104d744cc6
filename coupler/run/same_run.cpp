#include "coupler/run/same_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "common/case_lines.hpp"
#include "common/resolved_path.hpp"
#include "common/sha256.hpp"
#include "common/text_file.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/case/schema.hpp"
#include "machine/motion.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

/// The lines of a case's text that must not change when a run is resumed.
std::set<std::string> fixed_lines(const CaseLines& text) {
  std::set<std::string> fixed;
  for (const CaseLine& line : text) {
    const cases::KeySpec* spec = cases::spec_of(line.key);  // none: the key is of another version
    if (spec == nullptr || spec->affects != cases::Affects::output)
      fixed.insert(line.key + '=' + line.value);
  }
  return fixed;
}

/// SHA-256 by path, relative to the case's folder: the files that the case names, and the YAML
/// files beside the meshes of dipper and truck.
std::map<std::string, std::string> input_hashes(const cases::Case& c) {
  const std::vector<fs::path> files = cases::referenced_files(c);
  std::map<std::string, std::string> hashes;
  for (const fs::path& file : files) {
    hashes[file.lexically_relative(c.folder).generic_string()] = sha256_file(file);
  }
  return hashes;
}

// Copies in the run's folder, for reports after the case's folder is moved or changed.
constexpr const char* kMotion = "motion.csv";
constexpr const char* kMachine = "machine.yaml";
constexpr const char* kPoses = "poses.csv";

/// Whether two motions are bit-identical up to a time.
bool same_until(const fs::path& before, const fs::path& now, double until_s) {
  if (!fs::is_regular_file(before)) return false;
  const auto a = machine::Motion::load(before), b = machine::Motion::load(now);
  if (a.start_ns() != b.start_ns()) return false;
  constexpr int kPerSecond = 100;
  for (int i = 0; i <= std::llround(until_s * kPerSecond); ++i) {
    const double t_s = static_cast<double>(i) / kPerSecond;
    const machine::DriveState x = a.at(t_s), y = b.at(t_s);
    for (const auto& [p, q] : {std::pair{x.position, y.position}, {x.rate, y.rate}})
      if (p.hoist != q.hoist || p.crowd != q.crowd || p.swing != q.swing || p.door != q.door)
        return false;
  }
  return true;
}

/// inputs.sha256 of a run; empty when the file is missing.
std::map<std::string, std::string> recorded_hashes(const fs::path& file) {
  std::map<std::string, std::string> hashes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto blank = line.find("  ");
    if (blank != std::string::npos) hashes[line.substr(blank + 2)] = line.substr(0, blank);
  }
  return hashes;
}

}  // namespace

void write_identity(const fs::path& folder, const cases::Case& c) {
  std::string inputs;
  for (const auto& [file, hash] : input_hashes(c)) inputs += hash + "  " + file + "\n";
  write_text(folder / "case.txt", c.text);
  write_text(folder / "inputs.sha256", inputs);
  const auto keep = [&](const fs::path& file, const char* name) {
    copy_contents(file, folder / name);
  };
  if (c.machine.kind == cases::MachineKind::poses) return keep(c.machine.poses, kPoses);
  keep(c.machine.motion, kMotion);
  keep(c.machine.model, kMachine);
}

std::vector<std::string> changed_since(const fs::path& folder, const cases::Case& c,
                                       double from_s) {
  const auto before = fixed_lines(CaseLines::read(folder / "case.txt"));
  const auto now = fixed_lines(CaseLines(c.text));
  std::vector<std::string> changed;
  std::set_symmetric_difference(before.begin(), before.end(), now.begin(), now.end(),
                                std::back_inserter(changed));
  const auto recorded = recorded_hashes(folder / "inputs.sha256");
  if (recorded.empty()) {
    changed.push_back("no inputs.sha256, which shows whether the case's files are unchanged");
    return changed;
  }
  const auto path = [&](const std::string& relative) {
    return resolved(c.folder / relative).string();
  };
  const auto hashes = input_hashes(c);
  for (const auto& [name, hash] : hashes) {
    const auto was = recorded.find(name);
    if (was == recorded.end()) {
      changed.push_back(path(name) + " was not part of it");
    } else if (was->second == hash) {
      continue;
    } else if (path(name) == c.machine.motion.string()) {
      if (!same_until(folder / kMotion, c.machine.motion, from_s))
        changed.push_back(fmt::format("{} differs before t = {:.3f} s, where the run continues",
                                      path(name), from_s));
    } else {
      changed.push_back(path(name) + " has changed");
    }
  }
  for (const auto& [name, hash] : recorded)
    if (hashes.count(name) == 0) changed.push_back(path(name) + " is no longer part of the case");
  return changed;
}

}  // namespace dipper::run

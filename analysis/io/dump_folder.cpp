#include "analysis/io/dump_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"
#include "common/case_lines.hpp"
#include "common/draft_file.hpp"
#include "common/json_text.hpp"

namespace dipper::analysis::io {
namespace fs = std::filesystem;
namespace {

/// The name before the step: "rocks" of rocks_1670.dump, "dump" of dump.1670.
std::string stem_of(const fs::path& given) {
  const fs::path file = without_gz(given);
  std::string name = file.filename().string();
  const auto step = step_in_name(file);
  if (!step) {
    const std::string ext = file.extension().string();
    const auto in_extension = step_in_name(fs::path(ext.empty() ? ext : ext.substr(1)));
    return in_extension ? file.stem().string() : name.substr(0, name.rfind('.'));
  }
  name = file.stem().string();
  name.erase(name.find_last_of("0123456789") + 1);
  while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.pop_back();
  while (!name.empty() && (name.back() == '_' || name.back() == '.' || name.back() == '-'))
    name.pop_back();
  return name.empty() ? "dump" : name;
}

/// Skips a file that cannot be read and has no step in its name, such as a log of another user.
bool is_text_dump(const fs::path& file) {
  if (access(file.c_str(), R_OK) != 0 && !step_in_name(file.filename())) return false;
  ByteReader in(file);
  return in.next_is("ITEM: TIMESTEP") || in.next_is("ITEM: UNITS") || in.next_is("ITEM: TIME");
}

/// By its extension: only gzip is unpacked here.
bool is_packed(const fs::path& file) {
  constexpr std::array<std::string_view, 4> kPackers{".bz2", ".xz", ".zst", ".lz4"};
  return std::find(kPackers.begin(), kPackers.end(), file.extension()) != kPackers.end();
}

using Groups = std::map<std::string, std::vector<fs::path>>;

const Groups::value_type& only(const Groups& groups, const fs::path& folder) {
  const auto rocks = groups.find("rocks");
  if (groups.size() == 1 || rocks != groups.end())
    return rocks != groups.end() ? *rocks : *groups.begin();
  std::string names;
  for (const auto& [name, files] : groups) names += (names.empty() ? "" : ", ") + name;
  throw input_error(
      folder, 0,
      fmt::format("particles of several dumps ({}); keep the files of one of them", names));
}

struct Found {
  Groups text, vtk, packed;  // packed: compressed, and not by gzip
  decltype(DumpFolder::walls) walls;
};

/// Whether a VTK file is a wall, by its header. One file decides for its group.
Found find_dumps(const fs::path& folder) {
  Found found;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && !is_draft(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::map<std::string, bool> is_wall;
  for (const fs::path& file : files) {
    const std::string ext = without_gz(file).extension().string();
    const std::string stem = stem_of(file);
    if (is_packed(file)) {
      found.packed[stem_of(file.stem())].push_back(file);
    } else if (ext == ".vtp" || ext == ".vtk") {
      const auto step = step_in_name(file);
      if (!step) continue;  // a single image, not a frame
      auto known = is_wall.find(stem + ext);
      if (known == is_wall.end())
        known = is_wall.emplace(stem + ext, index_vtk(file).polygon_count > 0).first;
      if (known->second) {
        found.walls[stem][*step] = file;
      } else {
        found.vtk[stem].push_back(file);
      }
    } else if (ext != ".series" && ext != ".vtr" && ext != ".pvd" && is_text_dump(file)) {
      found.text[stem].push_back(file);
    }
  }
  return found;
}

std::vector<fs::path> series_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".series") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Every file in a *.series must exist. Returns the time step of the first one that defines it.
std::optional<double> check_series(const fs::path& folder) {
  std::optional<double> timestep_s;
  for (const fs::path& file : series_files(folder)) {
    const nlohmann::json json = read_json_or_discard(file);
    if (!json.is_object() || !json.contains("files") || !json["files"].is_array())
      throw input_error(file, 1, "not a list of files in JSON: it was cut short");
    for (const auto& entry : json["files"]) {
      if (!entry.is_object() || !entry.value("name", nlohmann::json()).is_string() ||
          !entry.value("time", nlohmann::json(0)).is_number())
        throw input_error(file, 0,
                          "has an entry that is not {\"name\": a file, \"time\": a number}");
      const fs::path name = entry.value("name", "");
      if (!fs::exists(folder / name))
        throw input_error(file, 0, fmt::format("lists {}, which is missing", name.string()));
      const auto step = step_in_name(name);
      const double time = entry.value("time", 0.0);
      if (!timestep_s && step && *step > 0 && time > 0)
        timestep_s = time / static_cast<double>(*step);
    }
  }
  return timestep_s;
}

void check_names(const std::vector<DumpFrame>& frames) {
  std::map<fs::path, int> in_file;
  for (const DumpFrame& f : frames) ++in_file[f.file];
  for (const DumpFrame& f : frames) {
    const auto named = step_in_name(f.file);
    if (in_file[f.file] == 1 && named && *named != f.step &&
        without_gz(f.file).extension() != ".lammpstrj")
      throw input_error(f.file, 2,
                        fmt::format("holds step {}, but its name says {}; a dump of "
                                    "another run?",
                                    f.step, *named));
  }
}

/// Reports a missing frame in steps that are otherwise evenly spaced.
void check_spacing(const std::vector<DumpFrame>& frames, const fs::path& folder) {
  if (frames.size() < 3) return;
  const auto gap = [&](std::size_t i) { return frames[i].step - frames[i - 1].step; };
  std::int64_t least = gap(1);
  for (std::size_t i = 2; i < frames.size(); ++i) least = std::min(least, gap(i));
  std::vector<std::int64_t> missing;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (gap(i) % least != 0) return;  // not evenly spaced: no conclusion
    // Two equal gaps in a row mean a changed interval, from which the run continued.
    const bool alone =
        (i == 1 || gap(i - 1) != gap(i)) && (i + 1 == frames.size() || gap(i + 1) != gap(i));
    if (gap(i) > least && alone) missing.push_back(frames[i - 1].step + least);
  }
  if (missing.empty()) return;
  // A dump whose interval was changed on purpose has many wide gaps, not a few.
  if (2 * missing.size() > frames.size()) return;
  throw input_error(folder, 0,
                    fmt::format("the frame of step {} is missing: {} is every {} steps", missing[0],
                                stem_of(frames[0].file), least));
}

void check_walls(const DumpFolder& d) {
  for (const auto& [name, steps] : d.walls) {
    if (steps.size() < 2) continue;  // a wall that does not move, dumped once
    for (const DumpFrame& f : d.frames)
      if (steps.count(f.step) == 0)
        throw input_error(d.folder, 0,
                          fmt::format("the frame of step {} is missing from the wall {}; {} has it",
                                      f.step, name, f.file.filename().string()));
  }
}

/// The time step that the dumps' own times give, of the first frame to the last; nothing if they
/// have none.
std::optional<double> timestep_of_times(const std::vector<DumpFrame>& frames) {
  const DumpFrame &first = frames.front(), &last = frames.back();
  if (!first.time_s || !last.time_s || last.step == first.step) return std::nullopt;
  return (*last.time_s - *first.time_s) / static_cast<double>(last.step - first.step);
}

void check_times(const std::vector<DumpFrame>& frames, double timestep_s) {
  constexpr double kMost = 0.01;
  const auto fits_s = timestep_of_times(frames);
  if (!fits_s || *fits_s <= 0 || std::abs(timestep_s - *fits_s) <= kMost * *fits_s) return;
  const DumpFrame& last = frames.back();
  throw input_error(last.file, last.line,
                    fmt::format("ITEM: TIME is {:.6g} s at step {}, which a time step of {:.6g} s "
                                "does not give; {:.6g} s does: write that, or leave --timestep out",
                                *last.time_s, last.step, timestep_s, *fits_s));
}

}  // namespace

bool DumpFolder::has_velocities() const {
  return std::all_of(frames.begin(), frames.end(),
                     [](const DumpFrame& f) { return f.has("vx") && f.has("vy") && f.has("vz"); });
}

std::size_t DumpFolder::nearest(double t) const {
  const auto after = std::lower_bound(time_s.begin(), time_s.end(), t);
  if (after == time_s.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - time_s.begin());
  if (after == time_s.end()) return i - 1;
  return t - time_s[i - 1] <= time_s[i] - t ? i - 1 : i;
}

DumpFolder open_dump_folder(const fs::path& folder, std::optional<double> timestep_s) {
  DumpFolder d;
  d.folder = fs::is_directory(folder / "dumps") ? folder / "dumps" : folder;
  if (!fs::is_directory(d.folder)) throw input_error(d.folder, 0, "not a folder");
  Found found = find_dumps(d.folder);
  const bool none = found.text.empty() && found.vtk.empty();
  for (const auto& [name, files] : found.packed)
    if (none || found.text.count(name) + found.vtk.count(name) > 0)
      throw input_error(files.front(), 0,
                        "compressed in a way that is not read; unpack it, or compress it by gzip");
  if (none)
    throw input_error(d.folder, 0,
                      "no particle dumps; expected text dumps of `dump custom`, or .vtp or .vtk "
                      "files of `dump custom/vtk`");
  const auto& group = only(found.text.empty() ? found.vtk : found.text, d.folder);
  d.particles = group.first;
  d.walls = std::move(found.walls);
  d.frames = DumpReader(group.second).frames();
  check_names(d.frames);
  const auto listed_s = check_series(d.folder);
  check_spacing(d.frames, d.folder);
  check_walls(d);
  if (const fs::path text = folder / "case.txt"; !timestep_s && fs::exists(text))
    timestep_s = CaseLines::read(text).number("dem.timestep_s");
  if (!timestep_s) timestep_s = listed_s;
  if (timestep_s && *timestep_s <= 0)
    throw input_error(d.folder, 0, "the time step is not positive");
  if (timestep_s) check_times(d.frames, *timestep_s);
  d.timestep_s = timestep_s.value_or(0);
  for (const DumpFrame& f : d.frames) {
    if (!timestep_s && !f.time_s)
      throw input_error(f.file, f.line,
                        "the time step is not known: there is no case.txt and no *.series; give it "
                        "with --timestep");
    d.time_s.push_back(timestep_s ? static_cast<double>(f.step) * *timestep_s : *f.time_s);
  }
  return d;
}

}  // namespace dipper::analysis::io

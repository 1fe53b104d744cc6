#include "analysis/io/dump_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "analysis/io/kept_rows.hpp"
#include "analysis/io/line_reader.hpp"
#include "analysis/io/text_dump.hpp"
#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::io {
namespace {

bool is_vtk(const std::filesystem::path& file) {
  const std::filesystem::path end = without_gz(file).extension();
  return end == ".vtp" || end == ".vtk";
}

// A double represents whole numbers up to here.
constexpr std::int64_t kLargestStep = std::int64_t{1} << 53;

/// Columns as `dump custom` names them: v is vx, vy, vz.
std::vector<std::string> names_of(const VtkArray& a) {
  if (a.components == 1) return {a.name};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < a.components; ++k)
    names.push_back(a.components == 3 ? a.name + "xyz"[k] : fmt::format("{}[{}]", a.name, k + 1));
  return names;
}

DumpFrame index_vtk_dump(const std::filesystem::path& file) {
  const VtkFile vtk = index_vtk(file);
  DumpFrame frame;
  frame.file = file;
  const auto step = step_in_name(file);
  if (!step)
    throw input_error(file, 0, "no time step in the name; VTK dumps are named NAME_STEP.vtp");
  frame.step = *step;
  frame.line = vtk.points.line;
  frame.particles = vtk.points.tuples;
  frame.columns = {"x", "y", "z"};
  for (const VtkArray& a : vtk.point_data)
    for (const std::string& name : names_of(a)) frame.columns.push_back(name);
  return frame;
}

/// One array of a frame, and the columns for its components (or none).
struct Feed {
  VtkCursor cursor;
  std::size_t components;
  std::vector<std::size_t> target;
};

constexpr std::size_t kUnused = static_cast<std::size_t>(-1);

void read_vtk_dump(const DumpFrame& frame, const std::vector<std::string>& columns,
                   const std::function<void(const ParticleChunk&)>& visit) {
  const VtkFile vtk = index_vtk(frame.file);
  std::vector<Feed> feeds;
  const auto feed = [&](const VtkArray& a, const std::vector<std::string>& names) {
    std::vector<std::size_t> target(names.size(), kUnused);
    bool used = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto at = std::find(columns.begin(), columns.end(), names[i]);
      if (at == columns.end()) continue;
      target[i] = static_cast<std::size_t>(at - columns.begin());
      used = true;
    }
    if (a.tuples != vtk.points.tuples)
      throw input_error(frame.file, a.line,
                        fmt::format("array '{}' has {} values for {} points", a.name, a.tuples,
                                    vtk.points.tuples));
    if (used) feeds.push_back({VtkCursor(vtk, a), a.components, target});
  };
  feed(vtk.points, {"x", "y", "z"});
  for (const VtkArray& a : vtk.point_data) feed(a, names_of(a));
  ParticleChunk chunk;
  chunk.columns.assign(columns.size(), std::vector<double>(kChunkRows));
  std::vector<double> values;
  for (std::size_t done = 0; done < frame.particles; done += chunk.rows) {
    chunk.rows = std::min(kChunkRows, frame.particles - done);
    for (Feed& f : feeds) {
      values.resize(chunk.rows * f.components);
      f.cursor.read(values.data(), values.size());
      for (std::size_t c = 0; c < f.components; ++c) {
        if (f.target[c] == kUnused) continue;
        for (std::size_t i = 0; i < chunk.rows; ++i)
          chunk.columns[f.target[c]][i] = values[i * f.components + c];
      }
    }
    visit(chunk);
  }
}

/// How a requested column is computed from the file's columns.
struct Source {
  std::string name;
  double shift = 0, scale = 1;
};

Source source_of(const DumpFrame& frame, const std::string& column) {
  if (frame.has(column)) return {column};
  if (column.size() == 1 && column[0] >= 'x' && column[0] <= 'z') {
    if (frame.has(column + "u")) return {column + "u"};
    if (frame.has(column + "s") && frame.box) {
      if (frame.tilted)
        throw input_error(frame.file, frame.line,
                          fmt::format("{0}s is scaled to a tilted box, which is not read; add {0} "
                                      "to the dump's columns",
                                      column));
      const int axis = column[0] - 'x';
      return {column + "s", frame.box->min_m[axis], frame.box->sides_m()[axis]};
    }
  }
  if (column == "radius" && frame.has("diameter")) return {"diameter", 0, 0.5};
  throw input_error(
      frame.file, frame.line,
      fmt::format("particles without {}; add {} to the dump's columns", column, column));
}

}  // namespace

bool DumpFrame::has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::filesystem::path without_gz(std::filesystem::path file) {
  return file.extension() == ".gz" ? file.replace_extension() : file;
}

std::optional<std::int64_t> step_in_name(const std::filesystem::path& file) {
  const std::string name = without_gz(file).stem().string();
  const std::size_t end = name.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  std::size_t begin = end;
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  std::int64_t step = 0;
  if (!parse_number(std::string_view(name).substr(begin, end - begin + 1), step))
    return std::nullopt;
  return step;
}

DumpReader::DumpReader(const std::vector<std::filesystem::path>& files) {
  const auto kept = std::make_shared<KeptRows>();
  for (const auto& file : files) {
    if (is_vtk(file)) {
      frames_.push_back(index_vtk_dump(file));
      continue;
    }
    for (DumpFrame& frame : index_text_dump(file)) {
      frame.kept = kept;
      frames_.push_back(std::move(frame));
    }
  }
  std::stable_sort(frames_.begin(), frames_.end(),
                   [](const DumpFrame& a, const DumpFrame& b) { return a.step < b.step; });
  for (const DumpFrame& f : frames_)
    if (f.step < 0 || f.step > kLargestStep)
      throw input_error(f.file, f.line, fmt::format("{} is not a number of time steps", f.step));
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    const DumpFrame &a = frames_[i - 1], &b = frames_[i];
    if (a.step == b.step)
      throw input_error(b.file, b.line,
                        fmt::format("step {} is also in {}", b.step, a.file.filename().string()));
  }
}

void DumpReader::read(const DumpFrame& frame, const std::vector<std::string>& columns,
                      const std::function<void(const ParticleChunk&)>& visit) {
  std::vector<Source> sources;
  std::vector<std::string> names;
  for (const std::string& column : columns) {
    sources.push_back(source_of(frame, column));
    names.push_back(sources.back().name);
  }
  const auto scaled = [&](const ParticleChunk& chunk) {
    ParticleChunk made = chunk;
    for (std::size_t k = 0; k < sources.size(); ++k)
      if (sources[k].shift != 0 || sources[k].scale != 1)
        for (std::size_t i = 0; i < made.rows; ++i)
          made.columns[k][i] = sources[k].shift + sources[k].scale * made.columns[k][i];
    visit(made);
  };
  const bool as_they_are = std::all_of(
      sources.begin(), sources.end(), [](const Source& s) { return s.shift == 0 && s.scale == 1; });
  const auto hand_on = as_they_are ? visit : scaled;
  is_vtk(frame.file) ? read_vtk_dump(frame, names, hand_on) : read_text_dump(frame, names, hand_on);
}

}  // namespace dipper::analysis::io

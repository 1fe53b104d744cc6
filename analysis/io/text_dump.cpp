#include "analysis/io/text_dump.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/io/kept_rows.hpp"
#include "analysis/io/line_reader.hpp"

namespace dipper::analysis::io {
namespace {

bool starts(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

std::string_view header_line(LineReader& in, const char* what) {
  std::string_view text;
  if (!in.next(text))
    throw input_error(in.file(), in.line() + 1,
                      fmt::format("the file ends where {} should be: it was cut short", what));
  return text;
}

std::int64_t whole_number(LineReader& in, const char* what) {
  std::string_view text = header_line(in, what);
  std::int64_t value = 0;
  if (!parse_number(take_word(text), value) || !take_word(text).empty())
    throw input_error(in.file(), in.line(), fmt::format("{} is not a whole number", what));
  return value;
}

/// Three lines of two bounds, with a tilt factor each if the box is triclinic.
Box box_bounds(LineReader& in, bool& tilted) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    std::string_view text = header_line(in, "a box bound");
    if (!parse_number(take_word(text), box.min_m[i]) ||
        !parse_number(take_word(text), box.max_m[i]) || box.min_m[i] > box.max_m[i])
      throw input_error(in.file(), in.line(),
                        "not a box bound; write two numbers, the lower one first");
    double tilt_m = 0;
    if (parse_number(take_word(text), tilt_m) && tilt_m != 0) tilted = true;
  }
  return box;
}

/// Everything up to and including `ITEM: ATOMS ...`; `text` is the frame's first line.
DumpFrame read_header(LineReader& in, std::string_view text) {
  DumpFrame frame;
  frame.file = in.file();
  bool has_step = false, has_count = false;
  while (true) {
    if (starts(text, "ITEM: TIMESTEP")) {
      frame.step = whole_number(in, "the time step");
      has_step = true;
    } else if (starts(text, "ITEM: NUMBER OF ")) {
      const std::int64_t n = whole_number(in, "the number of particles");
      if (n < 0) throw input_error(in.file(), in.line(), "the number of particles is negative");
      frame.particles = static_cast<std::size_t>(n);
      has_count = true;
    } else if (starts(text, "ITEM: BOX BOUNDS")) {
      frame.box = box_bounds(in, frame.tilted);
    } else if (starts(text, "ITEM: TIME")) {
      double time_s = 0;
      std::string_view value = header_line(in, "the time");
      if (!parse_number(take_word(value), time_s))
        throw input_error(in.file(), in.line(), "the time is not a number");
      frame.time_s = time_s;
    } else if (starts(text, "ITEM: UNITS")) {
      const std::string_view units = take_word(text = header_line(in, "the units"));
      if (units != "si")
        throw input_error(in.file(), in.line(),
                          fmt::format("units are '{}'; expected 'si' (m, kg, s)", units));
    } else if (starts(text, "ITEM: ATOMS")) {
      if (!has_step || !has_count)
        throw input_error(in.file(), in.line(),
                          "particles before ITEM: TIMESTEP and ITEM: NUMBER OF ATOMS");
      text.remove_prefix(std::string_view("ITEM: ATOMS").size());
      for (auto word = take_word(text); !word.empty(); word = take_word(text))
        frame.columns.emplace_back(word);
      if (frame.columns.empty())
        throw input_error(in.file(), in.line(), "no column names after ITEM: ATOMS");
      frame.line = in.line();
      frame.offset = in.offset();
      return frame;
    } else {
      throw input_error(in.file(), in.line(),
                        fmt::format("'{}' is not a line of a dump's header; a text dump starts "
                                    "with ITEM: TIMESTEP",
                                    text.substr(0, 40)));
    }
    text = header_line(in, "the next ITEM");
  }
}

}  // namespace

std::vector<DumpFrame> index_text_dump(const std::filesystem::path& file) {
  LineReader in(file);
  std::vector<DumpFrame> frames;
  std::string_view text;
  while (in.next(text)) {
    frames.push_back(read_header(in, text));
    const std::size_t n = frames.back().particles;
    for (std::size_t i = 0; i < n; ++i) {
      const bool there = in.next(text);
      if (there && i + 1 == n && !in.ended_whole())
        throw input_error(file, in.line(),
                          "the last line has no end, so a digit may be missing: the file was cut "
                          "short; if it was not, write a line break there");
      if (!there || text.empty() || text.front() == 'I' || !in.ended_whole())
        throw input_error(file, there ? in.line() : in.line() + 1,
                          fmt::format("the frame of step {} ends after {} of {} particles: the "
                                      "file was cut short",
                                      frames.back().step, i, n));
    }
  }
  if (frames.empty())
    throw input_error(file, 1, "empty file; a text dump starts with ITEM: TIMESTEP");
  return frames;
}

namespace {

constexpr std::size_t kNotAsked = static_cast<std::size_t>(-1);

/// Rows of a frame in the order of its file. Column c of the file goes to column target[c] of the
/// chunks; `bad` is called for a word that is not a number.
void stream_rows(const DumpFrame& frame, const std::vector<std::size_t>& target,
                 ParticleChunk& chunk,
                 const std::function<void(std::size_t column, const BadWord&)>& bad,
                 const std::function<void(const ParticleChunk&)>& visit) {
  LineReader in(frame.file, frame.offset, frame.line + 1);
  std::string_view text;
  for (std::size_t i = 0; i < frame.particles; ++i) {
    if (!in.next(text)) throw input_error(frame.file, in.line() + 1, "the file was cut short");
    for (std::size_t c = 0; c < target.size(); ++c) {
      const std::string_view word = take_word(text);
      if (word.empty())
        throw input_error(frame.file, in.line(),
                          fmt::format("{} values, but {} columns", c, target.size()));
      if (target[c] == kNotAsked) continue;
      if (!parse_number(word, chunk.columns[target[c]][chunk.rows]))
        bad(c, {in.line(), std::string(word)});
    }
    if (!take_word(text).empty())
      throw input_error(frame.file, in.line(),
                        fmt::format("more values than the {} columns", target.size()));
    if (++chunk.rows == kChunkRows) {
      visit(chunk);
      chunk.rows = 0;
    }
  }
  if (chunk.rows > 0) visit(chunk);
}

[[noreturn]] void refuse(const DumpFrame& frame, std::size_t column, const BadWord& bad) {
  throw input_error(frame.file, bad.line,
                    fmt::format("{} '{}' is not a number", frame.columns[column], bad.word));
}

ParticleChunk empty_chunk(std::size_t columns) {
  ParticleChunk chunk;
  chunk.columns.assign(columns, std::vector<double>(kChunkRows));
  return chunk;
}

FrameRows all_rows(const DumpFrame& frame) {
  const std::size_t n = frame.columns.size();
  FrameRows all;
  all.columns.resize(n);
  for (auto& column : all.columns) column.reserve(frame.particles);
  all.bad.resize(n);
  std::vector<std::size_t> target(n);
  for (std::size_t c = 0; c < n; ++c) target[c] = c;
  ParticleChunk chunk = empty_chunk(n);
  stream_rows(
      frame, target, chunk,
      [&](std::size_t c, const BadWord& bad) {
        if (all.bad[c].line == 0) all.bad[c] = bad;
      },
      [&](const ParticleChunk& rows) {
        for (std::size_t c = 0; c < n; ++c)
          all.columns[c].insert(all.columns[c].end(), rows.columns[c].begin(),
                                rows.columns[c].begin() + static_cast<std::ptrdiff_t>(rows.rows));
      });
  return all;
}

}  // namespace

void read_text_dump(const DumpFrame& frame, const std::vector<std::string>& columns,
                    const std::function<void(const ParticleChunk&)>& visit) {
  std::vector<std::size_t> of_file;  // of each requested column
  for (const std::string& name : columns)
    of_file.push_back(static_cast<std::size_t>(
        std::find(frame.columns.begin(), frame.columns.end(), name) - frame.columns.begin()));
  ParticleChunk chunk = empty_chunk(columns.size());
  const FrameRows* kept =
      frame.kept ? frame.kept->rows(frame, [&] { return all_rows(frame); }) : nullptr;
  if (kept == nullptr) {
    std::vector<std::size_t> target(frame.columns.size(), kNotAsked);
    for (std::size_t k = 0; k < columns.size(); ++k) target.at(of_file[k]) = k;
    stream_rows(
        frame, target, chunk, [&](std::size_t c, const BadWord& bad) { refuse(frame, c, bad); },
        visit);
    return;
  }
  for (const std::size_t c : of_file)
    if (kept->bad.at(c).line != 0) refuse(frame, c, kept->bad[c]);
  for (std::size_t done = 0; done < frame.particles; done += chunk.rows) {
    chunk.rows = std::min(kChunkRows, frame.particles - done);
    for (std::size_t k = 0; k < of_file.size(); ++k)
      std::copy_n(kept->columns[of_file[k]].begin() + static_cast<std::ptrdiff_t>(done), chunk.rows,
                  chunk.columns[k].begin());
    visit(chunk);
  }
}

}  // namespace dipper::analysis::io

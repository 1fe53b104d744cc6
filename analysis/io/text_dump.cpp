#include "analysis/io/text_dump.hpp"

#include <fmt/format.h>

#include <algorithm>

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

Box box_bounds(LineReader& in) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    std::string_view text = header_line(in, "a box bound");
    if (!parse_number(take_word(text), box.min_m[i]) ||
        !parse_number(take_word(text), box.max_m[i]) || box.min_m[i] > box.max_m[i])
      throw input_error(in.file(), in.line(), "not a box bound; two numbers, the lower one first");
  }
  return box;
}

/// Everything up to and with `ITEM: ATOMS ...`; `text` is the frame's first line.
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
      frame.box = box_bounds(in);
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
                          fmt::format("units are '{}'; a dump in 'si' (m, kg, s)", units));
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
                        fmt::format("'{}' is no line of a dump's header; a text dump starts "
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
      if (!there || text.empty() || text.front() == 'I' || !in.ended_whole())
        throw input_error(file, there ? in.line() : in.line() + 1,
                          fmt::format("the frame of step {} ends after {} of {} particles: the "
                                      "file was cut short",
                                      frames.back().step, i, n));
    }
  }
  if (frames.empty()) throw input_error(file, 1, "empty; a text dump starts with ITEM: TIMESTEP");
  return frames;
}

void read_text_dump(const DumpFrame& frame, const std::vector<std::string>& columns,
                    const std::function<void(const ParticleChunk&)>& visit) {
  constexpr std::size_t kUnused = static_cast<std::size_t>(-1);
  std::vector<std::size_t> target(frame.columns.size(), kUnused);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto at = std::find(frame.columns.begin(), frame.columns.end(), columns[k]);
    target.at(static_cast<std::size_t>(at - frame.columns.begin())) = k;
  }
  ParticleChunk chunk;
  chunk.columns.assign(columns.size(), std::vector<double>(kChunkRows));
  LineReader in(frame.file, frame.offset, frame.line + 1);
  std::string_view text;
  for (std::size_t i = 0; i < frame.particles; ++i) {
    if (!in.next(text)) throw input_error(frame.file, in.line() + 1, "the file was cut short");
    for (std::size_t c = 0; c < target.size(); ++c) {
      const std::string_view word = take_word(text);
      if (word.empty())
        throw input_error(frame.file, in.line(),
                          fmt::format("{} values, but {} columns", c, target.size()));
      if (target[c] == kUnused) continue;
      if (!parse_number(word, chunk.columns[target[c]][chunk.rows]))
        throw input_error(frame.file, in.line(),
                          fmt::format("{} '{}' is not a number", frame.columns[c], word));
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

}  // namespace dipper::analysis::io

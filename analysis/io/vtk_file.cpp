#include "analysis/io/vtk_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "analysis/io/line_reader.hpp"

namespace dipper::analysis::io {
namespace {

template <typename T>
double value_at(const char* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return static_cast<double>(v);
}

double number(VtkArray::Type type, const char* p) {
  using Type = VtkArray::Type;
  switch (type) {
    case Type::i8:
      return value_at<std::int8_t>(p);
    case Type::u8:
      return value_at<std::uint8_t>(p);
    case Type::i16:
      return value_at<std::int16_t>(p);
    case Type::u16:
      return value_at<std::uint16_t>(p);
    case Type::i32:
      return value_at<std::int32_t>(p);
    case Type::u32:
      return value_at<std::uint32_t>(p);
    case Type::i64:
      return value_at<std::int64_t>(p);
    case Type::u64:
      return value_at<std::uint64_t>(p);
    case Type::f32:
      return value_at<float>(p);
    case Type::f64:
      return value_at<double>(p);
  }
  return 0;
}

int base64_value(int c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return -1;
}

const VtkArray* find(const std::vector<VtkArray>& arrays, const std::string& name) {
  const auto at =
      std::find_if(arrays.begin(), arrays.end(), [&](const VtkArray& a) { return a.name == name; });
  return at == arrays.end() ? nullptr : &*at;
}

}  // namespace

std::size_t vtk_detail::bytes(VtkArray::Type type) {
  using Type = VtkArray::Type;
  switch (type) {
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    default:
      return 8;
  }
}

void vtk_detail::check_room(const std::filesystem::path& file, const VtkArray& a,
                            std::int64_t file_size) {
  // A value takes at least a digit, or its bytes, which are longer in base64.
  const std::size_t least = a.form == VtkArray::Form::ascii ? 1 : bytes(a.type);
  const auto most =
      static_cast<std::size_t>(std::max<std::int64_t>(0, file_size - a.offset)) / least;
  if (a.components == 0 || a.components > std::max<std::size_t>(most, 9) ||
      a.tuples > most / a.components)
    throw input_error(
        file, a.line,
        fmt::format("array '{}' says it has {} x {} values; {} bytes are left of the "
                    "file: cut short, or miscounted",
                    a.name.substr(0, 40), a.tuples, a.components, file_size - a.offset));
}

const VtkArray* VtkFile::point_array(const std::string& name) const {
  return find(point_data, name);
}
const VtkArray* VtkFile::cell_array(const std::string& name) const { return find(cell_data, name); }

VtkFile index_vtk(const std::filesystem::path& file) {
  return file.extension() == ".vtp" ? vtk_detail::index_xml(file) : vtk_detail::index_legacy(file);
}

VtkCursor::VtkCursor(const VtkFile& file, const VtkArray& array)
    : array_(array), in_(file.file, array.offset, array.line) {
  if (array_.form != VtkArray::Form::base64) return;
  char header[8] = {};
  decode(header, array_.header_bytes);
  if (array_.swapped) std::reverse(header, header + array_.header_bytes);
  const double size =
      number(array_.header_bytes == 8 ? VtkArray::Type::u64 : VtkArray::Type::u32, header);
  const auto due =
      static_cast<double>(array_.tuples * array_.components * vtk_detail::bytes(array_.type));
  if (size != due)
    throw input_error(file.file, array.line,
                      fmt::format("array '{}' has {:.0f} bytes instead of {:.0f} (compressed? "
                                  "write it with `dump_modify ID compressor none`)",
                                  array.name, size, due));
}

void VtkCursor::decode(char* out, std::size_t n) {
  for (std::size_t i = 0; i < n;) {
    if (bit_count_ >= 8) {
      bit_count_ -= 8;
      out[i++] = static_cast<char>((bits_ >> bit_count_) & 0xffU);
      continue;
    }
    const int c = in_.get();
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int v = base64_value(c);
    if (v < 0)
      throw input_error(in_.file(), in_.line(),
                        fmt::format("array '{}' ends too early, or is not base64", array_.name));
    bits_ = (bits_ << 6) | static_cast<unsigned>(v);
    bit_count_ += 6;
  }
}

void VtkCursor::read(double* out, std::size_t n) {
  if (array_.form == VtkArray::Form::ascii) {
    for (std::size_t i = 0; i < n; ++i) {
      in_.word(word_);
      if (word_.empty() || !parse_number(word_, out[i]))
        throw input_error(in_.file(), in_.line(),
                          word_.empty()
                              ? fmt::format("array '{}' ends too early: cut short", array_.name)
                              : fmt::format("array '{}': '{}' is not a number", array_.name,
                                            word_.substr(0, 40)));
    }
    return;
  }
  const std::size_t size = vtk_detail::bytes(array_.type);
  raw_.resize(n * size);
  if (array_.form == VtkArray::Form::base64) {
    decode(raw_.data(), raw_.size());
  } else if (!in_.bytes(raw_.data(), raw_.size())) {
    throw input_error(in_.file(), array_.line,
                      fmt::format("array '{}' ends too early: cut short", array_.name));
  }
  for (std::size_t i = 0; i < n; ++i) {
    char* p = raw_.data() + i * size;
    if (array_.swapped) std::reverse(p, p + size);
    out[i] = number(array_.type, p);
    if (!std::isfinite(out[i]))
      throw input_error(in_.file(), array_.line,
                        fmt::format("array '{}' has a value that is not a number", array_.name));
  }
}

std::vector<double> read_array(const VtkFile& file, const VtkArray& array) {
  std::vector<double> out(array.tuples * array.components);
  VtkCursor(file, array).read(out.data(), out.size());
  return out;
}

namespace {

/// Where each cell's corners begin and end, and their points.
class Cells {
 public:
  explicit Cells(const VtkFile& file) : file_(file) {
    if (file.connectivity && file.offsets) {
      from_ends();
    } else if (file.polygons) {
      from_counts();
    }
    if (first_.size() != file.polygon_count + 1)
      fail(file.points.line,
           fmt::format("{} polygons instead of {}", first_.size() - 1, file.polygon_count));
  }

  std::size_t count() const { return first_.size() - 1; }
  std::size_t begin(std::size_t cell) const { return first_[cell]; }
  std::size_t end(std::size_t cell) const { return first_[cell + 1]; }
  /// The point of a corner; less than `points`.
  std::size_t point(std::size_t corner, std::size_t points) const {
    const double p = corners_[corner];
    if (!(p >= 0 && p < static_cast<double>(points)))
      fail(file_.points.line, fmt::format("a cell uses point {}, but there are {}", p, points));
    return static_cast<std::size_t>(p);
  }

 private:
  [[noreturn]] void fail(long line, const std::string& what) const {
    throw input_error(file_.file, line, what);
  }

  void from_ends() {
    corners_ = read_array(file_, *file_.connectivity);
    const std::vector<double> ends = read_array(file_, *file_.offsets);
    // XML counts ends from the first cell, legacy 5.1 has a 0 in front.
    for (std::size_t i = ends.size() == file_.polygon_count ? 0 : 1; i < ends.size(); ++i) {
      const bool sound = ends[i] >= static_cast<double>(first_.back()) &&
                         ends[i] <= static_cast<double>(corners_.size());
      if (!sound)
        fail(file_.offsets->line, fmt::format("polygon {} ends at corner {}, of {}", first_.size(),
                                              ends[i], corners_.size()));
      first_.push_back(static_cast<std::size_t>(ends[i]));
    }
  }

  void from_counts() {
    const std::vector<double> all = read_array(file_, *file_.polygons);
    for (std::size_t i = 0; i < all.size();) {
      const double n = all[i++];
      if (!(n >= 0 && n <= static_cast<double>(all.size() - i)))
        fail(file_.polygons->line, fmt::format("polygon {} has {} corners; {} numbers are left",
                                               first_.size(), n, all.size() - i));
      for (const std::size_t end = i + static_cast<std::size_t>(n); i < end; ++i)
        corners_.push_back(all[i]);
      first_.push_back(corners_.size());
    }
  }

  const VtkFile& file_;
  std::vector<double> corners_;
  std::vector<std::size_t> first_{0};
};

}  // namespace

WallDump read_wall_dump(const VtkFile& file) {
  const std::vector<double> xyz = read_array(file, file.points);
  const Cells cells(file);
  for (const VtkArray& a : file.cell_data)
    if (a.tuples != cells.count())
      throw input_error(
          file.file, a.line,
          fmt::format("array '{}' has {} values for {} polygons", a.name, a.tuples, cells.count()));
  const auto point = [&](std::size_t corner) {
    const std::size_t p = cells.point(corner, xyz.size() / 3);
    return Eigen::Vector3d(xyz[3 * p], xyz[3 * p + 1], xyz[3 * p + 2]);
  };
  WallDump wall;
  for (std::size_t c = 0; c < cells.count(); ++c) {
    for (std::size_t k = cells.begin(c) + 1; k + 1 < cells.end(c); ++k) {
      wall.mesh.add_loose({point(cells.begin(c)), point(k), point(k + 1)});
      wall.cell.push_back(c);
    }
  }
  return wall;
}

}  // namespace dipper::analysis::io

#include "common/mesh/stl.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "common/input_error.hpp"
#include "common/mesh/other_format.hpp"
#include "common/numbers.hpp"
#include "common/text_file.hpp"

namespace dipper::mesh {
namespace {

// Gives close vertices one number. A grid of cells as wide as the distance, and a look into the 27
// cells around: rounding alone would separate two close points across a cell's edge.
class Welder {
 public:
  explicit Welder(double distance) : distance_(distance) {}

  std::size_t index(TriangleMesh& mesh, const Eigen::Vector3d& v) {
    const Cell centre = cell(v);
    for (int n = 0; n < 27; ++n) {
      const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 - 1;
      const auto found = cells_.find({centre[0] + dx, centre[1] + dy, centre[2] + dz});
      if (found == cells_.end()) continue;
      if (((mesh.vertices[found->second] - v).array().abs() <= distance_).all()) {
        return found->second;
      }
    }
    mesh.vertices.push_back(v);
    cells_[centre] = mesh.vertices.size() - 1;
    return mesh.vertices.size() - 1;
  }

 private:
  using Cell = std::array<double, 3>;  // whole numbers; double, so that no coordinate overflows
  Cell cell(const Eigen::Vector3d& v) const {
    return {std::floor(v.x() / distance_), std::floor(v.y() / distance_),
            std::floor(v.z() / distance_)};
  }

  double distance_;
  std::map<Cell, std::size_t> cells_;
};

bool is_word(std::string_view got, std::string_view word) {
  return std::equal(got.begin(), got.end(), word.begin(), word.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

// One step of a number's last digit: 0.001 of 12.345, 10 of 1.2345e5.
double last_digit(std::string_view word) {
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const std::size_t point = std::min(word.substr(0, e).find('.'), e);
  double exponent = 0;
  if (e < word.size()) parse_number(word.substr(e + 1), exponent);
  return std::pow(10, exponent - static_cast<double>(point == e ? 0 : e - point - 1));
}

// Words of an ascii file, each with its line.
class Words {
 public:
  Words(std::string_view text, std::filesystem::path file) : text_(text), file_(std::move(file)) {}

  int line() const { return line_; }

  std::string_view next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
      if (ends_line(at_++)) ++line_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// A keyword, which some programs write in capitals.
  void expect(std::string_view word) {
    const std::string_view got = next();
    if (!is_word(got, word)) fail(fmt::format("{} where '{}' belongs", shown(got), word));
  }

  double number() {
    const std::string_view word = next();
    double x = 0;
    if (!parse_number(word, x))
      fail(fmt::format(
          "{} {}", shown(word),
          word.empty()                               ? "where a number belongs"
          : word.find(',') != std::string_view::npos ? "is not a number; write decimal points"
          : word.find_first_of("dD") != std::string_view::npos ? "is not a number; write E for D"
                                                               : "is not a number"));
    finest_digit_ = std::min(finest_digit_, last_digit(word));
    return x;
  }

  /// What one step of the last digit is worth, in the number that is written most finely.
  double finest_digit() const { return finest_digit_; }

  // The rest of a line: the name after "solid", which may be anything.
  void skip_line() {
    while (at_ < text_.size() && !ends_line(at_)) ++at_;
  }

  /// A word for a message; an empty one is the file's end.
  static std::string shown(std::string_view word) {
    return word.empty() ? "the file ends" : fmt::format("'{}'", word);
  }

  /// Whether a line ends there, as Unix, Windows or old Macs end it.
  bool ends_line(std::size_t at) const {
    if (text_[at] != '\r') return text_[at] == '\n';
    return at + 1 == text_.size() || text_[at + 1] != '\n';
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({{file_, line_, "", "not an ascii STL file: " + message}});
  }

 private:
  std::string_view text_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
  int line_ = 1;
  double finest_digit_ = std::numeric_limits<double>::infinity();
};

// Facets as in the file, and how coarsely their coordinates are written [m].
struct Facets {
  std::vector<Triangle> corners;
  double rounded_to_m = 0;
};

Facets parse_ascii(std::string_view text, const std::filesystem::path& file) {
  Facets facets;
  Words words(text, file);
  std::string_view word = words.next();
  while (!word.empty()) {  // a file may hold several solids
    if (!is_word(word, "solid")) words.fail(fmt::format("'{}' where 'solid' belongs", word));
    words.skip_line();
    for (word = words.next(); is_word(word, "facet"); word = words.next()) {
      words.expect("normal");
      // Any three words: a degenerate facet's normal is often "nan nan nan", which the check of
      // its area reports better.
      for (int i = 0; i < 3; ++i) words.next();
      words.expect("outer");
      words.expect("loop");
      Triangle triangle;
      for (Eigen::Vector3d& v : triangle) {
        words.expect("vertex");
        for (int i = 0; i < 3; ++i) v[i] = words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
      facets.corners.push_back(triangle);
    }
    if (!is_word(word, "endsolid"))
      words.fail(fmt::format("{} where 'facet' or 'endsolid' belongs", Words::shown(word)));
    words.skip_line();
    word = words.next();
  }
  facets.rounded_to_m = words.finest_digit();
  return facets;
}

constexpr std::size_t header_bytes = 84;  // 80 of text and the number of facets
constexpr std::size_t facet_bytes = 50;   // 12 floats and 2 bytes of attributes
constexpr float farthest_m = 1e12F;       // beyond a mine's coordinates in mm

std::uint32_t swapped(std::uint32_t x) { return __builtin_bswap32(x); }

std::uint32_t facet_count(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);  // little-endian, as is every host of ours
  return count;
}

// Refuses a file that is not as long as the count in its header says, with the likely reason.
template <typename Fail>
void check_size(const std::string& bytes, const Fail& fail) {
  const std::size_t count = facet_count(bytes), held = (bytes.size() - header_bytes) / facet_bytes;
  const std::size_t needed = header_bytes + count * facet_bytes;
  if (bytes.size() == needed) return;
  if (bytes.size() == header_bytes + std::size_t{swapped(facet_count(bytes))} * facet_bytes)
    fail(80, fmt::format("the number of facets, {}, is big-endian; a binary STL is little-endian: "
                         "write the file again, as little-endian or as text",
                         held));
  if (bytes.size() == header_bytes + held * facet_bytes)
    fail(80,
         fmt::format("the header says {} facets, and the file has {}: it was not written to its "
                     "end, or cut short; write or copy it again",
                     count, held));
  if (bytes.size() > needed)
    fail(needed, fmt::format("{} bytes too many after the {} facets of the header; write the file "
                             "again, as plain STL",
                             bytes.size() - needed, count));
  if (count < 1000 * (held + 1))
    fail(bytes.size(), fmt::format("the header says {} facets, which takes {} bytes; the file ends "
                                   "after {}: it was cut short; write or copy it again",
                                   count, needed, bytes.size()));
  fail(0, fmt::format("no STL file: a text one begins with 'solid', and a binary one of {} bytes "
                      "has {} facets, not the {} that bytes 80 to 83 say; export the mesh as STL",
                      bytes.size(), held, count));
}

Facets parse_binary(const std::string& bytes, const std::filesystem::path& file) {
  const auto fail = [&](std::size_t byte, const std::string& message) {
    throw InputError({{file, 0, "", fmt::format("at byte {}: {}", byte, message)}});
  };
  check_size(bytes, fail);
  const std::size_t count = facet_count(bytes);
  Facets facets;
  float largest = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t at = header_bytes + n * facet_bytes + 12;  // after the normal
    std::array<float, 9> x{};
    std::memcpy(x.data(), bytes.data() + at, sizeof x);
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
      if (!triangle[i].allFinite()) {
        fail(at + 12 * i, fmt::format("facet {}: a coordinate is not a finite number", n + 1));
      }
      for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(x[3 * i + k]));
    }
    facets.corners.push_back(triangle);
  }
  // Of big-endian floats read as little-endian, some are as large as floats can be.
  if (largest > farthest_m)
    throw InputError({{file, 0, "",
                       fmt::format("coordinates of up to {:.1g} m: the numbers are big-endian, or "
                                   "the file is damaged; write it again, as little-endian or as "
                                   "text",
                                   largest)}});
  facets.rounded_to_m = std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest;
  return facets;
}

// Many binary files also begin with "solid"; only their size decides. A file that fits neither is
// read as ascii when it is text, so that the message has a line.
bool is_binary(const std::string& bytes, std::string_view text) {
  if (bytes.size() >= header_bytes &&
      bytes.size() == header_bytes + facet_count(bytes) * facet_bytes) {
    return true;
  }
  return bytes.size() >= header_bytes &&
         (!is_word(text.substr(0, 5), "solid") || bytes.find('\0') != std::string::npos);
}

// Without a byte-order mark and the Ctrl-Z with which DOS ends a text.
std::string_view text_of(std::string_view bytes) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (bytes.substr(0, mark.size()) == mark) bytes.remove_prefix(mark.size());
  const std::size_t last = bytes.find_last_not_of(" \t\r\n");
  if (last != std::string_view::npos && bytes[last] == '\x1A') bytes = bytes.substr(0, last);
  return bytes;
}

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

// A mesh in a mine's coordinates whose digits do not reach its own size is another mesh.
constexpr double coarsest_rounding = 1e-3;  // of the mesh's diagonal

void check_rounding(const Box& box, double rounded_to_m, const std::filesystem::path& file) {
  const double diagonal = box.sides_m().norm();
  const double far = std::max(box.min_m.cwiseAbs().maxCoeff(), box.max_m.cwiseAbs().maxCoeff());
  if (rounded_to_m <= coarsest_rounding * diagonal || far < 10 * diagonal) return;
  throw InputError({{file, 0, "",
                     fmt::format("coordinates of up to {:.7g} m are rounded to {:.2g} m, and the "
                                 "mesh is {:.3g} m across: its shape is lost; move it to its own "
                                 "origin before it is written, or write more digits",
                                 far, rounded_to_m, diagonal)}});
}

std::string bytes_of(const std::filesystem::path& file) {
  std::optional<std::string> bytes = read_bytes(file);
  if (!bytes) throw InputError({{file, 0, "", "no such file, or it cannot be read"}});
  return *std::move(bytes);
}

}  // namespace

TriangleMesh parse_stl(const std::string& bytes, const std::filesystem::path& file) {
  const std::string_view text = text_of(bytes), begin = without_blanks(text);
  const bool binary = is_binary(bytes, begin);
  if (const std::string other = other_format(begin);
      !other.empty() && !is_word(begin.substr(0, 5), "solid"))
    if (!binary || bytes.size() != header_bytes + facet_count(bytes) * facet_bytes)
      throw InputError(
          {{file, 0, "",
            other == git_pointer ? "is a pointer of Git LFS to a file; git lfs pull brings the file"
                                 : fmt::format("is a {} file; export the mesh as STL", other)}});
  const Facets facets = binary ? parse_binary(bytes, file) : parse_ascii(text, file);
  if (facets.corners.empty()) throw InputError({{file, 0, "", "holds no facets"}});
  Box box;
  for (const Triangle& triangle : facets.corners)
    for (const Eigen::Vector3d& v : triangle) box.add(v);
  check_rounding(box, facets.rounded_to_m, file);
  TriangleMesh mesh;
  Welder welder(weld_distance(box.sides_m().norm()));
  for (const Triangle& triangle : facets.corners)
    mesh.triangles.push_back({welder.index(mesh, triangle[0]), welder.index(mesh, triangle[1]),
                              welder.index(mesh, triangle[2])});
  return mesh;
}

double weld_distance(double diagonal_m) { return std::min(1e-6, 1e-6 * diagonal_m); }

TriangleMesh read_stl(const std::filesystem::path& file) { return parse_stl(bytes_of(file), file); }

bool is_plain_stl(const std::filesystem::path& file) {
  const std::string bytes = bytes_of(file);
  const std::string_view text = without_blanks(text_of(bytes));
  const bool named_solid = is_word(text.substr(0, 5), "solid");
  if (is_binary(bytes, text)) return !named_solid;
  const std::size_t name_ends = std::min(bytes.find('\n'), bytes.size());
  return bytes.compare(0, 5, "solid") == 0 && bytes.find("facet") > name_ends &&
         bytes.find("facet normal", name_ends) != std::string::npos &&
         bytes.find_first_of("\r\x1A") == std::string::npos;
}

bool is_stl(const std::filesystem::path& file) {
  std::string end = file.extension().string();
  for (char& ch : end) ch = static_cast<char>(std::tolower(static_cast<unsigned char>(ch)));
  return end == ".stl";
}

std::string to_stl(const std::string& name, const TriangleMesh& mesh) {
  // Adding zero writes -0 as 0.
  const auto numbers = [](const Eigen::Vector3d& v, int digits) {
    return fmt::format("{:.{}g} {:.{}g} {:.{}g}", v.x() + 0.0, digits, v.y() + 0.0, digits,
                       v.z() + 0.0, digits);
  };
  std::string out = "solid " + name + "\n";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.corners(i);
    const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    out += " facet normal " + numbers(normal, 6) + "\n  outer loop\n";
    for (const Eigen::Vector3d& p : t) out += "   vertex " + numbers(p, 7) + "\n";
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid " + name + "\n";
}

}  // namespace dipper::mesh

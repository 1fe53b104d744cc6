#include "common/mesh/stl.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

#include "common/input_error.hpp"
#include "common/numbers.hpp"

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

// Words of an ascii file, each with its line.
class Words {
 public:
  Words(std::string_view text, std::filesystem::path file) : text_(text), file_(std::move(file)) {}

  int line() const { return line_; }

  std::string_view next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
      if (text_[at_++] == '\n') ++line_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void expect(std::string_view word) {
    const std::string_view got = next();
    if (got != word) fail(fmt::format("'{}' where '{}' belongs", got, word));
  }

  double number() {
    const std::string_view word = next();
    double x = 0;
    if (!parse_number(word, x)) fail(fmt::format("'{}' where a number belongs", word));
    return x;
  }

  // The rest of a line: the name after "solid", which may be anything.
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({{file_, line_, "", "not an ascii STL file: " + message}});
  }

 private:
  std::string_view text_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

TriangleMesh parse_ascii(std::string_view text, double weld, const std::filesystem::path& file) {
  TriangleMesh mesh;
  Welder welder(weld);
  Words words(text, file);
  std::string_view word = words.next();
  while (!word.empty()) {  // a file may hold several solids
    if (word != "solid") words.fail(fmt::format("'{}' where 'solid' belongs", word));
    words.skip_line();
    for (word = words.next(); word == "facet"; word = words.next()) {
      words.expect("normal");
      // Any three words: a degenerate facet's normal is often "nan nan nan", which the check of
      // its area reports better.
      for (int i = 0; i < 3; ++i) words.next();
      words.expect("outer");
      words.expect("loop");
      std::array<std::size_t, 3> triangle{};
      for (std::size_t& corner : triangle) {
        words.expect("vertex");
        Eigen::Vector3d v;
        for (int i = 0; i < 3; ++i) {
          v[i] = words.number();
        }
        corner = welder.index(mesh, v);
      }
      words.expect("endloop");
      words.expect("endfacet");
      mesh.triangles.push_back(triangle);
    }
    if (word != "endsolid")
      words.fail(fmt::format("'{}' where 'facet' or 'endsolid' belongs", word));
    words.skip_line();
    word = words.next();
  }
  return mesh;
}

constexpr std::size_t header_bytes = 84;  // 80 of text and the number of facets
constexpr std::size_t facet_bytes = 50;   // 12 floats and 2 bytes of attributes

std::uint32_t facet_count(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);  // little-endian, as is every host of ours
  return count;
}

TriangleMesh parse_binary(const std::string& bytes, double weld,
                          const std::filesystem::path& file) {
  const auto fail = [&](std::size_t byte, const std::string& message) {
    throw InputError({{file, 0, "", fmt::format("at byte {}: {}", byte, message)}});
  };
  const std::size_t count = facet_count(bytes);
  const std::size_t needed = header_bytes + count * facet_bytes;
  if (bytes.size() < needed) {
    fail(bytes.size(),
         fmt::format("the header says {} facets, which takes {} bytes; the file ends after {}",
                     count, needed, bytes.size()));
  }
  if (bytes.size() > needed) {
    fail(needed, fmt::format("{} bytes too many after the {} facets of the header",
                             bytes.size() - needed, count));
  }
  TriangleMesh mesh;
  Welder welder(weld);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t at = header_bytes + n * facet_bytes + 12;  // after the normal
    std::array<float, 9> x{};
    std::memcpy(x.data(), bytes.data() + at, sizeof x);
    std::array<std::size_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d v(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
      if (!v.allFinite()) {
        fail(at + 12 * i, fmt::format("facet {}: a coordinate is no finite number", n + 1));
      }
      triangle[i] = welder.index(mesh, v);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

// Many binary files also begin with "solid"; only their size tells. What neither fits is read as
// ascii when it is text, so that the message has a line.
bool is_binary(const std::string& bytes) {
  if (bytes.size() >= header_bytes &&
      bytes.size() == header_bytes + facet_count(bytes) * facet_bytes) {
    return true;
  }
  if (bytes.compare(0, 5, "solid") != 0) return bytes.size() >= header_bytes;
  return bytes.find('\0') != std::string::npos && bytes.size() >= header_bytes;
}

}  // namespace

TriangleMesh parse_stl(const std::string& bytes, double weld, const std::filesystem::path& file) {
  TriangleMesh mesh =
      is_binary(bytes) ? parse_binary(bytes, weld, file) : parse_ascii(bytes, weld, file);
  if (mesh.triangles.empty()) throw InputError({{file, 0, "", "holds no facets"}});
  return mesh;
}

TriangleMesh read_stl(const std::filesystem::path& file, double weld) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    throw InputError({{file, 0, "", "no such file, or it cannot be read"}});
  return parse_stl({std::istreambuf_iterator<char>(in), {}}, weld, file);
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

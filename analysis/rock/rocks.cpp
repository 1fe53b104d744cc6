#include "analysis/rock/rocks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <unordered_map>

#include "analysis/io/line_reader.hpp"
#include "analysis/rock/frame_faults.hpp"

namespace dipper::analysis::rock {
namespace {

// Far beyond any rock: a larger number is damaged, or of the other byte order.
constexpr double kLargestRadius_m = 100, kLargestDensity_kg_m3 = 1e6;
constexpr double kFurthest_m = 1e6, kFastest_m_s = 1e5;
constexpr double kLargestNumber = 9007199254740992;  // 2^53: larger ids are not distinct

/// The columns of a frame from which rocks are made, with their indices in a chunk.
class Columns {
 public:
  explicit Columns(const io::DumpFrame& frame) : frame_(frame) {
    x_ = add("x");
    add("y");
    add("z");
    radius_ = add("radius");
    id_ = add("id");
    type_ = maybe("type");
    clump_ = maybe("id_multisphere");
    mass_ = maybe("mass");
    density_ = maybe("density");
    if (frame.has("vx") && frame.has("vy") && frame.has("vz")) {
      v_ = add("vx");
      add("vy");
      add("vz");
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  bool weighs() const { return mass_ >= 0 || density_ >= 0; }

  double radius(const io::ParticleChunk& c, std::size_t i) const {
    const double r = at(c, radius_, i, 0);
    if (!(r > 0 && r <= kLargestRadius_m)) refuse(c, i, "radius", r);
    return r;
  }
  std::int64_t id(const io::ParticleChunk& c, std::size_t i) const { return whole(c, i, id_, 0); }
  int type(const io::ParticleChunk& c, std::size_t i) const {
    const std::int64_t type = whole(c, i, type_, 1);
    if (type < 1 || type > std::numeric_limits<int>::max())
      refuse(c, i, "type", static_cast<double>(type));
    return static_cast<int>(type);
  }
  std::int64_t clump(const io::ParticleChunk& c, std::size_t i) const {
    return whole(c, i, clump_, -1);
  }
  double density(const io::ParticleChunk& c, std::size_t i) const {
    const double density = at(c, density_, i, 0);
    if (!(density >= 0 && density <= kLargestDensity_kg_m3)) refuse(c, i, "density", density);
    return density;
  }
  double mass(const io::ParticleChunk& c, std::size_t i, double volume) const {
    if (mass_ < 0) return density(c, i) * volume;
    const double mass = at(c, mass_, i, 0);
    if (!(mass >= 0 && mass <= kLargestDensity_kg_m3 * volume)) refuse(c, i, "mass", mass);
    return mass;
  }
  Eigen::Vector3d p(const io::ParticleChunk& c, std::size_t i) const {
    return vector(c, x_, i, "position", kFurthest_m);
  }
  Eigen::Vector3d v(const io::ParticleChunk& c, std::size_t i) const {
    return v_ >= 0 ? vector(c, v_, i, "velocity", kFastest_m_s) : Eigen::Vector3d::Zero();
  }

 private:
  int add(const std::string& name) {
    names_.push_back(name);
    return static_cast<int>(names_.size()) - 1;
  }
  int maybe(const std::string& name) { return frame_.has(name) ? add(name) : -1; }
  std::int64_t whole(const io::ParticleChunk& c, std::size_t i, int column,
                     double otherwise) const {
    const double v = at(c, column, i, otherwise);
    if (!(std::abs(v) <= kLargestNumber))
      refuse(c, i, names_[static_cast<std::size_t>(column)].c_str(), v);
    if (v != std::floor(v))
      throw io::input_error(frame_.file, frame_.line,
                            fmt::format("{} {:.6g} is not a whole number",
                                        names_[static_cast<std::size_t>(column)], v));
    return static_cast<std::int64_t>(v);
  }
  static double at(const io::ParticleChunk& c, int column, std::size_t i, double otherwise) {
    return column >= 0 ? c.columns[static_cast<std::size_t>(column)][i] : otherwise;
  }
  Eigen::Vector3d vector(const io::ParticleChunk& c, int column, std::size_t i, const char* what,
                         double most) const {
    const auto k = static_cast<std::size_t>(column);
    const Eigen::Vector3d v(c.columns[k][i], c.columns[k + 1][i], c.columns[k + 2][i]);
    const double size = v.cwiseAbs().maxCoeff();
    if (!(size <= most)) refuse(c, i, what, size);
    return v;
  }
  [[noreturn]] void refuse(const io::ParticleChunk& c, std::size_t i, const char* what,
                           double value) const {
    throw io::input_error(
        frame_.file, frame_.line,
        fmt::format("particle {:.17g} has {} {:.6g}: impossible for a rock; is the "
                    "dump damaged, or of the other byte order?",
                    at(c, id_, i, 0), what, value));
  }

  const io::DumpFrame& frame_;
  std::vector<std::string> names_;
  int x_ = -1, radius_ = -1, id_ = -1, type_ = -1, clump_ = -1, mass_ = -1, density_ = -1, v_ = -1;
};

struct Clump {
  int type = 1;
  double volume_m3 = 0, mass_kg = 0, density_kg_m3 = 0;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();  // weighted by volume
};

}  // namespace

ClumpMasses read_clump_masses(const std::filesystem::path& rocks_in) {
  ClumpMasses masses;
  io::LineReader in(rocks_in);
  std::string_view text;
  int type = 0;  // of the multisphere template being read
  while (in.next(text)) {
    std::string_view last;
    for (auto word = io::take_word(text); !word.empty(); last = word, word = io::take_word(text)) {
      if (word == "fix" || word == "particletemplate/sphere") type = 0;
      std::int64_t n = 0;
      if (last == "atom_type" && parse_number(word, n)) type = static_cast<int>(n);
      double kg = 0;
      if (last != "mass" || type == 0) continue;
      if (!parse_number(word, kg) || kg <= 0)
        throw io::input_error(rocks_in, in.line(),
                              fmt::format("mass '{}' is not a mass in kg", word));
      masses[type] = kg;
    }
  }
  return masses;
}

std::string mass_source(const io::DumpFrame& frame, const ClumpMasses& clumps) {
  if (!clumps.empty()) return "deck";
  return frame.has("mass") ? "mass column" : "spheres";
}

void for_each_fragment(const io::DumpFrame& frame, const ClumpMasses& masses,
                       const std::function<void(const Fragment&)>& visit) {
  const Columns columns(frame);
  if (!columns.weighs())
    throw io::input_error(
        frame.file, frame.line,
        "particles without mass or density; add one of them to the dump's columns");
  std::unordered_map<std::int64_t, Clump> clumps;
  FrameFaults faults(frame);
  io::DumpReader::read(frame, columns.names(), [&](const io::ParticleChunk& chunk) {
    for (std::size_t i = 0; i < chunk.rows; ++i) {
      const double r = columns.radius(chunk, i);
      const double volume = 4.0 / 3.0 * M_PI * r * r * r;
      const double mass = columns.mass(chunk, i, volume);
      faults.see(columns.id(chunk, i), r, columns.p(chunk, i));
      if (const std::int64_t id = columns.clump(chunk, i); id >= 0) {
        Clump& c = clumps[id];
        c.type = columns.type(chunk, i);
        c.density_kg_m3 = columns.density(chunk, i);
        c.volume_m3 += volume;
        c.mass_kg += mass;
        c.p += volume * columns.p(chunk, i);
        c.v += volume * columns.v(chunk, i);
        continue;
      }
      Fragment rock;
      rock.key = columns.id(chunk, i);
      rock.type = columns.type(chunk, i);
      rock.mass_kg = mass;
      rock.density_kg_m3 = columns.density(chunk, i);
      rock.p_W = columns.p(chunk, i);
      rock.v_W = columns.v(chunk, i);
      visit(rock);
    }
  });
  faults.judge();
  for (const auto& [id, c] : clumps) {
    Fragment rock;
    rock.key = -1 - id;
    rock.type = c.type;
    rock.mass_kg = c.mass_kg;
    rock.density_kg_m3 = c.density_kg_m3;
    rock.p_W = c.p / c.volume_m3;
    rock.v_W = c.v / c.volume_m3;
    if (!masses.empty()) {
      const auto at = masses.find(c.type);
      if (at == masses.end())
        throw io::input_error(
            frame.file, frame.line,
            fmt::format("rock {} is of type {}, which the deck has no clump of: a "
                        "dump of another run?",
                        id, c.type));
      rock.mass_kg = at->second;
    }
    visit(rock);
  }
}

}  // namespace dipper::analysis::rock

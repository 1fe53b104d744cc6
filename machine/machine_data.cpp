#include "machine/machine_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/yaml_section.hpp"

namespace dipper::machine {
namespace {

constexpr Range kPositive{0, 1e300, true};
constexpr Range kNotNegative{0};

/// A section whose every entry is {value, unit, source}.
class Entries {
 public:
  explicit Entries(YamlSection section) : section_(std::move(section)) {}
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;
  ~Entries() { section_.refuse_others(); }

  Entries group(const std::string& key) { return Entries(section_.section(key, "its section")); }

  bool has(const std::string& key) { return section_.find(key) != nullptr; }

  /// Whether the source of an entry that is there begins with "assumed".
  bool is_assumed(const std::string& key) {
    YamlSection e = section_.section(key, "{value, unit, source}");
    const YamlTree* source = e.find("source");
    return source != nullptr && source->scalar.rfind("assumed", 0) == 0;
  }

  std::string text(const std::string& key) { return entry(key, "-").text("value", "a text"); }

  std::string choice(const std::string& key, const std::vector<std::string>& words) {
    YamlSection e = entry(key, "-");
    const std::string allowed = fmt::format("{}", fmt::join(words, " or "));
    const std::string word = e.text("value", allowed);
    const YamlTree* given = e.find("value");
    if (given != nullptr && std::find(words.begin(), words.end(), word) == words.end())
      e.fault(*given, "value", fmt::format("is '{}'; it must be {}", word, allowed));
    return word;
  }

  /// Returns angles given in deg in rad.
  double number(const std::string& key, const std::string& unit, const Range& range = {}) {
    const std::string what = unit == "-" ? "a number" : "a number in " + unit;
    return scale(unit) * entry(key, unit).number("value", what, range);
  }

  Vector3d vector(const std::string& key, const std::string& unit) {
    return scale(unit) * entry(key, unit).vector("value", "three numbers in " + unit);
  }

 private:
  YamlSection entry(const std::string& key, const std::string& unit) {
    YamlSection e = section_.section(key, "{value, unit, source}");
    const YamlTree* given = e.need("unit", "the unit, " + unit);
    if (given != nullptr && given->scalar != unit)
      e.fault(*given, "unit", fmt::format("is {}; it must be '{}'", shown(*given), unit));
    const YamlTree* source = e.need("source", "where the value comes from");
    if (source != nullptr && source->scalar.empty())
      e.fault(*source, "source", "is empty; write where the value comes from");
    e.find("value");
    e.refuse_others();
    return e;
  }

  static double scale(const std::string& unit) {
    return unit == "deg" || unit == "deg/s" ? kRadPerDeg : 1.0;
  }

  YamlSection section_;
};

constexpr double kMostElements = 200;

/// The keys that files may lack.
void read_rope_model(Entries& g, MachineData::Rope& rope) {
  if (g.has("model")) rope.segmented = g.choice("model", {"elastic", "segmented"}) == "segmented";
  if (g.has("elements"))
    rope.elements = static_cast<int>(g.number("elements", "-", {2, kMostElements}));
  if (g.has("mass_per_length") || rope.segmented)
    rope.mass_per_length = g.number("mass_per_length", "kg/m", kPositive);
}

MachineData read(const YamlTree& file, std::vector<Finding>& findings) {
  MachineData m{};
  Entries root(YamlSection(file, "", findings));
  m.machine = root.text("machine");
  {
    auto g = root.group("house");
    m.house = {g.number("mass", "kg", kPositive), g.number("swing_inertia", "kg m^2", kPositive)};
  }
  {
    auto g = root.group("boom");
    m.boom = {g.vector("point", "m"), g.number("sheave_radius", "m", kPositive),
              g.number("sheave_mass", "kg", kPositive),
              g.number("sheave_inertia", "kg m^2", kPositive)};
  }
  {
    auto g = root.group("saddle");
    m.saddle = {g.vector("position", "m"), g.number("mass", "kg", kPositive),
                g.number("inertia", "kg m^2", kPositive),
                g.number("damping", "N m s/rad", kNotNegative)};
  }
  {
    auto g = root.group("handle");
    m.handle = {g.number("reach_at_zero_crowd", "m", kPositive), g.number("mass", "kg", kPositive),
                g.number("mass_center", "m"), g.vector("inertia", "kg m^2")};
  }
  {
    auto g = root.group("dipper");
    m.dipper = {g.number("struck_volume", "m^3", kPositive),
                g.vector("inside", "m"),
                g.number("tooth_reach", "m", kPositive),
                g.number("base_rake", "deg", kPositive),
                g.vector("handle_end", "m"),
                g.vector("bail", "m"),
                g.number("mass", "kg", kPositive),
                g.vector("mass_center", "m"),
                g.vector("inertia", "kg m^2"),
                g.has("rated_load") ? g.number("rated_load", "kg", kPositive) : 0,
                g.has("rated_load") && g.is_assumed("rated_load")};
  }
  {
    auto g = root.group("door");
    m.door = {g.vector("hinge", "m"), g.number("mass", "kg", kPositive),
              g.vector("mass_center", "m"), g.vector("inertia", "kg m^2")};
  }
  {
    auto g = root.group("rope");
    m.rope = {g.number("axial_stiffness", "N", kPositive),
              g.number("elastic_fraction", "-", {0, 1, true}),
              g.number("damping", "N s/m", kNotNegative), g.vector("drum", "m"),
              g.number("length_at_zero_hoist", "m", kPositive)};
    read_rope_model(g, m.rope);
  }
  {
    auto g = root.group("drives");
    m.drives.hoist = {g.number("hoist_stall", "N", kPositive),
                      g.number("hoist_power", "W", kPositive)};
    m.drives.hoist_inertia = g.number("hoist_inertia", "kg", kPositive);
    m.drives.crowd = {g.number("crowd_stall", "N", kPositive),
                      g.number("crowd_power", "W", kPositive)};
    m.drives.swing = {g.number("swing_stall", "N m", kPositive),
                      g.number("swing_power", "W", kPositive)};
  }
  {
    auto g = root.group("limits");
    m.limits = {g.number("hoist_min", "m"),
                g.number("hoist_max", "m"),
                g.number("crowd_min", "m"),
                g.number("crowd_max", "m"),
                g.number("hoist_speed", "m/s", kPositive),
                g.number("crowd_speed", "m/s", kPositive),
                g.number("swing_speed", "deg/s", kPositive),
                g.number("door_min", "deg"),
                g.number("door_max", "deg"),
                g.number("saddle_min", "deg"),
                g.number("saddle_max", "deg")};
  }
  return m;
}

}  // namespace

MachineData load_machine(const std::filesystem::path& file) {
  std::vector<Finding> findings;
  const YamlTree tree = read_yaml(file, findings);
  MachineData machine{};
  if (findings.empty()) machine = read(tree, findings);
  sort_by_line(findings);
  if (!findings.empty()) throw InputError(std::move(findings));
  return machine;
}

}  // namespace dipper::machine

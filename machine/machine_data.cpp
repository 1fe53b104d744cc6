#include "machine/machine_data.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <vector>

#include "common/input_error.hpp"

namespace dipper::machine {
namespace {

/// Reads entries of one file and collects what is wrong with them.
class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  void fault(const YAML::Mark& mark, const std::string& message) {
    faults_.push_back(fmt::format("{}:{}:{}: {}", name_, mark.line + 1, mark.column + 1, message));
  }
  std::vector<std::string>& faults() { return faults_; }

  /// A mapping whose keys are all known to the caller, who asks for them by name.
  class Group {
   public:
    Group(Reader& reader, const YAML::Node& node, std::string path)
        : reader_(reader), node_(node), path_(std::move(path)) {
      if (node_.IsMap()) return;
      if (node_) reader_.fault(node_.Mark(), path_ + " must be a mapping");
      node_ = YAML::Node(YAML::NodeType::Map);
      broken_ = true;  // said once: its entries are not reported one by one
    }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

    ~Group() {
      for (const auto& item : node_) {
        const auto key = item.first.as<std::string>();
        if (known_.count(key) == 0) {
          reader_.fault(item.first.Mark(), fmt::format("unknown key {}{}", prefix(), key));
        }
      }
    }

    Group group(const std::string& key) { return {reader_, find(key), prefix() + key}; }

    std::string text(const std::string& key) {
      const YAML::Node value = entry(key, "-");
      return value ? value.as<std::string>() : std::string();
    }

    /// Angles in deg come back in rad.
    double number(const std::string& key, const std::string& unit) {
      const YAML::Node value = entry(key, unit);
      return value ? scale(unit) * scalar(value, key) : 0.0;
    }

    double positive(const std::string& key, const std::string& unit) {
      const double value = number(key, unit);
      const YAML::Node node = node_[key];
      if (node && !(value > 0)) {
        reader_.fault(node.Mark(), fmt::format("{}{} must be positive", prefix(), key));
      }
      return value;
    }

    Vector3d vector(const std::string& key, const std::string& unit) {
      const YAML::Node value = entry(key, unit);
      if (!value) return Vector3d::Zero();
      if (!value.IsSequence() || value.size() != 3) {
        reader_.fault(value.Mark(), fmt::format("{}{} must be three numbers", prefix(), key));
        return Vector3d::Zero();
      }
      return scale(unit) *
             Vector3d(scalar(value[0], key), scalar(value[1], key), scalar(value[2], key));
    }

   private:
    std::string prefix() const { return path_.empty() ? "" : path_ + "."; }

    YAML::Node find(const std::string& key) {
      known_.insert(key);
      const YAML::Node child = std::as_const(node_)[key];
      if (!child && !broken_) {
        reader_.fault(node_.Mark(), fmt::format("missing {}{}", prefix(), key));
      }
      return child ? child : YAML::Node(YAML::NodeType::Undefined);
    }

    /// The value of an {value, unit, source} entry, or an undefined node after a fault.
    YAML::Node entry(const std::string& key, const std::string& unit) {
      const YAML::Node none(YAML::NodeType::Undefined);
      const YAML::Node node = find(key);
      if (!node) return none;
      const std::string name = prefix() + key;
      if (!node.IsMap()) {
        reader_.fault(node.Mark(), name + " must be {value, unit, source}");
        return none;
      }
      for (const auto& item : node) {
        const auto part = item.first.as<std::string>();
        if (part != "value" && part != "unit" && part != "source") {
          reader_.fault(item.first.Mark(), fmt::format("unknown key {}.{}", name, part));
        }
      }
      for (const char* part : {"value", "unit", "source"}) {
        if (!node[part]) {
          reader_.fault(node.Mark(), fmt::format("{} lacks {}", name, part));
          return none;
        }
      }
      if (node["unit"].as<std::string>("") != unit) {
        reader_.fault(node["unit"].Mark(),
                      fmt::format("{} has unit \"{}\"; it must be \"{}\"", name,
                                  node["unit"].as<std::string>(""), unit));
      }
      if (node["source"].as<std::string>("").empty()) {
        reader_.fault(node["source"].Mark(), name + " needs a source");
      }
      return node["value"];
    }

    double scalar(const YAML::Node& node, const std::string& key) {
      const double value = node.as<double>(std::nan(""));
      if (!std::isfinite(value)) {
        reader_.fault(node.Mark(), fmt::format("{}{} must be a finite number", prefix(), key));
        return 0;
      }
      return value;
    }

    static double scale(const std::string& unit) {
      return unit == "deg" || unit == "deg/s" ? 0.017453292519943295 : 1.0;
    }

    Reader& reader_;
    YAML::Node node_;
    std::string path_;
    std::set<std::string> known_;
    bool broken_ = false;
  };

 private:
  std::string name_;
  std::vector<std::string> faults_;
};

MachineData read(Reader& reader, const YAML::Node& file) {
  MachineData m{};
  Reader::Group root(reader, file, "");
  m.machine = root.text("machine");
  {
    auto g = root.group("house");
    m.house = {g.positive("mass", "kg"), g.positive("swing_inertia", "kg m^2")};
  }
  {
    auto g = root.group("boom");
    m.boom = {g.vector("point", "m"), g.positive("sheave_radius", "m"),
              g.positive("sheave_mass", "kg"), g.positive("sheave_inertia", "kg m^2")};
  }
  {
    auto g = root.group("saddle");
    m.saddle = {g.vector("position", "m"), g.positive("mass", "kg"),
                g.positive("inertia", "kg m^2"), g.number("damping", "N m s/rad")};
  }
  {
    auto g = root.group("handle");
    m.handle = {g.positive("reach_at_zero_crowd", "m"), g.positive("mass", "kg"),
                g.number("mass_center", "m"), g.vector("inertia", "kg m^2")};
  }
  {
    auto g = root.group("dipper");
    m.dipper = {g.positive("struck_volume", "m^3"), g.vector("inside", "m"),
                g.positive("tooth_reach", "m"),     g.positive("base_rake", "deg"),
                g.vector("handle_end", "m"),        g.vector("bail", "m"),
                g.positive("mass", "kg"),           g.vector("mass_center", "m"),
                g.vector("inertia", "kg m^2")};
  }
  {
    auto g = root.group("door");
    m.door = {g.vector("hinge", "m"), g.positive("mass", "kg"), g.vector("mass_center", "m"),
              g.vector("inertia", "kg m^2")};
  }
  {
    auto g = root.group("rope");
    m.rope = {g.positive("axial_stiffness", "N"), g.positive("elastic_fraction", "-"),
              g.number("damping", "N s/m"), g.vector("drum", "m"),
              g.positive("length_at_zero_hoist", "m")};
  }
  {
    auto g = root.group("limits");
    m.limits = {g.number("hoist_min", "m"),         g.number("hoist_max", "m"),
                g.number("crowd_min", "m"),         g.number("crowd_max", "m"),
                g.positive("hoist_speed", "m/s"),   g.positive("crowd_speed", "m/s"),
                g.positive("swing_speed", "deg/s"), g.number("door_min", "deg"),
                g.number("door_max", "deg"),        g.number("saddle_min", "deg"),
                g.number("saddle_max", "deg")};
  }
  return m;
}

}  // namespace

MachineData load_machine(const std::filesystem::path& file) {
  Reader reader(file.string());
  MachineData machine{};
  try {
    machine = read(reader, YAML::LoadFile(file.string()));
  } catch (const YAML::BadFile&) {
    throw InputError({fmt::format("{}: cannot be opened", file.string())});
  } catch (const YAML::Exception& e) {
    reader.fault(e.mark, e.msg);
  }
  if (!reader.faults().empty()) throw InputError(std::move(reader.faults()));
  return machine;
}

}  // namespace dipper::machine

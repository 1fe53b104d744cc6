#include "coupler/case/mesh_facts.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "coupler/case/schema.hpp"
#include "coupler/case/yaml_tree.hpp"
#include "coupler/case/yaml_value.hpp"

namespace dipper::cases {
namespace fs = std::filesystem;
namespace {

/// The file beside one mesh.
class Reader {
 public:
  /// `mesh_key` is the case's key that names the mesh, `keys` what the file must hold.
  Reader(const Case& c, const std::string& mesh_key, fs::path mesh, const std::string& keys,
         std::vector<Finding>& findings)
      : file_(mesh.replace_extension(".yaml")), findings_(findings) {
    std::ifstream in(file_, std::ios::binary);
    if (!fs::is_regular_file(file_) || !in) {
      findings.push_back(finding_at(
          c, mesh_key,
          fmt::format("cannot read {}; write beside the mesh a file of that name with {}",
                      file_.string(), keys)));
      return;
    }
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t before = findings.size();
    root_ = parse_yaml(text, file_, "", findings);
    if (root_.origin.file.empty()) root_.origin = {file_, 1};
    if (findings.size() > before) return;  // what could be read of it may lack any key
    readable_ = root_.kind == YamlTree::Kind::map;
    if (!readable_) fault(root_, "", fmt::format("is {}; write {}", shown(root_), keys));
  }

  double number(const std::string& key, const Range& range, const std::string& what) {
    const YamlTree* node = need(root_, key, key, what);
    if (node == nullptr) return 0;
    const auto value = parse_number<double>(*node);
    if (!value) {
      fault(*node, key, fmt::format("is {}; write {}", shown(*node), what));
    } else if (!range.holds(*value)) {
      fault(*node, key,
            fmt::format("{} is out of range; allowed is {}", node->scalar, range.text()));
    }
    return value.value_or(0);
  }

  mesh::BoundingBox box(const std::string& key, const std::string& what) {
    YamlTree* node = need(root_, key, key, "{min_m, max_m}, " + what);
    if (node == nullptr) return {};
    if (node->kind != YamlTree::Kind::map) {
      fault(*node, key, fmt::format("is {}; write {{min_m, max_m}}, {}", shown(*node), what));
      return {};
    }
    const std::size_t before = findings_.size();
    const mesh::BoundingBox b{corner(*node, key, "min_m"), corner(*node, key, "max_m")};
    for (int i = 0; i < 3 && findings_.size() == before; ++i) {
      if (b.min[i] < b.max[i]) continue;
      fault(*node, key + ".min_m",
            fmt::format("{} = {} is not below max_m's {}", "xyz"[i], b.min[i], b.max[i]));
    }
    return b;
  }

 private:
  void fault(const YamlTree& at, const std::string& key, const std::string& message) {
    findings_.push_back({file_, at.origin.line, key, message});
  }

  /// The child `name` of a section, known to messages as `key`; or nullptr, after a fault unless
  /// the whole file has been told to be unreadable.
  YamlTree* need(YamlTree& section, const std::string& name, const std::string& key,
                 const std::string& what) {
    if (!readable_) return nullptr;
    YamlTree* node = section.find(name);
    if (node == nullptr) fault(section, key, "missing key; write " + what);
    return node;
  }

  Eigen::Vector3d corner(YamlTree& section, const std::string& box, const std::string& name) {
    const std::string what = "three numbers in m", key = box + "." + name;
    const YamlTree* node = need(section, name, key, what);
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    if (node == nullptr) return at;
    const bool three = node->kind == YamlTree::Kind::list && node->children.size() == 3;
    if (!three) fault(*node, key, fmt::format("is {}; write {}", shown(*node), what));
    for (int i = 0; three && i < 3; ++i) {
      const YamlTree& element = node->children[static_cast<std::size_t>(i)].second;
      const auto value = parse_number<double>(element);
      if (!value) {
        fault(element, fmt::format("{}.{}", key, i),
              fmt::format("is {}; write a number in m", shown(element)));
      }
      at[i] = value.value_or(0);
    }
    return at;
  }

  fs::path file_;
  std::vector<Finding>& findings_;
  YamlTree root_;
  bool readable_ = false;
};

}  // namespace

DipperFacts read_dipper_facts(const Case& c, std::vector<Finding>& findings) {
  Reader file(c, "bodies.dipper", c.bodies.at("dipper"),
              "struck_volume_m3, cavity: {min_m, max_m}, heap_height_m", findings);
  DipperFacts facts;
  facts.struck_volume_m3 = file.number("struck_volume_m3", {0, 1e300, true},
                                       "the volume in m3 up to the plane through lip and roof");
  facts.cavity = file.box("cavity", "corners of the dipper's inside in its frame B");
  facts.load = facts.cavity;
  facts.load.max.x() +=
      file.number("heap_height_m", {0}, "how far in m rock beyond the lip counts as load");
  return facts;
}

mesh::BoundingBox read_truck_bed(const Case& c, std::vector<Finding>& findings) {
  Reader file(c, "truck.mesh", c.truck.mesh, "bed: {min_m, max_m}", findings);
  return file.box("bed", "corners of the box in the mesh's frame whose rock is the truck's load");
}

}  // namespace dipper::cases

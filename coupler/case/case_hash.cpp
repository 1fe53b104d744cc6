#include "coupler/case/case_hash.hpp"

#include <algorithm>
#include <set>

#include "common/sha256.hpp"
#include "coupler/case/case_text.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/case/mesh_facts.hpp"

namespace fs = std::filesystem;

namespace dipper::cases {
namespace {

std::set<std::string> used_shapes(const Case& c) {
  std::set<std::string> shapes;
  for (const SizeClass& size : c.rock.classes) {
    shapes.insert(size.shapes.begin(), size.shapes.end());
  }
  shapes.erase("sphere");
  return shapes;
}

/// The YAML files beside the meshes, which say where in them rock is weighed.
std::set<fs::path> fact_files(const Case& c) {
  std::set<fs::path> files;
  const auto beside = [](fs::path mesh) { return mesh.replace_extension(".yaml"); };
  for (const std::string& name : weighed_bodies(c)) files.insert(beside(c.bodies.at(name)));
  if (has_truck(c)) files.insert(beside(c.truck.mesh));
  return files;
}

}  // namespace

std::vector<fs::path> shape_files(const fs::path& folder, const std::string& shape) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.is_regular_file() && entry.path().stem() == shape) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> referenced_files(const Case& c) {
  std::set<fs::path> files = fact_files(c);
  for (const fs::path& file : {c.machine.model, c.machine.motion, c.machine.plan, c.machine.poses,
                               c.truck.mesh, c.pile.profile, c.rock.sieve.file})
    if (!file.empty()) files.insert(file);
  for (const auto& body : c.bodies) files.insert(body.second);
  for (const std::string& shape : used_shapes(c)) {
    for (const fs::path& file : shape_files(c.rock.shape_folder, shape)) files.insert(file);
  }
  return {files.begin(), files.end()};
}

std::string case_hash(const Case& c) {
  std::string text = case_text(c, [](const fs::path& path) {
    return fs::is_directory(path) ? std::string("folder") : sha256_file(path);
  });
  // By their text, not their names: a mesh with another name is the same.
  std::set<std::string> facts;
  for (const fs::path& file : fact_files(c)) facts.insert(sha256_file(file));
  for (const std::string& hash : facts) text += hash + "\n";
  for (const std::string& shape : used_shapes(c)) {
    for (const fs::path& file : shape_files(c.rock.shape_folder, shape)) {
      text += file.filename().string() + " " + sha256_file(file) + "\n";
    }
  }
  return sha256(text);
}

}  // namespace dipper::cases

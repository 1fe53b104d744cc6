#include "coupler/deck/shape_library.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/mesh/stl.hpp"
#include "common/sha256.hpp"
#include "common/text_file.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

/// Part of the cache key: increase it when the same mesh gives other spheres.
constexpr int kFitVersion = 2;

constexpr const char* kShapeFile = "shape.yaml";

fs::path yaml_of(const fs::path& folder, const std::string& name) {
  return folder / (name + ".yaml");
}

}  // namespace

std::set<std::string> shape_names(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() == ".yaml" || mesh::is_stl(entry.path()))
      names.insert(entry.path().stem().string());
  }
  return names;
}

fs::path shape_mesh(const fs::path& folder, const std::string& name) {
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().stem() == name && mesh::is_stl(entry.path())) return entry.path();
  return folder / (name + ".stl");
}

bool is_made_from_mesh(const fs::path& folder, const std::string& name) {
  const fs::path stl = shape_mesh(folder, name), yaml = yaml_of(folder, name);
  if (!fs::exists(stl)) return false;
  return !fs::exists(yaml) || read_rock_shape(yaml).mesh_sha256 != sha256_file(stl);
}

RockShape find_rock_shape(const fs::path& folder, const std::string& name) {
  if (!is_made_from_mesh(folder, name)) return read_rock_shape(yaml_of(folder, name));
  const fs::path stl = shape_mesh(folder, name);
  const fs::path entry =
      cache_folder() / "shapes" / fmt::format("{}-{}", sha256_file(stl), kFitVersion);
  const auto fit = [&](const fs::path& part) {
    write_text(part / kShapeFile, to_yaml(fit_rock_shape(stl)));
  };
  make_once(entry, fit, [] {});
  // Read back also when it was just made: with the file's digits, the first run equals the second.
  RockShape shape = read_rock_shape(entry / kShapeFile);
  shape.name = name;
  return shape;
}

RockShape fit_rock_shape(const fs::path& stl, const std::vector<ShapeResolution>& resolutions) {
  const mesh::TriangleMesh mesh = mesh::read_stl(stl);  // its errors name the file
  try {
    RockShape shape = make_rock_shape(stl.stem().string(), mesh, resolutions);
    shape.mesh_sha256 = sha256_file(stl);
    return shape;
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(stl.string() + ": " + e.what());
  }
}

}  // namespace dipper::deck

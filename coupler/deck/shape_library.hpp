// Rock shapes by name: the files of a case's shape folder.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "coupler/deck/rock_shape.hpp"

namespace dipper::deck {

/// Every NAME with a NAME.yaml or a NAME.stl (or .STL) in the folder.
std::set<std::string> shape_names(const std::filesystem::path& folder);

/// The mesh defines a shape. NAME.yaml is used when it was made from the NAME.stl beside it, or
/// when there is no NAME.stl; else the mesh is fitted, in seconds, and the result is kept in the
/// cache (cache_folder()/shapes) under the hash of the mesh. Safe for concurrent processes. Throws
/// std::runtime_error naming the file, and its first fault.
RockShape find_rock_shape(const std::filesystem::path& folder, const std::string& name);

/// NAME.stl of the folder, in any case of its extension; this spelling when there is none.
std::filesystem::path shape_mesh(const std::filesystem::path& folder, const std::string& name);

/// True when find_rock_shape uses NAME.stl rather than NAME.yaml.
bool is_made_from_mesh(const std::filesystem::path& folder, const std::string& name);

/// make_rock_shape of an STL file, named after it. Throws std::runtime_error naming the file.
RockShape fit_rock_shape(const std::filesystem::path& stl,
                         const std::vector<ShapeResolution>& resolutions = {
                             kShapeResolutions.begin(), kShapeResolutions.end()});

}  // namespace dipper::deck

// Formats of meshes that are not STL, by how a file begins.
#pragma once

#include <string>
#include <string_view>

namespace dipper::mesh {

/// What other_format says of the text that Git keeps in a large file's place.
inline constexpr const char* git_pointer = "Git LFS";

/// The format of a mesh or archive that a file's bytes begin as, "OBJ" or "PLY" for two; empty: it
/// may be an STL, or no mesh.
std::string other_format(std::string_view bytes);

}  // namespace dipper::mesh

// Reads STL files, ascii and binary, and writes ascii ones.
#pragma once

#include <filesystem>
#include <string>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// Vertices closer than `weld` [m] in every coordinate become one. Normals are not read: the
/// order of a facet's vertices says where outside is. Throws InputError: no such file, a broken
/// record (with its line or byte), a coordinate that is no finite number, no facets.
TriangleMesh read_stl(const std::filesystem::path& file, double weld = 1e-6);

/// The same from a file's bytes; errors name `file`.
TriangleMesh parse_stl(const std::string& bytes, double weld = 1e-6,
                       const std::filesystem::path& file = {});

/// Whether a file's name ends in .stl, in capitals or not.
bool is_stl(const std::filesystem::path& file);

/// An ascii file, seven digits a coordinate.
std::string to_stl(const std::string& name, const TriangleMesh& mesh);

}  // namespace dipper::mesh

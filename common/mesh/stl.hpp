// Reads STL files, ascii and binary, and writes ascii ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// Vertices closer than weld_distance in every coordinate become one. Normals are not read: the
/// order of a facet's vertices defines its outside. Keywords may be in capitals; a byte-order
/// mark and blank lines may precede them, and a Ctrl-Z end them. Throws InputError: no such file,
/// another format, a broken record (with its line or byte), a coordinate that is not a finite
/// number, no facets; a mesh far from its origin whose coordinates are rounded to more than a
/// thousandth of its size.
TriangleMesh read_stl(const std::filesystem::path& file);

/// The same from a file's bytes; errors name `file`.
TriangleMesh parse_stl(const std::string& bytes, const std::filesystem::path& file = {});

/// A micrometre, and less for a mesh of less than a metre: a millionth of its diagonal.
double weld_distance(double diagonal_m);

/// Whether a file's name ends in .stl, in capitals or not.
bool is_stl(const std::filesystem::path& file);

/// Whether LIGGGHTS reads the file as it is: binary that does not begin with "solid", by which
/// LIGGGHTS knows text, or ascii that begins with "solid" in small letters, has its other keywords
/// in small letters and none of them in its name. Throws InputError: no such file.
bool is_plain_stl(const std::filesystem::path& file);

/// An ascii file, seven digits a coordinate.
std::string to_stl(const std::string& name, const TriangleMesh& mesh);

}  // namespace dipper::mesh

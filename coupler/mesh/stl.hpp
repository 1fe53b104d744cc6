// Reads STL files, ascii and binary.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// An STL file that cannot be read. what() is the message alone.
struct StlError : std::runtime_error {
  StlError(const std::string& message, int at_line, long long at_byte)
      : std::runtime_error(message), line(at_line), byte(at_byte) {}
  int line;        ///< 1-based, of an ascii file; 0: none
  long long byte;  ///< offset into a binary file; -1: none
};

/// Vertices closer than `weld` [m] in every coordinate become one. Normals are not read: the
/// order of a facet's vertices says where outside is. Throws StlError: no such file, a broken
/// record (with its line or byte), a coordinate that is no finite number, no facets.
TriangleMesh read_stl(const std::filesystem::path& file, double weld = 1e-6);

/// The same from a file's bytes.
TriangleMesh parse_stl(const std::string& bytes, double weld = 1e-6);

}  // namespace dipper::mesh

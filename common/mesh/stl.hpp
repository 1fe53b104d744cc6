// Reads STL files, ascii and binary, and writes ascii ones.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// An STL file that cannot be read. what() is the message, after file and line where it has them.
struct StlError : std::runtime_error {
  StlError(const std::string& message_alone, int at_line, long long at_byte,
           const std::string& file = "")
      : std::runtime_error(where(file, at_line) + message_alone),
        message(message_alone),
        line(at_line),
        byte(at_byte) {}
  std::string message;  ///< without the file
  int line;             ///< 1-based, of an ascii file; 0: none
  long long byte;       ///< offset into a binary file; -1: none

 private:
  static std::string where(const std::string& file, int line) {
    if (file.empty()) return "";
    return file + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
  }
};

/// Vertices closer than `weld` [m] in every coordinate become one. Normals are not read: the
/// order of a facet's vertices says where outside is. Throws StlError: no such file, a broken
/// record (with its line or byte), a coordinate that is no finite number, no facets.
TriangleMesh read_stl(const std::filesystem::path& file, double weld = 1e-6);

/// The same from a file's bytes.
TriangleMesh parse_stl(const std::string& bytes, double weld = 1e-6);

/// Whether a file's name ends in .stl, in capitals or not.
bool is_stl(const std::filesystem::path& file);

/// An ascii file, seven digits a coordinate.
std::string to_stl(const std::string& name, const TriangleMesh& mesh);

}  // namespace dipper::mesh

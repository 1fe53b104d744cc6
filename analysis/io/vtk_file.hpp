// VTK poly data on disk, XML (.vtp) and legacy (.vtk), as LIGGGHTS writes it: the location of each
// array.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/io/byte_reader.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::io {

/// An array of a VTK file.
struct VtkArray {
  enum class Type { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
  enum class Form { ascii, raw, base64 };
  std::string name;
  Type type = Type::f64;
  Form form = Form::ascii;
  bool swapped = false;          ///< binary data of the other byte order
  std::size_t header_bytes = 0;  ///< of base64: the length in front of the data
  std::size_t components = 1;
  std::size_t tuples = 0;
  std::int64_t offset = 0;  ///< of its data in the file
  long line = 0;
};

struct VtkFile {
  std::filesystem::path file;
  VtkArray points;
  std::vector<VtkArray> point_data, cell_data;
  std::optional<VtkArray> polygons;               ///< legacy up to 4.2: n, then n corners
  std::optional<VtkArray> connectivity, offsets;  ///< of the polygons, in the other formats
  std::size_t polygon_count = 0;

  const VtkArray* point_array(const std::string& name) const;
  const VtkArray* cell_array(const std::string& name) const;
};

/// Finds the arrays of a .vtp or .vtk file without keeping their values. Throws InputError naming
/// file and line: not such a file, data compressed or appended, cut short.
VtkFile index_vtk(const std::filesystem::path& file);

/// The values of one array, in order.
class VtkCursor {
 public:
  VtkCursor(const VtkFile& file, const VtkArray& array);
  /// The next n values; components of a tuple follow each other. Throws InputError.
  void read(double* out, std::size_t n);

 private:
  void decode(char* out, std::size_t n);
  VtkArray array_;
  ByteReader in_;
  std::string word_;
  std::vector<char> raw_;
  unsigned bits_ = 0;  // base64: not yet returned
  int bit_count_ = 0;
};

/// All of an array.
std::vector<double> read_array(const VtkFile& file, const VtkArray& array);

/// A wall dump: triangles in W. Cells with more than three corners become fans; `cell` is the index
/// of each triangle's cell, for the arrays of cell_data, which have one value for each cell.
struct WallDump {
  mesh::TriangleMesh mesh;  ///< loose triangles: corners are not shared
  std::vector<std::size_t> cell;
};
/// Throws InputError, also for polygons that do not agree with the points.
WallDump read_wall_dump(const VtkFile& file);

namespace vtk_detail {
std::size_t bytes(VtkArray::Type type);
/// Throws InputError, before memory is allocated, for an array that claims more values than the
/// rest of the file can hold.
void check_room(const std::filesystem::path& file, const VtkArray& array, std::int64_t file_size);
VtkFile index_xml(const std::filesystem::path& file);
VtkFile index_legacy(const std::filesystem::path& file);
}  // namespace vtk_detail

}  // namespace dipper::analysis::io

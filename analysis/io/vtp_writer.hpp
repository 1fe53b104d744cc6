// VTK poly data in XML, written array by array.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::io {

/// A .vtp file of one piece, binary (base64), with the arrays in the order in which they are added.
/// Memory does not grow with the arrays: their values are read while the file is written.
class VtpWriter {
 public:
  struct Array {
    std::string name;
    VtkArray::Type type;  ///< i32, i64 or f32
    std::size_t components, tuples;
  };
  using Put = std::function<void(double)>;
  /// Calls `put` with every value; components of a tuple are consecutive.
  using Fill = std::function<void(const Put& put)>;

  VtpWriter(std::size_t points, std::size_t verts, std::size_t polys)
      : points_(points), verts_(verts), polys_(polys) {}

  /// Arrays of one section ("PointData", "CellData", "Points", "Verts", "Polys") must be
  /// consecutive.
  void add(const std::string& section, Array array, Fill fill) {
    entries_.push_back({section, std::move(array), std::move(fill)});
  }

  /// Throws std::runtime_error when the file cannot be written, and whatever a fill throws.
  void write(const std::filesystem::path& file) const;

 private:
  struct Entry {
    std::string section;
    Array array;
    Fill fill;
  };
  std::string markup() const;

  std::size_t points_, verts_, polys_;
  std::vector<Entry> entries_;
};

}  // namespace dipper::analysis::io

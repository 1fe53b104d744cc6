// The legacy VTK format: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::io::vtk_detail {
namespace {

using Type = VtkArray::Type;

class LegacyIndex {
 public:
  explicit LegacyIndex(const std::filesystem::path& file)
      : in_(file), file_size_(static_cast<std::int64_t>(std::filesystem::file_size(file))) {
    out_.file = file;
  }

  VtkFile run() {
    if (in_.rest_of_line().rfind("# vtk DataFile", 0) != 0)
      fail("not a VTK file: its first line must be '# vtk DataFile Version ...'");
    in_.rest_of_line();  // title
    const std::string form = in_.rest_of_line();
    if (form != "ASCII" && form != "BINARY") fail("the third line must be ASCII or BINARY");
    ascii_ = form == "ASCII";
    std::string word;
    for (in_.word(word); !word.empty(); in_.word(word)) section(word);
    if (out_.points.line == 0) fail("there are no POINTS");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) {
    throw input_error(in_.file(), in_.line(), what);
  }

  std::string word(const char* what) {
    std::string w;
    in_.word(w);
    if (w.empty()) fail(fmt::format("the file ends where {} should be: it was cut short", what));
    return w;
  }

  std::size_t count(const char* what) {
    std::int64_t n = 0;
    const std::string w = word(what);
    if (!parse_number(w, n) || n < 0)
      fail(fmt::format("'{}' instead of {}", w.substr(0, 40), what));
    return static_cast<std::size_t>(n);
  }

  Type type(const std::string& name) {
    static const std::map<std::string, Type> names = {
        {"char", Type::i8},           {"unsigned_char", Type::u8},
        {"short", Type::i16},         {"unsigned_short", Type::u16},
        {"int", Type::i32},           {"unsigned_int", Type::u32},
        {"vtkIdType", Type::i32},     {"long", Type::i64},
        {"unsigned_long", Type::u64}, {"vtktypeint64", Type::i64},
        {"vtktypeuint64", Type::u64}, {"float", Type::f32},
        {"double", Type::f64}};
    const auto at = names.find(name);
    if (at == names.end()) fail(fmt::format("unknown type '{}'", name.substr(0, 40)));
    return at->second;
  }

  /// An array whose values begin here; moves past them.
  VtkArray values(std::string name, Type of, std::size_t components, std::size_t tuples) {
    VtkArray a;
    a.name = std::move(name);
    a.type = of;
    a.form = ascii_ ? VtkArray::Form::ascii : VtkArray::Form::raw;
    a.swapped = !ascii_;  // legacy binary is big-endian
    a.components = components;
    a.tuples = tuples;
    if (!ascii_) in_.rest_of_line();
    a.offset = in_.offset();
    a.line = in_.line();
    check_room(in_.file(), a, file_size_);
    const std::size_t n = components * tuples;
    std::string w;
    if (ascii_) {
      for (std::size_t i = 0; i < n; ++i) {
        in_.word(w);
        if (w.empty())
          fail(
              fmt::format("'{}' ends after {} of {} values: the file was cut short", a.name, i, n));
      }
    } else if (!in_.skip(static_cast<std::int64_t>(n * bytes(of)))) {
      fail(fmt::format("'{}' ends before its {} values: the file was cut short", a.name, n));
    }
    return a;
  }

  void cells(const std::string& kind) {
    const std::size_t n = count("the number of cells"), size = count("the size of the cells");
    const bool wanted = kind == "POLYGONS" || kind == "CELLS";
    if (wanted) out_.polygon_count = n;
    while (in_.peek() == ' ' || (ascii_ && in_.peek() == '\n')) in_.get();
    if (!ascii_) in_.rest_of_line();
    if (!in_.next_is("OFFSETS ")) {
      VtkArray a = cell_values(kind, Type::i32, size);
      if (wanted) out_.polygons = a;
      return;
    }
    word("OFFSETS");
    VtkArray offsets = values("OFFSETS", type(word("a type")), 1, n);
    if (word("CONNECTIVITY") != "CONNECTIVITY") fail("CONNECTIVITY must follow OFFSETS");
    VtkArray connectivity = values("CONNECTIVITY", type(word("a type")), 1, size);
    if (!wanted) return;
    if (n > 0) out_.polygon_count = n - 1;
    out_.offsets = offsets;
    out_.connectivity = connectivity;
  }

  /// As values(), after the end of the line.
  VtkArray cell_values(const std::string& name, Type of, std::size_t n) {
    if (ascii_) return values(name, of, 1, n);
    VtkArray a;
    a.name = name;
    a.type = of;
    a.form = VtkArray::Form::raw;
    a.swapped = true;
    a.tuples = n;
    a.offset = in_.offset();
    a.line = in_.line();
    check_room(in_.file(), a, file_size_);
    if (!in_.skip(static_cast<std::int64_t>(n * bytes(of))))
      fail(fmt::format("'{}' ends before its {} values: the file was cut short", name, n));
    return a;
  }

  void keep(VtkArray a) {
    if (data_ != nullptr) data_->push_back(std::move(a));
  }

  void section(const std::string& key) {
    if (key == "DATASET") {
      const std::string kind = word("the kind of data set");
      if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID")
        fail(fmt::format(
            "DATASET {} holds no particles or walls; expected POLYDATA or UNSTRUCTURED_GRID",
            kind.substr(0, 40)));
    } else if (key == "POINTS") {
      const std::size_t n = count("the number of points");
      out_.points = values("POINTS", type(word("a type")), 3, n);
    } else if (key == "VERTICES" || key == "LINES" || key == "POLYGONS" || key == "CELLS" ||
               key == "TRIANGLE_STRIPS") {
      cells(key);
    } else if (key == "CELL_TYPES") {
      const std::size_t n = count("the number of cells");
      values(key, Type::i32, 1, n);
    } else if (key == "POINT_DATA" || key == "CELL_DATA") {
      tuples_ = count("the number of values");
      data_ = key == "POINT_DATA" ? &out_.point_data : &out_.cell_data;
    } else if (key == "SCALARS") {
      const std::string name = word("a name"), of = word("a type");
      std::int64_t components = 1;
      const std::string rest = in_.rest_of_line();
      std::string_view words = rest;
      const std::string_view number = take_word(words);
      if (!number.empty() && (!parse_number(number, components) || components < 1))
        fail("not a number of components");
      word("LOOKUP_TABLE");
      word("the table's name");
      keep(values(name, type(of), static_cast<std::size_t>(components), tuples_));
    } else if (key == "VECTORS" || key == "NORMALS" || key == "TENSORS") {
      const std::string name = word("a name"), of = word("a type");
      keep(values(name, type(of), key == "TENSORS" ? 9 : 3, tuples_));
    } else if (key == "LOOKUP_TABLE") {
      word("a name");
      const std::size_t n = count("its size");
      values(key, ascii_ ? Type::f32 : Type::u8, 4, n);
    } else if (key == "FIELD") {
      word("a name");
      const std::size_t arrays = count("the number of arrays");
      for (std::size_t k = 0; k < arrays; ++k) {
        std::string name = word("a name");
        if (name == "METADATA") {
          skip_metadata();
          name = word("a name");
        }
        const std::size_t components = count("the number of components");
        const std::size_t tuples = count("the number of tuples");
        keep(values(name, type(word("a type")), components, tuples));
      }
    } else if (key == "METADATA") {
      skip_metadata();
    } else {
      fail(fmt::format("'{}' is not a section of a VTK file", key.substr(0, 40)));
    }
  }

  /// Up to an empty line.
  void skip_metadata() {
    in_.rest_of_line();
    while (in_.peek() != ByteReader::kEnd && !in_.rest_of_line().empty()) {
    }
  }

  ByteReader in_;
  std::int64_t file_size_;
  VtkFile out_;
  bool ascii_ = true;
  std::size_t tuples_ = 0;
  std::vector<VtkArray>* data_ = nullptr;
};

}  // namespace

VtkFile index_legacy(const std::filesystem::path& file) { return LegacyIndex(file).run(); }

}  // namespace dipper::analysis::io::vtk_detail

// VTK's XML format, poly data: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <fmt/format.h>

#include <map>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::io::vtk_detail {
namespace {

using Type = VtkArray::Type;

struct Tag {
  std::string name;  // with the / of an end tag
  std::map<std::string, std::string> attributes;
  std::string get(const std::string& key) const {
    const auto at = attributes.find(key);
    return at == attributes.end() ? "" : at->second;
  }
};

class XmlIndex {
 public:
  explicit XmlIndex(const std::filesystem::path& file) : in_(file) { out_.file = file; }

  VtkFile run() {
    Tag tag;
    bool ended = false;
    while (!ended && next(tag)) {
      if (!seen_root_ && tag.name != "?xml" && tag.name != "VTKFile")
        fail("not a VTK XML file: there is no <VTKFile>");
      if (tag.name == "VTKFile") root(tag);
      if (tag.name == "Piece") piece(tag);
      if (tag.name == "AppendedData") fail("appended data: write the file with `binary no`");
      if (tag.name == "PointData" || tag.name == "CellData" || tag.name == "Points" ||
          tag.name == "Polys" || tag.name == "Verts" || tag.name == "Lines" || tag.name == "Strips")
        section_ = tag.name;
      if (tag.name == "DataArray") array(tag);
      ended = tag.name == "/VTKFile";
    }
    if (!ended) fail("the file ends before </VTKFile>: it was cut short");
    if (out_.points.line == 0) fail("there are no <Points>");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) {
    throw input_error(in_.file(), in_.line(), what);
  }

  bool next(Tag& tag) {
    for (int c = in_.get(); c != '<'; c = in_.get())
      if (c == ByteReader::kEnd) return false;
    std::string text;
    bool quoted = false;
    while (true) {
      const int c = in_.get();
      if (c == ByteReader::kEnd) return false;
      if (c == '"') quoted = !quoted;
      if (c == '>' && !quoted) break;
      text.push_back(static_cast<char>(c));
    }
    const std::size_t end = text.find_first_of(" \t\r\n");
    tag.name = text.substr(0, end);
    tag.attributes.clear();
    std::size_t at = end;
    while (at != std::string::npos) {
      const std::size_t key = text.find_first_not_of(" \t\r\n/?", at);
      const std::size_t open = text.find("=\"", at);
      if (key == std::string::npos || open == std::string::npos) break;
      const std::size_t close = text.find('"', open + 2);
      if (close == std::string::npos) break;
      tag.attributes[text.substr(key, open - key)] = text.substr(open + 2, close - open - 2);
      at = close + 1;
    }
    return true;
  }

  void root(const Tag& tag) {
    seen_root_ = true;
    if (tag.get("type") != "PolyData")
      fail(fmt::format("a VTK file of type '{}'; particles and walls are PolyData",
                       tag.get("type")));
    if (!tag.get("compressor").empty())
      fail("compressed: write it with `dump_modify ID compressor none`");
    swapped_ = tag.get("byte_order") == "BigEndian";
    header_bytes_ = tag.get("header_type") == "UInt64" ? 8 : 4;
  }

  std::size_t count(const Tag& tag, const char* key) {
    std::int64_t n = 0;
    const std::string text = tag.get(key);
    if (!parse_number(text, n) || n < 0) fail(fmt::format("{}=\"{}\" is not a count", key, text));
    return static_cast<std::size_t>(n);
  }

  void piece(const Tag& tag) {
    if (has_piece_) fail("more than one <Piece>");
    has_piece_ = true;
    points_ = count(tag, "NumberOfPoints");
    out_.polygon_count = tag.get("NumberOfPolys").empty() ? 0 : count(tag, "NumberOfPolys");
  }

  void array(const Tag& tag) {
    static const std::map<std::string, Type> types = {
        {"Int8", Type::i8},     {"UInt8", Type::u8},   {"Int16", Type::i16}, {"UInt16", Type::u16},
        {"Int32", Type::i32},   {"UInt32", Type::u32}, {"Int64", Type::i64}, {"UInt64", Type::u64},
        {"Float32", Type::f32}, {"Float64", Type::f64}};
    VtkArray a;
    const auto type = types.find(tag.get("type"));
    if (type == types.end()) return;  // names and the like
    a.type = type->second;
    a.name = tag.get("Name");
    const std::string form = tag.get("format");
    if (form == "appended") fail("appended data: write the file with `binary no`");
    a.form = form == "binary" ? VtkArray::Form::base64 : VtkArray::Form::ascii;
    a.swapped = swapped_;
    a.header_bytes = header_bytes_;
    if (!tag.get("NumberOfComponents").empty()) a.components = count(tag, "NumberOfComponents");
    a.offset = in_.offset();
    a.line = in_.line();
    if (section_ == "PointData") {
      a.tuples = points_;
      out_.point_data.push_back(a);
    } else if (section_ == "CellData") {
      // Cells of all kinds; walls have polygons only.
      a.tuples = out_.polygon_count;
      out_.cell_data.push_back(a);
    } else if (section_ == "Points") {
      a.tuples = points_;
      out_.points = a;
    } else if (section_ == "Polys" && out_.polygon_count > 0) {
      if (a.name == "offsets") {
        a.tuples = out_.polygon_count;
        out_.offsets = a;
        if (out_.connectivity) out_.connectivity->tuples = last_offset();
      } else if (a.name == "connectivity") {
        out_.connectivity = a;
      }
    }
  }

  /// How many corners the polygons have: the last of their ends.
  std::size_t last_offset() {
    return static_cast<std::size_t>(read_array(out_, *out_.offsets).back());
  }

  ByteReader in_;
  VtkFile out_;
  std::string section_;
  bool seen_root_ = false, has_piece_ = false, swapped_ = false;
  std::size_t header_bytes_ = 4, points_ = 0;
};

}  // namespace

VtkFile index_xml(const std::filesystem::path& file) { return XmlIndex(file).run(); }

}  // namespace dipper::analysis::io::vtk_detail

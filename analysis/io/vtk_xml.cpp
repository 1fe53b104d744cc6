// VTK's XML format, poly data: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <pugixml.hpp>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::io::vtk_detail {
namespace {

using Type = VtkArray::Type;

/// A file's markup without the text between the tags, which is the arrays' values and most of the
/// file: the markup alone fits the parser, which needs a whole document.
class Markup {
 public:
  explicit Markup(const std::filesystem::path& file) : in_(file) {
    while (next_tag()) {
    }
  }

  const std::string& text() const { return text_; }
  std::int64_t end_offset() const { return in_.offset(); }  ///< the file's size
  long end_line() const { return in_.line(); }

  struct Position {
    std::int64_t offset;  ///< in the file, after the tag
    long line;            ///< where the tag ends
  };
  /// Of the tag at this position of text().
  Position place(std::ptrdiff_t at) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), at);
    return after == begins_.begin()
               ? Position{0, 1}
               : places_[static_cast<std::size_t>(after - begins_.begin()) - 1];
  }

 private:
  static constexpr std::size_t kMost = 1 << 22;  // LIGGGHTS writes 2 kB of tags

  int take() {
    const int c = in_.get();
    if (c == ByteReader::kEnd) return c;
    if (text_.size() == kMost)
      throw input_error(in_.file(), in_.line(), "more than 4 MB of tags: not a VTK file");
    text_.push_back(static_cast<char>(c));
    return c;
  }

  /// Moves past the next tag or comment and keeps it. False at the end of the file.
  bool next_tag() {
    while (in_.peek() != '<')
      if (in_.get() == ByteReader::kEnd) return false;
    const std::size_t begin = text_.size();
    begins_.push_back(static_cast<std::ptrdiff_t>(begin));
    const bool comment = in_.next_is("<!--");
    int quote = 0;
    for (int c = take(); c != ByteReader::kEnd; c = take()) {
      if (comment) {
        const std::size_t n = text_.size();
        if (n - begin >= 7 && text_.compare(n - 3, 3, "-->") == 0) break;
        continue;
      }
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        break;
      }
    }
    places_.push_back({in_.offset(), in_.line()});
    return true;
  }

  ByteReader in_;
  std::string text_;
  std::vector<std::ptrdiff_t> begins_;  // of each tag in text_, and the end of the tag in the file
  std::vector<Position> places_;
};

class XmlIndex {
 public:
  explicit XmlIndex(const std::filesystem::path& file) : markup_(file) { out_.file = file; }

  VtkFile run() {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(markup_.text().data(), markup_.text().size(),
                                             pugi::parse_default, pugi::encoding_utf8);
    const pugi::xml_node root = document.child("VTKFile");
    const bool cut = markup_.text().find("</VTKFile>") == std::string::npos;
    if (markup_.text().find("<VTKFile") == std::string::npos)
      fail(1, "not a VTK XML file: there is no <VTKFile>");
    if (cut) fail(markup_.end_line(), "the file ends before </VTKFile>: it was cut short");
    if (!parsed || !root)
      fail(markup_.place(parsed.offset).line, fmt::format("not XML: {}", parsed.description()));
    read_root(root);
    const pugi::xml_node poly_data = root.child("PolyData");
    const pugi::xml_node piece = poly_data.child("Piece");
    if (root.child("AppendedData"))
      fail(line(root.child("AppendedData")), "appended data: write the file with `binary no`");
    if (!piece) fail(line(root), "there is no <Piece>");
    if (piece.next_sibling("Piece"))
      fail(line(piece.next_sibling("Piece")), "more than one <Piece>");
    read_piece(piece);
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(long line, const std::string& what) {
    throw input_error(out_.file, line, what);
  }
  long line(const pugi::xml_node& node) const { return markup_.place(node.offset_debug()).line; }

  void read_root(const pugi::xml_node& root) {
    const std::string type = root.attribute("type").value();
    if (type != "PolyData")
      fail(line(root), fmt::format("a VTK file of type '{}'; expected PolyData", type));
    if (root.attribute("compressor"))
      fail(line(root), "compressed: write it with `dump_modify ID compressor none`");
    swapped_ = std::strcmp(root.attribute("byte_order").value(), "BigEndian") == 0;
    header_bytes_ = std::strcmp(root.attribute("header_type").value(), "UInt64") == 0 ? 8 : 4;
  }

  std::size_t count(const pugi::xml_node& node, const char* key) {
    std::int64_t n = 0;
    const std::string_view text = node.attribute(key).value();
    if (!parse_number(text, n) || n < 0)
      fail(line(node), fmt::format("{}=\"{}\" is not a count", key, text.substr(0, 40)));
    return static_cast<std::size_t>(n);
  }
  std::size_t count(const pugi::xml_node& node, const char* key, std::size_t otherwise) {
    return node.attribute(key) ? count(node, key) : otherwise;
  }

  void read_piece(const pugi::xml_node& piece) {
    const std::size_t points = count(piece, "NumberOfPoints");
    const std::size_t polygons = count(piece, "NumberOfPolys", 0);
    out_.polygon_count = polygons;
    for (const pugi::xml_node& node : piece.child("PointData").children("DataArray"))
      if (auto a = array(node, points)) out_.point_data.push_back(*a);
    // Cells of all kinds; walls only have polygons.
    for (const pugi::xml_node& node : piece.child("CellData").children("DataArray"))
      if (auto a = array(node, polygons)) out_.cell_data.push_back(*a);
    const auto xyz = array(piece.child("Points").child("DataArray"), points);
    if (!xyz) fail(line(piece), "there are no <Points>");
    if (xyz->components != 3) fail(xyz->line, "points must be x, y, z");
    out_.points = *xyz;
    if (polygons > 0) read_polygons(piece.child("Polys"), polygons);
  }

  void read_polygons(const pugi::xml_node& polys, std::size_t polygons) {
    const auto named = [&](const char* name) {
      return polys.find_child_by_attribute("DataArray", "Name", name);
    };
    out_.offsets = array(named("offsets"), polygons);
    if (!out_.offsets) return;
    // How many corners there are: the last polygon's end.
    const double last = read_array(out_, *out_.offsets).back();
    if (!(last >= 0 && last <= static_cast<double>(markup_.end_offset())))
      fail(out_.offsets->line,
           fmt::format("the last polygon ends at corner {}; the file is too short for that", last));
    out_.connectivity = array(named("connectivity"), static_cast<std::size_t>(last));
  }

  /// Empty for arrays without numbers, such as names.
  std::optional<VtkArray> array(const pugi::xml_node& node, std::size_t tuples) {
    static const std::map<std::string, Type> types = {
        {"Int8", Type::i8},     {"UInt8", Type::u8},   {"Int16", Type::i16}, {"UInt16", Type::u16},
        {"Int32", Type::i32},   {"UInt32", Type::u32}, {"Int64", Type::i64}, {"UInt64", Type::u64},
        {"Float32", Type::f32}, {"Float64", Type::f64}};
    const auto type = types.find(node.attribute("type").value());
    if (!node || type == types.end()) return std::nullopt;
    const Markup::Position place = markup_.place(node.offset_debug());
    const std::string form = node.attribute("format").value();
    if (form == "appended") fail(place.line, "appended data: write the file with `binary no`");
    VtkArray a;
    a.name = node.attribute("Name").value();
    a.type = type->second;
    a.form = form == "binary" ? VtkArray::Form::base64 : VtkArray::Form::ascii;
    a.swapped = swapped_;
    a.header_bytes = header_bytes_;
    a.components = count(node, "NumberOfComponents", 1);
    a.tuples = tuples;
    a.offset = place.offset;
    a.line = place.line;
    check_room(out_.file, a, markup_.end_offset());
    return a;
  }

  Markup markup_;
  VtkFile out_;
  bool swapped_ = false;
  std::size_t header_bytes_ = 4;
};

}  // namespace

VtkFile index_xml(const std::filesystem::path& file) { return XmlIndex(file).run(); }

}  // namespace dipper::analysis::io::vtk_detail

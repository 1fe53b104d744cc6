#include "analysis/io/vtp_writer.hpp"

#include <glib.h>

#include <array>
#include <cstring>
#include <fstream>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace dipper::analysis::io {
namespace {

using Type = VtkArray::Type;

constexpr const char* kValues = "@";  // stands for an array's values in the markup

const char* name_of(Type type) {
  switch (type) {
    case Type::i32:
      return "Int32";
    case Type::i64:
      return "Int64";
    case Type::f32:
      return "Float32";
    default:
      throw std::invalid_argument("a type that cannot be written");
  }
}

/// Base64 (RFC 4648) of a stream of bytes.
class Base64Stream {
 public:
  explicit Base64Stream(std::ostream& out) : out_(out) {}

  template <typename T>
  void put(T value) {
    if (filled_ + sizeof value > plain_.size()) flush();
    std::memcpy(plain_.data() + filled_, &value, sizeof value);
    filled_ += sizeof value;
  }
  void end() {
    flush();
    out_.write(text_.data(), static_cast<std::streamsize>(
                                 g_base64_encode_close(FALSE, text_.data(), &state_, &save_)));
  }

 private:
  void flush() {
    const gsize n =
        g_base64_encode_step(plain_.data(), filled_, FALSE, text_.data(), &state_, &save_);
    out_.write(text_.data(), static_cast<std::streamsize>(n));
    filled_ = 0;
  }

  static constexpr std::size_t kPlain = 3 << 12;
  std::ostream& out_;
  std::array<guchar, kPlain> plain_{};
  std::array<gchar, kPlain / 3 * 4 + 8> text_{};
  std::size_t filled_ = 0;
  gint state_ = 0, save_ = 0;
};

void write_values(std::ostream& out, const VtpWriter::Array& array, const VtpWriter::Fill& fill) {
  Base64Stream data(out);
  const std::size_t n = array.components * array.tuples;
  data.put(static_cast<std::uint64_t>(n * vtk_detail::bytes(array.type)));
  switch (array.type) {
    case Type::i32:
      fill([&](double v) { data.put(static_cast<std::int32_t>(v)); });
      break;
    case Type::i64:
      fill([&](double v) { data.put(static_cast<std::int64_t>(v)); });
      break;
    default:
      fill([&](double v) { data.put(static_cast<float>(v)); });
  }
  data.end();
}

}  // namespace

std::string VtpWriter::markup() const {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = "PolyData";
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") = "LittleEndian";
  root.append_attribute("header_type") = "UInt64";
  pugi::xml_node piece = root.append_child("PolyData").append_child("Piece");
  piece.append_attribute("NumberOfPoints") = points_;
  piece.append_attribute("NumberOfVerts") = verts_;
  piece.append_attribute("NumberOfPolys") = polys_;
  for (const Entry& e : entries_) {
    pugi::xml_node section = piece.last_child();
    if (section.name() != e.section) section = piece.append_child(e.section.c_str());
    pugi::xml_node array = section.append_child("DataArray");
    array.append_attribute("type") = name_of(e.array.type);
    array.append_attribute("Name") = e.array.name.c_str();
    array.append_attribute("NumberOfComponents") = e.array.components;
    array.append_attribute("format") = "binary";
    array.text() = kValues;
  }
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

void VtpWriter::write(const std::filesystem::path& file) const {
  std::ofstream out(file, std::ios::binary);
  const std::string text = markup();
  const std::string here = std::string(">") + kValues + "<";  // no attribute holds a bare '>'
  std::size_t at = 0;
  for (const Entry& e : entries_) {
    const std::size_t next = text.find(here, at) + 1;
    out.write(text.data() + at, static_cast<std::streamsize>(next - at));
    write_values(out, e.array, e.fill);
    at = next + std::strlen(kValues);
  }
  out.write(text.data() + at, static_cast<std::streamsize>(text.size() - at));
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace dipper::analysis::io

#include "common/mesh/other_format.hpp"

#include <algorithm>
#include <utility>

#include "common/begins_with.hpp"

namespace dipper::mesh {
namespace {

using Beginning = std::pair<std::string_view, const char*>;
constexpr Beginning beginnings[] = {{"ply", "PLY"},
                                    {"ISO-10303", "STEP"},
                                    {"PK", "3MF or zip"},
                                    {"glTF", "glTF"},
                                    {"OFF", "OFF"},
                                    {"# vtk", "VTK"},
                                    {"<?xml", "XML"},
                                    {"<amf", "AMF"},
                                    {"<!DOCTYPE", "HTML"},
                                    {"<html", "HTML"},
                                    {"#VRML", "VRML"},
                                    {"$MeshFormat", "Gmsh"},
                                    {"Kaydara FBX", "FBX"},
                                    {"; FBX", "FBX"},
                                    {"AC10", "DWG"},
                                    {"\x1F\x8B", "gzip"},
                                    {"\xFF\xFE", "UTF-16"},
                                    {"\xFE\xFF", "UTF-16"},
                                    {"version https://git-lfs", git_pointer}};

/// The first line, which is taken off `rest`.
std::string_view next_line(std::string_view& rest) {
  std::string_view line = rest.substr(0, rest.find('\n'));
  rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool is_obj(std::string_view rest) {  // comments, then such words
  while (!rest.empty()) {
    const std::string_view line = next_line(rest);
    for (const std::string_view word : {"v ", "vn ", "vt ", "o ", "g ", "mtllib ", "usemtl "})
      if (begins_with(line, word)) return true;
    if (!line.empty() && line[0] != '#') return false;
  }
  return false;
}

/// Pairs of lines, a group's code and its value: comments (999), then a section (0).
bool is_dxf(std::string_view rest) {
  while (!rest.empty()) {
    std::string_view code = next_line(rest);
    code.remove_prefix(std::min(code.find_first_not_of(' '), code.size()));
    const std::string_view value = next_line(rest);
    if (code != "999") return code == "0" && value == "SECTION";
  }
  return false;
}

/// The first of the lines with which a file begins ends in S, for its section, and its number.
bool is_iges(std::string_view rest) {
  constexpr std::size_t digits = 7;
  const std::string_view line = next_line(rest);
  if (line.size() <= digits || line[line.size() - digits - 1] != 'S') return false;
  const std::string_view number = line.substr(line.size() - digits);
  return number.back() == '1' && number.find_first_not_of(" 0") == digits - 1;
}

}  // namespace

std::string other_format(std::string_view bytes) {
  for (const auto& [begin, name] : beginnings)
    if (begins_with(bytes, begin)) return name;
  return is_obj(bytes) ? "OBJ" : is_dxf(bytes) ? "DXF" : is_iges(bytes) ? "IGES" : "";
}

}  // namespace dipper::mesh

#include "analysis/metrics/paraview_files.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::metrics {
namespace {

namespace fs = std::filesystem;

/// Binary data in an XML file, as it comes: base64 (RFC 4648).
class Base64 {
 public:
  explicit Base64(std::ofstream& out) : out_(out) {}
  template <typename T>
  void put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const char b : bytes) {
      bits_ = (bits_ << 8) | static_cast<unsigned char>(b);
      if (++count_ == 3) flush(4);
    }
  }
  void end() {
    if (count_ == 0) return;
    const int digits = count_ + 1;
    bits_ <<= 8 * (3 - count_);
    flush(digits);
    for (int k = digits; k < 4; ++k) out_ << '=';
  }

 private:
  void flush(int digits) {
    static const char* const alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int k = 0; k < digits; ++k) out_ << alphabet[(bits_ >> (18 - 6 * k)) & 63U];
    bits_ = 0;
    count_ = 0;
  }
  std::ofstream& out_;
  unsigned bits_ = 0;
  int count_ = 0;
};

/// A poly data file of one piece, written array by array.
class VtpFile {
 public:
  VtpFile(const fs::path& file, std::size_t points, std::size_t verts, std::size_t polys)
      : file_(file), out_(file, std::ios::binary) {
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
         << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfPolys=\"{}\">\n",
                        points, verts, polys);
  }
  void open(const char* section) { out_ << '<' << section << ">\n"; }
  void close(const char* section) { out_ << "</" << section << ">\n"; }

  /// `fill(put)` calls put with each of the n values.
  template <typename T, typename Fill>
  void array(const char* type, const std::string& name, int components, std::size_t n, Fill fill) {
    out_ << fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
        "format=\"binary\">\n",
        type, name, components);
    Base64 data(out_);
    data.put(static_cast<std::uint64_t>(n * sizeof(T)));
    fill([&](double v) { data.put(static_cast<T>(v)); });
    data.end();
    out_ << "\n</DataArray>\n";
  }
  void finish() {
    out_ << "</Piece>\n</PolyData>\n</VTKFile>\n";
    if (!out_.flush()) throw std::runtime_error(file_.string() + ": cannot be written");
  }

 private:
  fs::path file_;
  std::ofstream out_;
};

/// Cells of `corners` points each, in their order.
void write_cells(VtpFile& file, const char* section, std::size_t cells, std::size_t corners) {
  file.open(section);
  file.array<std::int64_t>("Int64", "connectivity", 1, cells * corners, [&](auto put) {
    for (std::size_t i = 0; i < cells * corners; ++i) put(static_cast<double>(i));
  });
  file.array<std::int64_t>("Int64", "offsets", 1, cells, [&](auto put) {
    for (std::size_t i = 1; i <= cells; ++i) put(static_cast<double>(i * corners));
  });
  file.close(section);
}

void write_wall(const io::VtkFile& vtk, const fs::path& to) {
  const io::WallDump wall = io::read_wall_dump(vtk);
  const std::size_t n = wall.mesh.triangles.size();
  VtpFile file(to, 3 * n, 0, n);
  file.open("CellData");
  for (const io::VtkArray& a : vtk.cell_data) {
    const std::vector<double> values = io::read_array(vtk, a);
    file.array<float>("Float32", a.name, static_cast<int>(a.components), n * a.components,
                      [&](auto put) {
                        for (const std::size_t cell : wall.cell)
                          for (std::size_t k = 0; k < a.components; ++k)
                            put(values.at(cell * a.components + k));
                      });
  }
  file.close("CellData");
  file.open("Points");
  file.array<float>("Float32", "Points", 3, 9 * n, [&](auto put) {
    for (std::size_t t = 0; t < n; ++t)
      for (const auto& corner : wall.mesh.corners(t))
        for (int k = 0; k < 3; ++k) put(corner[k]);
  });
  file.close("Points");
  write_cells(file, "Polys", n, 3);
  file.finish();
}

/// An array of a text dump, read once for it: memory stays a chunk's.
template <typename T>
void write_columns(VtpFile& file, const char* type, const std::string& name,
                   const io::DumpFrame& frame, const std::vector<std::string>& columns) {
  file.array<T>(type, name, static_cast<int>(columns.size()), frame.particles * columns.size(),
                [&](auto put) {
                  io::DumpReader::read(frame, columns, [&](const io::ParticleChunk& chunk) {
                    for (std::size_t i = 0; i < chunk.rows; ++i)
                      for (const auto& column : chunk.columns) put(column[i]);
                  });
                });
}

void write_particles(const io::DumpFrame& frame, const fs::path& to) {
  VtpFile file(to, frame.particles, frame.particles, 0);
  file.open("PointData");
  for (const char* name : {"id", "type", "id_multisphere"})
    if (frame.has(name)) write_columns<std::int32_t>(file, "Int32", name, frame, {name});
  for (const char* name : {"radius", "density", "mass"})
    if (frame.has(name)) write_columns<float>(file, "Float32", name, frame, {name});
  if (frame.has("vx") && frame.has("vy") && frame.has("vz"))
    write_columns<float>(file, "Float32", "v", frame, {"vx", "vy", "vz"});
  file.close("PointData");
  file.open("Points");
  write_columns<float>(file, "Float32", "Points", frame, {"x", "y", "z"});
  file.close("Points");
  write_cells(file, "Verts", frame.particles, 1);
  file.finish();
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string entry(double time_s, int part, const std::string& name, const std::string& file) {
  return fmt::format("<DataSet timestep=\"{:.10g}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                     time_s, part, name, file);
}

}  // namespace

void write_paraview_files(const io::DumpFolder& dumps, const fs::path& folder,
                          const fs::path& final_folder) {
  fs::create_directories(folder / "paraview");
  std::string list;
  for (std::size_t k = 0; k < dumps.frames.size(); ++k) {
    const io::DumpFrame& frame = dumps.frames[k];
    const std::string name = fmt::format("{}_{}.vtp", dumps.particles, frame.step);
    const fs::path dumped = frame.file.extension() == ".vtp" ? frame.file : dumps.folder / name;
    std::string seen = "paraview/" + name;
    if (fs::exists(dumped)) {
      seen = fs::relative(dumped, final_folder).generic_string();
    } else {
      write_particles(frame, folder / seen);
    }
    list += entry(dumps.time_s[k], 0, dumps.particles, seen);
  }
  int part = 0;
  for (const auto& [name, files] : dumps.walls) {
    ++part;
    std::string to, last_bytes;
    for (const auto& [step, file] : files) {
      const io::VtkFile vtk = io::index_vtk(file);
      if (vtk.polygon_count == 0) continue;
      // A wall that stands still is one file.
      if (std::string bytes = bytes_of(file); bytes != last_bytes) {
        to = fmt::format("paraview/{}_{}.vtp", name, step);
        write_wall(vtk, folder / to);
        last_bytes = std::move(bytes);
      }
      list += entry(static_cast<double>(step) * dumps.timestep_s, part, name, to);
    }
  }
  std::ofstream out(folder / "run.pvd", std::ios::binary);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<Collection>\n"
      << list << "</Collection>\n</VTKFile>\n";
  if (!out.flush()) throw std::runtime_error((folder / "run.pvd").string() + ": cannot be written");
}

}  // namespace dipper::analysis::metrics

#include "analysis/metrics/paraview_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <pugixml.hpp>
#include <stdexcept>

#include "analysis/io/vtk_file.hpp"
#include "analysis/io/vtp_writer.hpp"
#include "analysis/metrics/figure_files.hpp"
#include "analysis/metrics/particle_files.hpp"

namespace dipper::analysis::metrics {
namespace {

namespace fs = std::filesystem;

using Type = io::VtkArray::Type;

/// Cells of `corners` points each, in their order.
void add_cells(io::VtpWriter& file, const char* section, std::size_t cells, std::size_t corners) {
  file.add(section, {"connectivity", Type::i64, 1, cells * corners}, [=](const auto& put) {
    for (std::size_t i = 0; i < cells * corners; ++i) put(static_cast<double>(i));
  });
  file.add(section, {"offsets", Type::i64, 1, cells}, [=](const auto& put) {
    for (std::size_t i = 1; i <= cells; ++i) put(static_cast<double>(i * corners));
  });
}

void write_wall(const io::VtkFile& vtk, const fs::path& to) {
  const io::WallDump wall = io::read_wall_dump(vtk);
  const std::size_t n = wall.mesh.triangles.size();
  io::VtpWriter file(3 * n, 0, n);
  for (const io::VtkArray& a : vtk.cell_data)
    file.add("CellData", {a.name, Type::f32, a.components, n}, [&](const auto& put) {
      const std::vector<double> values = io::read_array(vtk, a);
      for (const std::size_t cell : wall.cell)
        for (std::size_t k = 0; k < a.components; ++k) put(values.at(cell * a.components + k));
    });
  file.add("Points", {"Points", Type::f32, 3, 3 * n}, [&](const auto& put) {
    for (std::size_t t = 0; t < n; ++t)
      for (const auto& corner : wall.mesh.corners(t))
        for (int k = 0; k < 3; ++k) put(corner[k]);
  });
  add_cells(file, "Polys", n, 3);
  file.write(to);
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void add_entry(pugi::xml_node collection, double time_s, int part, const std::string& name,
               const std::string& file) {
  pugi::xml_node entry = collection.append_child("DataSet");
  entry.append_attribute("timestep") = fmt::format("{:.10g}", time_s).c_str();
  entry.append_attribute("part") = part;
  entry.append_attribute("name") = name.c_str();
  entry.append_attribute("file") = file.c_str();
}

}  // namespace

void write_paraview_files(const run::RunData& run, const io::DumpFolder& dumps,
                          const run::Figure& figure, const fs::path& folder) {
  fs::create_directories(folder / "paraview");
  pugi::xml_document list;
  pugi::xml_node root = list.append_child("VTKFile");
  root.append_attribute("type") = "Collection";
  root.append_attribute("version") = "0.1";
  root.append_attribute("byte_order") = "LittleEndian";
  const pugi::xml_node collection = root.append_child("Collection");
  const ParticleFiles particles(run);
  for (std::size_t k = 0; k < dumps.frames.size(); ++k) {
    const std::string to = fmt::format("paraview/{}_{}.vtp", dumps.particles, dumps.frames[k].step);
    particles.write(dumps.frames[k], dumps.time_s[k], folder / to);
    add_entry(collection, dumps.time_s[k], 0, dumps.particles, to);
  }
  int part = 0;
  for (const auto& [name, files] : dumps.walls) {
    ++part;
    std::string to, last_bytes;
    for (const auto& [step, file] : files) {
      const io::VtkFile vtk = io::index_vtk(file);
      if (vtk.polygon_count == 0) continue;
      // A wall that does not move is one file.
      if (std::string bytes = bytes_of(file); bytes != last_bytes) {
        to = fmt::format("paraview/{}_{}.vtp", name, step);
        write_wall(vtk, folder / to);
        last_bytes = std::move(bytes);
      }
      add_entry(collection, static_cast<double>(step) * dumps.timestep_s, part, name, to);
    }
  }
  std::string last_name;
  write_figure_files(figure, dumps.time_s, folder,
                     [&](const std::string& name, double time_s, const std::string& file) {
                       if (name != last_name) ++part;
                       last_name = name;
                       add_entry(collection, time_s, part, name, file);
                     });
  const fs::path file = folder / "run.pvd";
  if (!list.save_file(file.c_str(), " "))
    throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace dipper::analysis::metrics

#include "analysis/rock/wall_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"

namespace dipper::analysis::rock {
namespace {

constexpr const char* kNumber = "meshid";  // LIGGGHTS's name for a triangle's number

/// One value for each triangle, from its cell.
std::vector<double> values_of(const io::VtkFile& vtk, const io::VtkArray& array,
                              const std::vector<std::size_t>& cells) {
  const std::vector<double> all = io::read_array(vtk, array);
  std::vector<double> out;
  for (const std::size_t cell : cells) {
    double square = 0;
    for (std::size_t k = 0; k < array.components; ++k)
      square += std::pow(all.at(cell * array.components + k), 2);
    out.push_back(array.components == 1 ? all[cell] : std::sqrt(square));
  }
  return out;
}

WallFrame read_frame(const io::VtkFile& vtk) {
  const io::WallDump wall = io::read_wall_dump(vtk);
  std::vector<std::size_t> order(wall.cell.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (const io::VtkArray* number = vtk.cell_array(kNumber)) {
    const std::vector<double> id = values_of(vtk, *number, wall.cell);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  }
  WallFrame f;
  f.mesh.vertices = wall.mesh.vertices;
  std::vector<std::size_t> cells;
  for (const std::size_t t : order) {
    f.mesh.triangles.push_back(wall.mesh.triangles[t]);
    cells.push_back(wall.cell[t]);
  }
  for (const io::VtkArray& array : vtk.cell_data) {
    if (array.name == kNumber) continue;
    f.fields[array.name] = values_of(vtk, array, cells);
    f.line[array.name] = array.line;
  }
  return f;
}

void add_frame(WallField& f, const std::vector<double>& values) {
  if (f.last.empty()) {
    f.mean.assign(values.size(), 0);
    f.max = values;
  }
  f.last = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    f.mean[i] += values[i];
    f.max[i] = std::max(f.max[i], values[i]);
  }
}

}  // namespace

WallFrame read_wall_frame(const std::filesystem::path& file) {
  return read_frame(io::index_vtk(file));
}

std::vector<WallField> read_wall_fields(const io::DumpFolder& dumps) {
  std::vector<WallField> fields;
  for (const auto& [body, files] : dumps.walls) {
    std::map<std::string, WallField> of;
    std::map<std::string, double> frames;  // that have the field
    WallFrame wall;
    for (const auto& [step, file] : files) {
      const io::VtkFile vtk = io::index_vtk(file);
      if (vtk.cell_data.size() == 1 && vtk.cell_array(kNumber) != nullptr) continue;
      wall = read_frame(vtk);
      for (const auto& [name, values] : wall.fields) {
        WallField& f = of[name];
        if (!f.last.empty() && f.last.size() != values.size())
          throw io::input_error(file, wall.line[name],
                                fmt::format("{} has {} triangles, the previous frame had {}", body,
                                            values.size(), f.last.size()));
        add_frame(f, values);
        ++frames[name];
        f.time_s = static_cast<double>(step) * dumps.timestep_s;
      }
    }
    for (auto& [name, f] : of) {
      f.body = body;
      f.field = name;
      for (double& m : f.mean) m /= frames[name];
      for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t) {
        const mesh::Triangle c = wall.mesh.corners(t);
        f.middle_m.push_back((c[0] + c[1] + c[2]) / 3);
        f.area_m2.push_back(mesh::facet_area(wall.mesh, t));
      }
      fields.push_back(std::move(f));
    }
  }
  return fields;
}

}  // namespace dipper::analysis::rock

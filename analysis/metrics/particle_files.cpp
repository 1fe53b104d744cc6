#include "analysis/metrics/particle_files.hpp"

#include "analysis/io/vtp_writer.hpp"

namespace dipper::analysis::metrics {
namespace {

using Type = io::VtkArray::Type;

/// An array of a dump, read chunk by chunk to bound the memory.
void add_columns(io::VtpWriter& file, const char* section, Type type, const std::string& name,
                 const io::DumpFrame& frame, const std::vector<std::string>& columns) {
  file.add(section, {name, type, columns.size(), frame.particles},
           [&frame, columns](const auto& put) {
             io::DumpReader::read(frame, columns, [&](const io::ParticleChunk& chunk) {
               for (std::size_t i = 0; i < chunk.rows; ++i)
                 for (const auto& column : chunk.columns) put(column[i]);
             });
           });
}

}  // namespace

ParticleFiles::ParticleFiles(const run::RunData& run) : run_(run) {
  if (run.is_run) shapes_ = rock::read_shapes(run.folder / "deck");
}

void ParticleFiles::write(const io::DumpFrame& frame, double time_s,
                          const std::filesystem::path& to) const {
  const bool loaded = run_.regions.dipper && !run_.dipper.empty();
  const Pose X_WB = run_.dipper.empty() ? Pose{} : run_.dipper.at(time_s).X_WB;
  const auto tags = rock::tag_rocks(frame, run_.clumps, shapes_, run_.regions, X_WB);
  const std::size_t n = frame.particles;
  io::VtpWriter file(n, n, 0);
  for (const char* name : {"id", "type", "id_multisphere"})
    if (frame.has(name)) add_columns(file, "PointData", Type::i32, name, frame, {name});
  for (const char* name : {"radius", "density", "mass"})
    if (frame.has(name)) add_columns(file, "PointData", Type::f32, name, frame, {name});
  if (frame.has("vx") && frame.has("vy") && frame.has("vz"))
    add_columns(file, "PointData", Type::f32, "v", frame, {"vx", "vy", "vz"});
  const auto add_tag = [&](const char* name, Type type, const auto& value) {
    file.add("PointData", {name, type, 1, n}, [&frame, &tags, value](const auto& put) {
      std::vector<std::string> columns = {"id"};
      if (frame.has("id_multisphere")) columns.emplace_back("id_multisphere");
      io::DumpReader::read(frame, columns, [&](const io::ParticleChunk& chunk) {
        for (std::size_t i = 0; i < chunk.rows; ++i) {
          const double clump = columns.size() > 1 ? chunk.columns[1][i] : -1;
          const std::int64_t key = rock::rock_key(static_cast<std::int64_t>(chunk.columns[0][i]),
                                                  static_cast<std::int64_t>(clump));
          put(static_cast<double>(value(key, tags.at(key))));
        }
      });
    });
  };
  add_tag("rock", Type::i32, [](std::int64_t key, const rock::RockTag&) { return key; });
  add_tag("size", Type::f32, [](std::int64_t, const rock::RockTag& tag) { return tag.size_m; });
  if (loaded)
    add_tag("in_dipper", Type::i32,
            [](std::int64_t, const rock::RockTag& tag) { return tag.in_dipper ? 1 : 0; });
  if (!shapes_.empty())
    add_tag("shape", Type::i32, [](std::int64_t, const rock::RockTag& tag) { return tag.shape; });
  add_columns(file, "Points", Type::f32, "Points", frame, {"x", "y", "z"});
  file.add("Verts", {"connectivity", Type::i32, 1, n}, [n](const auto& put) {
    for (std::size_t i = 0; i < n; ++i) put(static_cast<double>(i));
  });
  file.add("Verts", {"offsets", Type::i32, 1, n}, [n](const auto& put) {
    for (std::size_t i = 1; i <= n; ++i) put(static_cast<double>(i));
  });
  file.write(to);
}

}  // namespace dipper::analysis::metrics

#include "analysis/report/replay_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/report/packing.hpp"
#include "analysis/report/replay_json.hpp"

namespace dipper::analysis::report {
namespace {

using json = nlohmann::json;

std::vector<std::size_t> every(std::size_t stride, std::size_t count) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; i += stride) kept.push_back(i);
  if (!kept.empty() && kept.back() != count - 1) kept.push_back(count - 1);
  return kept;
}

/// Blocks and poses of the frames kept; empty when they exceed `bytes_max`.
struct Encoded {
  std::vector<std::vector<std::uint8_t>> blocks;
  std::vector<std::size_t> frames_in_block;
  std::vector<json> poses;  ///< one a wall
};
std::optional<Encoded> encode(const ReplaySource& source, const std::vector<std::size_t>& kept,
                              const ReplaySource::Keep& keep, ReplayEncoder encoder,
                              const ReplayLimits& limits) {
  Encoded out;
  out.poses.assign(source.walls().size(), json::array());
  std::vector<std::uint8_t> raw;
  std::size_t bytes = 0, frames = 0;
  ReplayFrame frame;
  for (const std::size_t k : kept) {
    source.read(k, frame, keep);
    encoder.encode(frame, raw);
    ++frames;
    for (std::size_t w = 0; w < out.poses.size(); ++w) {
      out.poses[w].push_back(json_of_pose(frame.walls.at(w).X_WB));
    }
    if (raw.size() >= limits.block_bytes || k == kept.back()) {
      out.blocks.push_back(gzip(raw.data(), raw.size()));
      out.frames_in_block.push_back(frames);
      bytes += out.blocks.back().size();
      if (bytes > limits.bytes_max && kept.size() > 2) return std::nullopt;
      raw.clear();
      frames = 0;
    }
  }
  return out;
}

}  // namespace

ReplayBlocks encode_replay(const ReplaySource& source, const ReplayLimits& limits) {
  ReplayExtent extent(limits.spheres_max);
  ReplayFrame frame;
  const auto& times = source.times_s();
  std::size_t most_spheres = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    std::size_t count = 0;
    source.read(k, frame, [&](const ReplaySphere& s) {
      extent.add(s);
      ++count;
      return false;
    });
    extent.add_values(frame, source.walls());
    most_spheres = std::max(most_spheres, count);
  }
  std::vector<ReplaySphere> spheres = extent.spheres;
  // From the face inwards: moving rock is contiguous, and zeros make long runs.
  std::sort(spheres.begin(), spheres.end(), [](const ReplaySphere& a, const ReplaySphere& b) {
    return std::make_pair(a.p_m.x(), a.id) < std::make_pair(b.p_m.x(), b.id);
  });

  const ReplayEncoder encoder(extent, spheres, source.walls());
  const auto keep = [&](const ReplaySphere& s) { return shown(s, extent.one_in); };
  std::size_t frame_bytes = 7 * spheres.size();
  for (const auto& w : source.walls()) frame_bytes += w.fields.size() * w.mesh.triangles.size();
  std::size_t stride = 1;
  while (times.size() / stride * frame_bytes > limits.decoded_max) stride *= 2;
  auto kept = every(stride, times.size());
  auto encoded = encode(source, kept, keep, encoder, limits);
  while (!encoded) {
    stride *= 2;
    kept = every(stride, times.size());
    encoded = encode(source, kept, keep, encoder, limits);
  }

  json head = {
      {"spheres", spheres.size()},
      {"spheres_in_run", most_spheres},
      {"one_rock_in", extent.one_in},
      {"one_frame_in", stride},
      {"frames_in_run", times.size()},
      {"speed_max_m_s", extent.speed_max_m_s},
      {"origin_m", {encoder.origin_m().x(), encoder.origin_m().y(), encoder.origin_m().z()}},
      {"step_m", {encoder.step_m().x(), encoder.step_m().y(), encoder.step_m().z()}},
      {"frames_in_block", encoded->frames_in_block},
      {"field_max", extent.field_max}};
  for (const std::size_t k : kept) head["times_s"].push_back(rounded(times[k], 1e6));
  for (const auto& s : spheres) {
    head["radius_m"].push_back(rounded(static_cast<double>(s.radius_m), 1e4));
    head["type"].push_back(s.type);
    head["rock"].push_back(s.rock);
  }
  head["walls"] = json::array();
  for (std::size_t w = 0; w < source.walls().size(); ++w) {
    const auto& wall = source.walls()[w];
    head["walls"].push_back({{"name", wall.name},
                             {"triangles_m", json_of_triangles(wall.mesh)},
                             {"fields", wall.fields},
                             {"poses", encoded->poses[w]}});
  }
  return {std::move(head), std::move(encoded->blocks)};
}

}  // namespace dipper::analysis::report

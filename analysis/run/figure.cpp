#include "analysis/run/figure.hpp"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/json_values.hpp"
#include "common/record/record.hpp"
#include "machine/truck_figure.hpp"

namespace dipper::analysis::run {
namespace {

/// The frames of the shovel's parts against time.
struct Tracks {
  machine::MachineData machine;
  Pose X_W0;                              ///< of the crawlers
  rock::PoseTrack house, saddle, handle;  ///< X_WH, X_WA, X_WE
  rock::PoseTrack dipper;                 ///< X_WB, as the rock met it
};

std::shared_ptr<const Tracks> read_tracks(const RunData& run) {
  const auto record = run.folder / "record.h5";
  auto t = std::make_shared<Tracks>();
  t->machine = machine::load_machine(run.folder / kMachineFile);
  t->X_W0.p = run.vector("machine.base_position_m");
  t->dipper = run.dipper;
  const std::vector<double> pitch = record::read_channel(record, "machine/saddle_pitch");
  const signals::DriveSignals& drive = run.signals.drive;
  std::vector<double> time_s = drive.time_s;
  time_s.resize(std::min(time_s.size(), pitch.size()));
  std::vector<Pose> X_WH, X_WA, X_WE;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const Quaterniond swing(Eigen::AngleAxisd(drive.swing_rad[i], Vector3d::UnitZ()));
    const Quaterniond raise(Eigen::AngleAxisd(-pitch[i], Vector3d::UnitY()));
    const double reach = t->machine.handle.reach_at_zero_crowd + drive.crowd_m[i];
    X_WH.push_back(t->X_W0 * Pose{swing, Vector3d::Zero()});
    X_WA.push_back(X_WH.back() * Pose{raise, t->machine.saddle.position});
    X_WE.push_back(X_WA.back() * Pose{Quaterniond::Identity(), {reach, 0, 0}});
  }
  t->house = {time_s, std::move(X_WH)};
  t->saddle = {time_s, std::move(X_WA)};
  t->handle = {time_s, std::move(X_WE)};
  return t;
}

}  // namespace

Figure read_figure(const RunData& run) {
  Figure figure;
  if (!std::filesystem::exists(run.folder / kMachineFile)) return figure;
  const std::shared_ptr<const Tracks> tracks = read_tracks(run);
  machine::ShovelFigure shovel = machine::shovel_figure(tracks->machine);
  const auto moved_by = [&](rock::PoseTrack Tracks::*track) {
    return [tracks, track](double t_s) { return (*tracks.*track).at(t_s).X_WB; };
  };
  figure.bodies = {
      {"crawlers", std::move(shovel.ground), [tracks](double) { return tracks->X_W0; }},
      {"house", std::move(shovel.house), moved_by(&Tracks::house)},
      {"saddle", std::move(shovel.saddle), moved_by(&Tracks::saddle)},
      {"handle", std::move(shovel.handle), moved_by(&Tracks::handle)},
      {"bail", std::move(shovel.dipper), moved_by(&Tracks::dipper)}};
  const auto truck = run.meshes.find("truck");
  if (truck != run.meshes.end())
    figure.bodies.push_back({"truck outline",
                             machine::truck_figure(mesh::bounding_box(truck->second)),
                             [X_WT = run.regions.X_WT](double) { return X_WT; }});
  for (const double side : {1.0, -1.0}) {
    figure.ropes.push_back(
        {shovel.rope_radius, [tracks, side](double t_s) {
           const Pose X_WH = tracks->house.at(t_s).X_WB, X_WB = tracks->dipper.at(t_s).X_WB;
           Vector3d pin = tracks->machine.dipper.bail;
           pin.y() *= side;
           auto way = machine::rope_way(tracks->machine, side, inverse(X_WH) * (X_WB * pin));
           for (Vector3d& p : way) p = X_WH * p;
           return way;
         }});
  }
  return figure;
}

}  // namespace dipper::analysis::run

#include "coupler/run/preparation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/mesh/stl.hpp"
#include "common/record/record.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/result/dump_index.hpp"
#include "coupler/run/pile.hpp"
#include "coupler/run/same_run.hpp"
#include "coupler/sides/dipper_layers.hpp"
#include "coupler/sides/sides_setup.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

void write_decks(const cases::Case& c, const sides::DipperLayers& layers, const fs::path& deck) {
  cases::Case as_built = c;
  if (layers.mesh) {
    as_built.bodies["dipper"] = deck / "dipper.stl";
    write_text(as_built.bodies["dipper"], mesh::to_stl("dipper", *layers.mesh));
  }
  deck::write_deck(as_built, c.rock.shape_folder, deck);
}

fs::path find_pile(const cases::Case& c, const result::RunFolder& folder,
                   const launch::MpiPlaces& places, Reporter& reporter) {
  reporter.line("pile: from the cache, or settled first");
  const Pile pile = settled_pile(c, folder.deck(), folder.logs(), places);
  reporter.line(pile.cached ? "pile: cached"
                            : fmt::format("pile: settled in {:.0f} s", pile.wall_s));
  return pile.restart;
}

std::vector<setup::WallMemory> wall_memory(const core::CouplingState& state) {
  std::vector<setup::WallMemory> memory;
  for (const core::WallState& wall : state.walls) memory.push_back({wall.load, wall.V_WB_W});
  return memory;
}

}  // namespace

RunEnd run_end(const cases::Case& c) {
  const double motion_s = cases::motion_end_s(c);
  const auto step = [&](double t_s) { return std::llround(t_s / c.dem.timestep_s); };
  if (c.end_s > 0) return {step(c.end_s), std::nullopt};
  if (c.machine.drives != machine::DriveMode::limited) return {step(motion_s), std::nullopt};
  constexpr double kLongest = 2;  // of the motion's time: a cycle that takes longer has gone wrong
  constexpr double kEarly_s = 1e-6;  // a path that was never slowed ends with the motion
  return {step(kLongest * motion_s), motion_s - kEarly_s};
}

bool is_done(const RunEnd& end, std::int64_t dem_step, const fs::path& record) {
  return dem_step >= end.step ||
         (end.path_s && record::read_channel(record, "machine/path_time").back() >= *end.path_s);
}

void end_with_path(Stepper& stepper, const RunEnd& end, const core::ServerInfo& machine) {
  if (!end.path_s) return;
  const std::size_t path = core::channel_index(machine, "path_time");
  stepper.end_when([path, end_s = *end.path_s](const core::MachineState& state) {
    return state.channels[path] >= end_s;
  });
}

std::map<std::string, std::string> record_attributes(const cases::Case& c,
                                                     const core::ServerInfo& machine,
                                                     const core::ServerInfo& rock) {
  return {{"case", c.text},
          {"case_folder", c.folder.string()},
          {"case_hash", cases::case_hash(c)},
          {"version", version()},
          {"machine_version", machine.version},
          {"rock_version", rock.version}};
}

void write_scales(const result::RunFolder& folder, const setup::RockSetup& rock,
                  double struck_volume_m3) {
  const nlohmann::json kept = {{"scales", to_json(rock).at("scales")},
                               {"struck_volume_m3", struck_volume_m3}};
  write_text(folder.scales(), kept.dump() + "\n");
}

sides::SidesSetup prepare(const cases::Case& c, const result::RunFolder& folder,
                          const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
                          Reporter& reporter) {
  folder.unseal();
  const sides::MeshFacts shovel = sides::read_mesh_facts(c);
  const sides::DipperLayers layers = c.machine.kind == cases::MachineKind::shovel
                                         ? sides::dipper_layers(c, shovel.dipper.cavity)
                                         : sides::DipperLayers{};
  write_decks(c, layers, folder.deck());
  write_identity(folder.root(), c);

  const RunEnd end = run_end(c);
  const std::int64_t steps = end.step;
  reporter.line(fmt::format("{}: {}{:.2f} s, {} windows of {} steps, {} rank{}", c.name,
                            end.path_s ? "at most " : "",
                            static_cast<double>(steps) * c.dem.timestep_s,
                            (steps + c.coupling.sync_steps - 1) / c.coupling.sync_steps,
                            c.coupling.sync_steps, c.dem.ranks, c.dem.ranks == 1 ? "" : "s"));
  if (from) {
    reporter.line(fmt::format("continuing from t = {:.3f} s",
                              static_cast<double>(from->coupling.dem_step) * c.dem.timestep_s));
    result::drop_frames_after(folder.dumps(), from->coupling.dem_step);
    result::index_dumps(folder.dumps(), c.dem.timestep_s);
  }
  const fs::path restart = from ? from->rock() : find_pile(c, folder, places, reporter);

  sides::SidesSetup setup;
  setup.run_id = folder.root().filename().string();
  setup.case_hash = cases::case_hash(c);
  setup.places = places;
  setup.timeout_s = c.coupling.timeout_s;
  setup.logs = folder.logs();
  setup.checkpoints = folder.checkpoints();
  setup.dem_screen = folder.logs() / "dem.screen";
  if (from) setup.segment = fmt::format("-{}", from->coupling.step_index);
  setup.message_log = folder.root() / ("events" + setup.segment + ".lcmlog");
  setup.rock = sides::rock_setup(c, shovel, folder.deck(), folder.dumps(), folder.logs(), restart,
                                 from ? std::optional(wall_memory(from->coupling)) : std::nullopt);
  write_scales(folder, setup.rock, shovel.dipper.struck_volume_m3);
  setup.machine = sides::machine_setup(c, layers);
  return setup;
}

}  // namespace dipper::run

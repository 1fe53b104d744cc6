#include "coupler/run/preparation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/mesh/stl.hpp"
#include "common/record/record.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/operate/operated_machine.hpp"
#include "coupler/result/dump_index.hpp"
#include "coupler/run/pass_desk.hpp"
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
    fs::create_directories(deck / "lining");
    as_built.bodies["dipper"] = deck / "lining" / "dipper.stl";  // not what the pile depends on
    write_text(as_built.bodies["dipper"], mesh::to_stl("dipper", *layers.mesh));
  }
  deck::write_deck(as_built, c.rock.shape_folder, deck);
}

fs::path find_pile(const cases::Case& c, const result::RunFolder& folder,
                   const launch::MpiPlaces& places, Reporter& reporter) {
  const Pile pile = settled_pile(c, folder.deck(), folder.logs(), places, reporter);
  reporter.line(pile.cached ? "pile: from the cache"
                            : fmt::format("pile: settled in {:.0f} s", pile.wall_s));
  return pile.restart;
}

std::vector<setup::WallMemory> wall_memory(const core::CouplingState& state) {
  std::vector<setup::WallMemory> memory;
  for (const core::WallState& wall : state.walls) memory.push_back({wall.load, wall.V_WB_W});
  return memory;
}

}  // namespace

RunEnd run_end(const cases::Case& c, bool program_drives) {
  const double motion_s = cases::motion_end_s(c);
  const auto step = [&](double t_s) { return std::llround(t_s / c.dem.timestep_s); };
  if (c.end_s > 0) return {step(c.end_s), std::nullopt, program_drives};
  constexpr double kLongest = 2;  // times the motion's duration: a run that takes longer has failed
  constexpr double kCycle =
      2;  // times the motion's duration: the return, which a planned motion does not contain
  if (c.machine.operated_by == cases::OperatorKind::plan && !program_drives)
    return {step(kLongest * kCycle * motion_s * c.op.passes), std::nullopt};
  if (c.machine.drives != machine::DriveMode::limited) return {step(motion_s), std::nullopt};
  constexpr double kEarly_s = 1e-6;  // a motion that was never slowed ends the run
  if (program_drives) return {step(kLongest * motion_s), std::nullopt, true};
  return {step(kLongest * motion_s), motion_s - kEarly_s};
}

bool is_done(const RunEnd& end, const Checkpoint& last, const fs::path& record) {
  return last.coupling.dem_step >= end.step || is_finished(last.desk) ||
         (end.program_drives && operate::had_done(last.machine())) ||
         (end.path_s && record::read_channel(record, "machine/path_time").back() >= *end.path_s);
}

void end_with_path(Stepper& stepper, const RunEnd& end, const core::ServerInfo& machine) {
  if (!end.path_s) return;
  const std::size_t path = core::channel_index(machine, "path_time");
  stepper.end_when([path, end_s = *end.path_s](const core::MachineState& state) {
    return state.channels[path] >= end_s;
  });
}

std::map<std::string, std::string> record_attributes(
    const cases::Case& c, const core::ServerInfo& machine, const core::ServerInfo& rock,
    const std::optional<operate::Program>& program) {
  std::map<std::string, std::string> all = {{"case", c.text},
                                            {"case_folder", c.folder.string()},
                                            {"case_hash", cases::case_hash(c)},
                                            {"version", version()},
                                            {"machine_version", machine.version},
                                            {"rock_version", rock.version}};
  if (program) all["operator"] = program->command;
  return all;
}

void write_scales(const result::RunFolder& folder, const setup::RockSetup& rock,
                  const cases::DipperFacts& dipper) {
  nlohmann::json kept = {{"scales", to_json(rock).at("scales")},
                         {"struck_volume_m3", dipper.struck_volume_m3}};
  if (dipper.struck_volume_m3 > 0) kept["lip_x_m"] = dipper.cavity.max_m.x();
  write_text(folder.scales(), kept.dump() + "\n");
}

sides::SidesSetup prepare(const cases::Case& c, const result::RunFolder& folder,
                          const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
                          bool program_drives, Reporter& reporter) {
  folder.unseal();
  const sides::MeshFacts shovel = sides::read_mesh_facts(c);
  const sides::DipperLayers layers = c.machine.kind == cases::MachineKind::shovel
                                         ? sides::dipper_layers(c, shovel.dipper.cavity)
                                         : sides::DipperLayers{};
  write_decks(c, layers, folder.deck());
  write_identity(folder.root(), c);

  const RunEnd end = run_end(c, program_drives);
  const std::int64_t steps = end.step;
  const bool end_by_operator = program_drives || c.machine.operated_by == cases::OperatorKind::plan;
  const double end_s = static_cast<double>(steps) * c.dem.timestep_s;
  const bool open_end = end.path_s || (c.end_s == 0 && end_by_operator);
  const std::string duration =
      open_end ? fmt::format("ends when the {} is done, or at {:.2f} s at the latest",
                             end_by_operator ? "operator" : "motion", end_s)
               : fmt::format("{:.2f} s", end_s);
  reporter.line(fmt::format("{}: {}; {} DEM steps per sync step, {} rank{}", c.name, duration,
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
  write_scales(folder, setup.rock, shovel.dipper);
  setup.machine = sides::machine_setup(c, layers, program_drives);
  return setup;
}

operate::Operated operated(const cases::Case& c, const operate::Program& program,
                           const result::RunFolder& folder, const std::string& segment) {
  operate::Operated o;
  o.case_name = c.name;
  o.motion = c.machine.motion;
  o.machine = machine::load_machine(c.machine.model);
  o.rake = radians(c.machine.rake_angle_deg);
  o.program = program;
  o.patience = std::chrono::milliseconds(std::llround(1e3 * c.coupling.timeout_s));
  o.log = fs::absolute(folder.logs() / ("operator" + segment + ".log"));
  return o;
}

void require_operable(const cases::Case& c) {
  const auto refuse = [&](const char* key, const char* why) {
    throw InputError({cases::finding_at(c, key, why)});
  };
  if (c.machine.kind != cases::MachineKind::shovel)
    refuse("machine.kind", "--operator drives a shovel; a case of poses has no drives");
  if (c.machine.drives != machine::DriveMode::limited)
    refuse("machine.drives",
           "prescribed drives follow the motion regardless of force; with --operator write "
           "limited");
  if (!c.machine.contact_on_return)
    refuse("machine.contact_on_return",
           "off applies to the motion of motion.csv, which --operator does not follow; write on");
}

}  // namespace dipper::run

// Before a run starts: its deck, its pile, and the input of both sides.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/operate/operated_machine.hpp"
#include "coupler/result/run_folder.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/stepper.hpp"
#include "coupler/sides/sides.hpp"

namespace dipper::run {

/// When a run ends.
struct RunEnd {
  std::int64_t step = 0;  ///< DEM steps, at most
  /// Also ends when the machine's channel path_time reaches this [s]: limited drives reach the end
  /// of the motion when they can.
  std::optional<double> path_s;
  bool program_drives = false;  ///< a program drives, and may end the run
};

/// The end of a run by end_s. Where that is 0: prescribed drives end with the motion; limited
/// drives when they reach its end, after twice its duration at most; so does a run that a program
/// drives (`program_drives`), which the program can end earlier. A planning operator ends the run
/// (pass_desk.hpp), after four times the motion's duration for each of the passes at most.
/// Throws InputError for a motion that cannot be read.
RunEnd run_end(const cases::Case& c, bool program_drives = false);

/// Whether a run whose last checkpoint is `last` has reached its end. Throws std::runtime_error
/// naming the record.
bool is_done(const RunEnd& end, const Checkpoint& last, const std::filesystem::path& record);

/// Ends the stepper at the end of the machine's motion, where the run's end depends on it.
void end_with_path(Stepper& stepper, const RunEnd& end, const core::ServerInfo& machine);

/// The attributes of record.h5.
std::map<std::string, std::string> record_attributes(
    const cases::Case& c, const core::ServerInfo& machine, const core::ServerInfo& rock,
    const std::optional<operate::Program>& program);

/// Writes scales.json from dipper-dem's input, without the run's secret, which dem.json contains;
/// and, of a shovel, its dipper's struck volume and where its lip is, which its meshes alone do not
/// give. Throws std::runtime_error naming the file.
void write_scales(const result::RunFolder& folder, const setup::RockSetup& rock,
                  const cases::DipperFacts& dipper);

/// Writes deck and identity into the run's folder, finds the pile in the cache or settles it, and
/// reports this. \param from  the checkpoint of a resumed run; none: a new run. \param places
/// hosts of the ranks. \param program_drives  a program drives the machine. Throws as settled_pile
/// does, also launch::Interrupted.
sides::SidesSetup prepare(const cases::Case& c, const result::RunFolder& folder,
                          const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
                          bool program_drives, Reporter& reporter);

/// What a program needs to drive the machine of a run. \param segment  of the run, for the name of
/// its log
operate::Operated operated(const cases::Case& c, const operate::Program& program,
                           const result::RunFolder& folder, const std::string& segment);

/// Throws InputError for a case that a program cannot drive.
void require_operable(const cases::Case& c);

}  // namespace dipper::run

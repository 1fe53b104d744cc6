// Before a run: its deck, its pile, and what both sides are told.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/operate/operated_machine.hpp"
#include "coupler/result/run_folder.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/stepper.hpp"
#include "coupler/sides/sides.hpp"

namespace dipper::run {

/// When a run is done.
struct RunEnd {
  std::int64_t step = 0;  ///< DEM steps, at the latest
  /// Or as soon as the machine's channel path_time is there [s]: limited drives, which come to the
  /// motion's end when they can.
  std::optional<double> path_s;
  bool told = false;  ///< a program drives, and may end it
};

/// Of end_s; where it is 0, prescribed drives end with the motion, and limited ones when they have
/// come to its end, or have not in twice its time; driven by a program (`told`), in that time at
/// the latest. An operator who plans ends his run himself (pass_desk.hpp), at the latest after four
/// times the motion's time for each of his passes. Throws InputError for a motion that cannot be
/// read.
RunEnd run_end(const cases::Case& c, bool told = false);

/// Whether a run whose record stands at its last checkpoint is done. Throws std::runtime_error
/// naming the record.
bool is_done(const RunEnd& end, const Checkpoint& last, const std::filesystem::path& record);

/// Lets a stepper end when the machine's path does, where the end asks for that.
void end_with_path(Stepper& stepper, const RunEnd& end, const core::ServerInfo& machine);

/// What record.h5 says of its run.
std::map<std::string, std::string> record_attributes(
    const cases::Case& c, const core::ServerInfo& machine, const core::ServerInfo& rock,
    const std::optional<operate::Program>& program);

/// Writes scales.json of dipper-dem's set-up: for those who may not read the run's secret, which
/// is beside the settings. With it what the dipper holds, which its meshes alone do not tell.
/// Throws std::runtime_error naming the file.
void write_scales(const result::RunFolder& folder, const setup::RockSetup& rock,
                  double struck_volume_m3);

/// Writes deck and identity into the run's folder, settles the pile or finds it in the cache, and
/// says so. \param from  what the run goes on from; nothing: a new run. \param places  of the
/// ranks. \param told  a program drives. Throws what settled_pile throws, launch::Interrupted too.
sides::SidesSetup prepare(const cases::Case& c, const result::RunFolder& folder,
                          const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
                          bool told, Reporter& reporter);

/// What is needed of a run to have a program drive its machine. \param segment  of the run, for the
/// name of its log
operate::Operated operated(const cases::Case& c, const operate::Program& program,
                           const result::RunFolder& folder, const std::string& segment);

/// Refuses a case that a program cannot drive. Throws InputError.
void require_operable(const cases::Case& c);

}  // namespace dipper::run

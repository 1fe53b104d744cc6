// A run's folder as `dipper run` left it, or what a user gives beside a folder of dumps.
#pragma once

#include <map>
#include <nlohmann/json.hpp>

#include "analysis/io/dump_folder.hpp"
#include "analysis/rock/zones.hpp"
#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/passes.hpp"
#include "common/case_lines.hpp"
#include "common/finding.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::run {

/// The record's channels that metrics are made from; one value a row.
struct RunSignals {
  signals::PassSignals pass;
  signals::DriveSignals drive;
  std::vector<double> rock_work_J;               ///< the rock's on the walls, from the start
  std::vector<double> weight_N;                  ///< down, of the rock on dipper and door together
  std::vector<double> rock_kg;                   ///< all there is
  std::map<std::string, rock::PoseTrack> walls;  ///< bodies' poses as the rock met them, by name
};

/// What is known besides the dumps.
struct RunData {
  std::filesystem::path folder;
  bool is_run = false;     ///< of Dipper: there is a record
  bool is_shovel = false;  ///< and its machine a shovel, with drives and passes
  std::string case_text;   ///< case.txt
  CaseLines case_lines;    ///< the keys in it
  nlohmann::json summary;  ///< of summary.json; null: the run has not ended
  std::string case_hash, rock_version, machine_version, version;
  RunSignals signals;
  std::vector<std::string> masses;  ///< names of the channels with rock weighed in a region [kg]
  rock::ClumpMasses clumps;
  rock::LoadRegions regions;
  rock::PoseTrack dipper;                            ///< empty: not known
  std::map<std::string, mesh::TriangleMesh> meshes;  ///< in their own frames: dipper, door, truck
  mesh::TriangleMesh vessel;                         ///< dipper with its door shut, in B
  double struck_given_m3 = 0;                        ///< by the file beside the mesh; 0: not known
  double bulk_density_kg_m3 = 0;  ///< of the settled pile, from the case; 0: not known

  /// A number of the case: throws InputError naming a key that it lacks. Or a text without its
  /// quotes, "" for a key that it lacks.
  double number(const std::string& key) const;
  Vector3d vector(const std::string& key) const;
  std::string text(const std::string& key) const;
};

/// What a user says of dumps that are no run's.
struct ForeignDipper {
  std::filesystem::path mesh;   ///< STL in B
  std::filesystem::path poses;  ///< CSV: time_s,x_m,y_m,z_m,qw,qx,qy,qz
};

/// Reads a run's folder. Throws InputError naming file and line.
RunData read_run_folder(const std::filesystem::path& folder);

/// Of a folder without a record. Throws InputError, also for a mesh that does not enclose a volume.
RunData read_foreign_folder(const std::filesystem::path& folder,
                            const std::optional<ForeignDipper>& dipper);

/// Poses from a CSV file with a header line. Throws InputError naming file and line.
rock::PoseTrack read_poses(const std::filesystem::path& file);

/// Of a run that was killed or is running: drops the frames that its record has not come to yet.
void keep_recorded(const RunData& run, io::DumpFolder& dumps);

/// Whether these dumps are of this run: the box is the case's domain, types are the case's classes,
/// all rock weighs what the record says, walls are where the record has them. Throws InputError
/// naming file and line.
void check_dumps_are_of(const RunData& run, const io::DumpFolder& dumps);

/// Whether a dipper that a user gives is among the rock of the dumps: its poses cover the frames,
/// its mesh is not far larger than their box, nor is it far from the rock. Throws InputError naming
/// the file; warns of a mesh longer than all the rock.
std::vector<Finding> check_dipper_is_among(const RunData& run, const io::DumpFolder& dumps,
                                           const ForeignDipper& given);

/// What a record has of its bodies and its rock, whatever the machine: rock_work_J, rock_kg, walls,
/// and time_s in `pass`. Throws InputError.
RunSignals read_body_signals(const std::filesystem::path& record,
                             const std::vector<std::string>& bodies);

/// The channels of record.h5, cut to the shortest: a run may be writing it. Throws InputError.
RunSignals read_signals(const std::filesystem::path& record);

/// Of them `pass` and `drive` alone, as many rows as there are, for a record of whatever else it
/// holds. Throws std::runtime_error naming file and dataset.
RunSignals read_drive_signals(const std::filesystem::path& record);

/// A closed, sound mesh: throws InputError naming the file and the first facet that is wrong.
mesh::TriangleMesh read_sound_mesh(const std::filesystem::path& file);

}  // namespace dipper::analysis::run

// The planning operator's part of a run: between two passes the operator surveys the rock, chooses
// a dig, and sends its motion to the machine.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/observer.hpp"
#include "machine/face_scan.hpp"
#include "machine/pass_choice.hpp"

namespace dipper::run {

/// Plans a pass when the one before is done, both sides at rest: the rock's surface as a scanner
/// sees it, the best dig (machine/pass_choice.hpp), its rows to the machine. The run ends when the
/// truck is full, when no pass pays, or after operator.passes.
///
/// Each decision is in operator/pass_N.json of the run's folder: the face as seen, every dig that
/// was evaluated, the chosen one and why.
class PassDesk final : public Observer {
 public:
  struct Sides {
    core::Machine& machine;
    core::Rock& rock;
    core::ServerInfo machine_info, rock_info;
  };

  /// \param folder  of the decisions
  /// \param state  as `state` gave it, of the checkpoint that a run goes on from; null: a new
  /// run. Decisions in the folder that were made after the checkpoint are removed.
  PassDesk(const cases::Case& c, const Sides& sides, std::filesystem::path folder,
           const nlohmann::json& state, Reporter& reporter);

  bool needs_rest(const core::Window& w) const override;
  void window(const core::Window& w) override;

  /// Whether the last pass is done and no other follows.
  bool finished() const { return finished_; }

  int passes() const { return passes_; }  ///< planned so far
  /// When the last pass will be done, on the motion: as many as the truck or operator.passes allow,
  /// each as long as those before, s.
  double expected_end_s() const;

  /// What a checkpoint keeps of it.
  nlohmann::json state() const;

 private:
  void forget_later() const;
  double along_s(const core::Window& w) const;
  std::string reason_to_stop(double truck_kg) const;
  void plan(const core::Window& w);
  void feel(const core::Window& w);
  void learn(double loaded_kg);
  void write(const core::Window& w, const HeightMap& seen, const machine::DigDecision& decision,
             double begins_s, double truck_kg) const;
  void stop(const core::Window& w, const std::string& why, double truck_kg);

  const cases::Case& case_;
  Sides sides_;
  std::filesystem::path folder_;
  Reporter& reporter_;
  machine::DigPlanner planner_;
  Vector3d eye_W_;
  machine::Vector2d start_tip_ = machine::Vector2d::Zero();
  double start_heading_rad_ = 0;
  std::optional<std::size_t> path_time_;
  std::size_t crowd_force_;
  std::size_t truck_;
  // What a checkpoint keeps.
  int passes_ = 0;        ///< planned
  double end_s_ = 0;      ///< of the motion that the machine has
  double truck_kg_ = 0;   ///< when the last pass was planned
  double loaded_kg_ = 0;  ///< by the passes before
  bool finished_ = false;
  /// Of the pass that is on: what was expected, and what has shown.
  struct Pass {
    double rock_from_s = 0, rock_to_s = 0;  ///< of the motion: while the teeth are in rock
    double crowd_N = 0, payload_kg = 0;     ///< expected: mean crowd force in rock, payload
    double along_s = 0;                     ///< of the motion, the last window's end
    double crowd_sum = 0, sum_s = 0;        ///< of force by the motion's time in rock
  } pass_;
  machine::DigExperience before_;
};

/// Whether a desk was finished, by what a checkpoint keeps of it.
bool is_finished(const nlohmann::json& desk_state);

}  // namespace dipper::run

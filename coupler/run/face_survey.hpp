// Surveys of the face during a run: from above, before the first pass and at every dump.
#pragma once

#include <cstdint>
#include <filesystem>

#include "coupler/case/case.hpp"
#include "coupler/run/observer.hpp"

namespace dipper::run {

/// Samples the rock surface when a new run starts and whenever the door opens, with both sides at
/// rest: the face that a pass leaves is the face that the next one finds. Writes faces/face_K.json,
/// K from 0, in the run's folder: a height map (common/height_map.hpp) with `t_s` and the swing
/// axis `axis_m` (x, y in W). Does not change the run.
class FaceSurvey final : public Observer {
 public:
  struct Sides {
    core::Rock& rock;
    core::ServerInfo machine_info;
  };

  /// \param resumed  the machine at the checkpoint of a resumed run, whose later faces are removed.
  /// Null: a new run.
  FaceSurvey(const cases::Case& c, const Sides& sides, std::filesystem::path folder,
             const core::MachineState* resumed);

  bool needs_rest(const core::Window& w) const override;
  void window(const core::Window& w) override;

 private:
  bool is_open(const core::MachineState& machine) const;
  void look(std::int64_t t_ns);

  Sides sides_;
  std::filesystem::path folder_;
  HeightGrid grid_;
  double axis_x_m_, axis_y_m_;
  std::size_t door_;
  bool was_open_ = false;
  int faces_ = 0;
};

}  // namespace dipper::run

#include "coupler/run/face_survey.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "common/json_text.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/result/surveyed_faces.hpp"
#include "machine/door.hpp"

namespace dipper::run {
namespace {

constexpr double kBeforeToe_m = 4.0;  // loose rock lies up to this far in front of the toe

HeightGrid bench_grid(const cases::Case& c) {
  const deck::PileShape pile = deck::pile_shape(c);
  const double half = c.pile.width_m / 2;
  return face_grid(pile.toe_x_m - kBeforeToe_m, pile.rear_x_m, -half, half);
}

}  // namespace

FaceSurvey::FaceSurvey(const cases::Case& c, const Sides& sides, std::filesystem::path folder,
                       const core::MachineState* resumed)
    : sides_(sides),
      folder_(std::move(folder)),
      grid_(bench_grid(c)),
      axis_x_m_(c.machine.base_position_m.x()),
      axis_y_m_(c.machine.base_position_m.y()),
      door_(core::channel_index(sides.machine_info, "door")) {
  if (resumed == nullptr) return;
  was_open_ = is_open(*resumed);
  faces_ = result::keep_faces_until(folder_, seconds(resumed->t_ns));
}

bool FaceSurvey::is_open(const core::MachineState& machine) const {
  return machine::door_is_open(machine.channels[door_]);
}

bool FaceSurvey::needs_rest(const core::Window& w) const {
  return is_open(w.machine) && !was_open_;
}

void FaceSurvey::window(const core::Window& w) {
  if (w.step_index == 0 || needs_rest(w)) look(w.rock.t_ns);
  was_open_ = is_open(w.machine);
}

void FaceSurvey::look(std::int64_t t_ns) {
  nlohmann::json j = parse_json(to_json_text(sides_.rock.look(grid_)));
  j["t_s"] = seconds(t_ns);
  j["axis_m"] = {axis_x_m_, axis_y_m_};
  std::filesystem::create_directories(folder_);
  write_text(result::face_file(folder_, faces_++), j.dump() + '\n');
}

}  // namespace dipper::run

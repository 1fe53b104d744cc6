// What a machine's own instruments show.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"
#include "machine/handle_statics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::operate {

/// The drives in the order of an order (core::Order), with the words of the lines.
struct DriveWords {
  const char* channel;  ///< of the machine's, and of the lines' keys
  const char* unit;     ///< of its position: "m" or "rad"
  double machine::Drives::*drive;
};
constexpr std::size_t kDrives = 4;
constexpr std::array<DriveWords, kDrives> kDriveWords = {{{"hoist", "m", &machine::Drives::hoist},
                                                          {"crowd", "m", &machine::Drives::crowd},
                                                          {"swing", "rad", &machine::Drives::swing},
                                                          {"door", "rad", &machine::Drives::door}}};

/// "hoist_m", and the rate's "hoist_m_s".
std::string position_key(const DriveWords& drive);
std::string rate_key(const DriveWords& drive);

/// Watches the machine from window to window. The load is the machine's own estimate
/// (machine/handle_statics.hpp), the mean of a window's ends since the last look; the pass is
/// counted by the door, which ends one as it shuts; not where it has been open from the start.
class Instruments {
 public:
  /// Throws std::invalid_argument for a machine that no program drives.
  Instruments(const core::ServerInfo& info, const machine::MachineData& machine, double rake);

  /// A window has ended.
  void see(const core::MachineState& state);

  /// The keys of a look, of the state that was seen last or that the machine began in.
  nlohmann::ordered_json show(const core::MachineState& state) const;

  /// Begins the means of the next look.
  void looked();

  /// Where the drives are sent.
  machine::Drives sent(const core::MachineState& state) const;

  /// All of it, for a checkpoint, and back. Throws nlohmann::json::exception.
  nlohmann::json memory() const;
  void remember(const nlohmann::json& memory);

 private:
  double channel(const core::MachineState& state, const std::string& name) const;
  machine::Drives drives(const core::MachineState& state, const std::string& before) const;
  /// NaN where the ropes have no path.
  double load_kg(const core::MachineState& state) const;

  core::ServerInfo info_;
  machine::HandleStatics statics_;
  int pass_ = 1;
  bool was_shut_ = false, dumps_ = false;  ///< the door: since the start; open, having been shut
  double load_sum_kg_ = 0;
  int loads_ = 0;
};

}  // namespace dipper::operate

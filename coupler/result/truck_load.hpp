// What the passes make of a truck: how many fill it, and whether it is under- or overloaded.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace dipper::result {

/// Masses in t. Only passes that were dumped count.
struct TruckLoad {
  double rated_t = 0;
  int passes = 0;     ///< dumped in the run
  double load_t = 0;  ///< in the truck after them
  double mean_pass_t = 0;
  int passes_to_fill = 0;  ///< whose load is nearest to the rated one
  /// The load after them: the run's own passes, and the mean one for each beyond them.
  double filled_t = 0;
};

/// Of summary.json's passes; none without a rated load (0), without a pass that was dumped, or
/// where the truck gained nothing.
std::optional<TruckLoad> truck_load(double rated_t, const nlohmann::ordered_json& passes);

/// Why there is none although a load is rated: no passes, or nothing gained; "" where no pass was
/// dumped, which is warned of by itself.
std::string no_truck_load(double rated_t, const nlohmann::ordered_json& passes);

/// Keys of docs/results.md, with the loads as fractions of the rated one, too.
nlohmann::ordered_json as_json(const TruckLoad& load);

/// "3 passes fill it: 236 t, 7 % over its rated 220 t".
std::string to_text(const TruckLoad& load);

/// What to warn of: a load beyond 110 % of the rated one, and beyond 120 %, which no load is to
/// reach (the 10/10/20 rule: Caterpillar, Cat Mining Trucks Payload Management Guidelines,
/// AEXQ0250-02, 2011). Empty: within it.
std::string overload_warning(const TruckLoad& load);

}  // namespace dipper::result

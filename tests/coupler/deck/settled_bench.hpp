// A bench from a deck, by the plain LIGGGHTS binary.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/coupler/deck/liggghts_run.hpp"

namespace dipper::deck {

/// Settles the bench of folder/deck, relaxed for `relax_s`. Returns the folder of its dump.
inline std::filesystem::path settled_bench(const std::filesystem::path& folder, double relax_s) {
  const auto out = folder / fmt::format("relax{:g}", relax_s);
  std::filesystem::create_directories(out);
  const std::string deck = "-var deck '" + (folder / "deck").string() + "' ";
  EXPECT_EQ(
      run_liggghts("dem_in/settle.in", deck + fmt::format("-var relax_time {}", relax_s), 1, out),
      0)
      << read_text(out / "screen.txt");
  EXPECT_EQ(run_liggghts("dem_in/dig.in",
                         deck + "-var run_steps 1 -var dump_steps 1 -var pile '" +
                             (out / "pile.restart").string() + "'",
                         1, out),
            0)
      << read_text(out / "screen.txt");
  return out;
}

}  // namespace dipper::deck

#include "coupler/run/pile.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "common/cache_entry.hpp"
#include "common/cache_folder.hpp"
#include "common/case_lines.hpp"
#include "common/installation.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/deck/bench_cut.hpp"
#include "coupler/deck/brick.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/run/pile_program.hpp"
#include "coupler/setup/placed_rocks.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPileFile = "pile.restart";
constexpr const char* kBrickFile = "brick.csv";
constexpr int kBrickRanks = 2;  // each rank's part of a brick must be larger than the largest rock

std::vector<fs::path> scripts(const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(data_folder() / "dem_in" / name);
  return files;
}

/// Input of the cache key: the case's keys that affect settling, the deck that settles the pile,
/// the files that the deck includes, and the version of the program that runs it.
std::string pile_hash(const PilePrograms& programs, const fs::path& deck) {
  const cases::Case& c = programs.c;
  const bool bricks = c.pile.built == cases::PileBuilt::bricks;
  std::string all = fmt::format("{}, bench-cut {}\n", programs.settler(), deck::kBenchCutVersion);
  if (bricks) all += fmt::format("brick {}\n", deck::kBrickVersion);
  for (const CaseLine& line : CaseLines(c.text)) {
    const cases::KeySpec& spec = *cases::spec_of(line.key);
    // Paths are left out: the contents of spheres, outline and surface are hashed below. The
    // settler's version includes the time loop.
    // Poured piles keep the key that they had before bricks existed.
    const bool said =
        cases::is_path(spec) || line.key == "dem.loop" || (line.key == "pile.built" && !bricks);
    if (spec.affects == cases::Affects::settling && !said)
      all += line.key + '=' + line.value + '\n';
  }
  return deck_hash(
      all,
      bricks ? scripts({"place.in", "brick.in", "relax.in", "contact.in", "check_lost.in"})
             : scripts({"settle.in", "contact.in", "check_pour.in", "check_lost.in"}),
      deck);
}

/// The cached file with the rocks of the case's brick; settles the brick when it is missing.
fs::path settled_brick(const PilePrograms& programs,
                       const std::map<std::string, deck::RockShape>& shapes, const fs::path& deck) {
  const cases::Case& c = programs.c;
  const deck::BrickShape shape = deck::brick_shape(c);
  const int ranks = std::min(c.dem.ranks, kBrickRanks);
  deck::write_brick_deck(c, shapes, deck);
  std::vector<fs::path> files = scripts({"place.in", "brick.in", "contact.in", "check_lost.in"});
  files.push_back(deck / "case.in");  // a brick's deck has no other settings
  const fs::path entry = cache_folder() / "bricks" /
                         deck_hash(fmt::format("{}, brick {}, {} ranks\n", programs.settler(),
                                               deck::kBrickVersion, ranks),
                                   files, deck);
  const auto settle = [&](const fs::path& out) {
    const PileLinks links(out, deck);
    setup::write_placed_rocks(out / "loose.csv",
                              deck::loose_brick(deck::rock_kinds(c, shapes), shape));
    programs.place(out, {"put", "loose.csv", "loose.restart"}, "loose.restart", {"edges", "p"});
    programs.settle(out, "brick", ranks, "brick.restart", {"start", "loose.restart"});
    programs.place(out, {"get", kBrickFile}, kBrickFile,
                   {"edges", "p", "filled", "1", "restart", "brick.restart"});
    for (const char* name : {"loose.csv", "loose.restart", "brick.restart"}) fs::remove(out / name);
  };
  make_once(entry, settle, heed_interrupts);
  return entry / kBrickFile;
}

/// Builds the pile from the brick and lets it relax, in `out`.
void relax_bricks(const PilePrograms& programs, const fs::path& deck, const fs::path& out) {
  const cases::Case& c = programs.c;
  const auto shapes = deck::used_shapes(c, c.rock.shape_folder);
  const fs::path brick = settled_brick(programs, shapes, deck / "brick");
  const deck::BrickShape shape = deck::brick_shape(c);
  const cases::BenchOutline outline = deck::bench_outline(c);
  const auto height = [&](double x, double y) {
    return c.pile.surface ? c.pile.surface->height(x, y) : cases::outline_height(outline, x);
  };
  setup::write_placed_rocks(
      out / "laid.csv",
      deck::laid_bench(setup::read_placed_rocks(brick), deck::rock_kinds(c, shapes), shape,
                       deck::brick_lay(c.seed, shape), c, height));
  programs.place(out, {"put", "laid.csv", "laid.restart"}, "laid.restart", {});
  programs.settle(out, "relax", c.dem.ranks, kPileFile,
                  {"start", "laid.restart", "out", ".", "bench_cut", "./bench-cut"});
  for (const char* name : {"laid.csv", "laid.restart"}) fs::remove(out / name);
}

}  // namespace

Pile settled_pile(const cases::Case& c, const fs::path& deck, const fs::path& logs,
                  const launch::MpiPlaces& places, Reporter& reporter) {
  const PilePrograms programs{c, logs, places, reporter};
  const fs::path entry = cache_folder() / "piles" / pile_hash(programs, deck);
  const auto began = std::chrono::steady_clock::now();
  const auto settle = [&](const fs::path& out) {
    reporter.line("pile: not in the cache; it is settled first, and kept there");
    const PileLinks links(out, deck);
    if (c.pile.built == cases::PileBuilt::bricks) return relax_bricks(programs, deck, out);
    programs.settle(out, "settle", c.dem.ranks, kPileFile,
                    {"out", ".", "bench_cut", "./bench-cut"});
  };
  const auto wait = [&] {
    heed_interrupts();
    reporter.progress("pile: waits for another run that settles it");
  };
  const bool settled = make_once(entry, settle, wait);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  return {entry / kPileFile, !settled, settled ? took.count() : 0};
}

}  // namespace dipper::run

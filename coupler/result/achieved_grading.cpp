#include "coupler/result/achieved_grading.hpp"

#include <fmt/format.h>

#include <set>

#include "coupler/deck/contact_table.hpp"
#include "coupler/result/first_dump.hpp"

namespace dipper::result {
namespace fs = std::filesystem;

std::vector<AchievedClass> achieved_grading(const cases::Case& c, const fs::path& dumps) {
  const std::vector<deck::RockClass> rocks = deck::rock_classes(c);
  std::vector<AchievedClass> out;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const cases::SizeClass& s = c.rock.classes[i];
    out.push_back({s.name, 2 * rocks[i].radius_m, 0, 0, s.mass_percent});
  }
  const fs::path file = first_dump(dumps);
  if (file.empty()) return out;
  const analysis::io::DumpReader reader({file});
  std::set<long> seen;
  analysis::io::DumpReader::read(reader.frames().front(), {"type", "id_multisphere"},
                                 [&](const analysis::io::ParticleChunk& chunk) {
                                   for (std::size_t i = 0; i < chunk.rows; ++i) {
                                     const auto type =
                                         static_cast<std::size_t>(chunk.columns[0][i]);
                                     const long body = static_cast<long>(chunk.columns[1][i]);
                                     if (type < 1 || type > out.size()) continue;
                                     if (body < 0 || seen.insert(body).second)
                                       ++out[type - 1].rocks;
                                   }
                                 });
  double mass = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    mass += static_cast<double>(out[i].rocks) * rocks[i].mass_kg;
  if (mass > 0)
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i].mass_percent = 100 * static_cast<double>(out[i].rocks) * rocks[i].mass_kg / mass;
  return out;
}

std::string to_csv(const std::vector<AchievedClass>& classes) {
  std::string out = "class,size_m,rocks,mass_percent,wanted_percent\n";
  for (const AchievedClass& k : classes)
    out += fmt::format("{},{:.6g},{},{:.2f},{:.2f}\n", k.name, k.size_m, k.rocks, k.mass_percent,
                       k.wanted_percent);
  return out;
}

}  // namespace dipper::result

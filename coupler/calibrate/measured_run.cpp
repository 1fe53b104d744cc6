#include "coupler/calibrate/measured_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "common/text_file.hpp"

namespace dipper::calibrate {
namespace {

std::string words_of(const std::vector<std::pair<std::string, double>>& parameters) {
  std::string out;
  for (const auto& [key, value] : parameters) out += fmt::format("{}={:.6g} ", key, value);
  return out;
}

}  // namespace

std::vector<MeasuredRun> make_runs(const std::vector<PlannedRun>& plan, int jobs,
                                   Reporter& reporter, const Measure& measure) {
  std::vector<DeckRun> decks;
  for (const PlannedRun& p : plan) decks.push_back(p.run);
  std::vector<MeasuredRun> out(plan.size());
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  std::size_t done = 0, made = 0;
  run_decks(decks, jobs, reporter, [&](std::size_t i, const DeckResult& result) {
    const PlannedRun& p = plan[i];
    out[i] = {p.stage, p.parameters, p.run.c.seed, measure(p.run, result.dump), result};
    ++done;
    if (!result.cached) ++made;
    std::string measures;
    for (const auto& [name, value] : out[i].measures)
      measures += fmt::format("{} {:.5g}  ", name, value);
    const double wall_s = std::chrono::duration<double>(Clock::now() - began).count();
    std::string left;
    if (made > 0 && done < plan.size()) {
      const double left_s =
          wall_s / static_cast<double>(made) * static_cast<double>(plan.size() - done);
      left = fmt::format(", at most {:.0f} min left", std::ceil(left_s / 60));
    }
    reporter.line(fmt::format(
        "  {:>3}/{}  {}seed {}: {}({}{})", done, plan.size(), words_of(p.parameters), p.run.c.seed,
        measures, result.cached ? "kept from before" : fmt::format("{:.0f} s CPU", result.cpu_s),
        left));
  });
  return out;
}

MeanOfSeeds mean_of_seeds(const std::vector<MeasuredRun>& runs, const std::string& stage) {
  MeanOfSeeds m;
  double sum = 0, squares = 0;
  for (const MeasuredRun& r : runs) {
    if (r.stage != stage) continue;
    ++m.n;
    sum += r.value();
  }
  if (m.n == 0) return m;
  m.mean = sum / static_cast<double>(m.n);
  for (const MeasuredRun& r : runs)
    if (r.stage == stage) squares += (r.value() - m.mean) * (r.value() - m.mean);
  if (m.n > 1) m.sigma = std::sqrt(squares / static_cast<double>(m.n - 1));
  m.sigma_of_mean = m.sigma / std::sqrt(static_cast<double>(m.n));
  return m;
}

void write_runs_csv(const std::vector<MeasuredRun>& runs, const std::filesystem::path& file) {
  std::string text = "stage,seed";
  for (const auto& p : runs.at(0).parameters) text += "," + p.first;
  for (const auto& m : runs.at(0).measures) text += "," + m.first;
  text += ",cpu_s,hash\n";
  for (const MeasuredRun& r : runs) {
    text += fmt::format("{},{}", r.stage, r.seed);
    for (const auto& p : r.parameters) text += fmt::format(",{:.6g}", p.second);
    for (const auto& m : r.measures) text += fmt::format(",{:.6g}", m.second);
    text += fmt::format(",{:.1f},{}\n", r.result.cpu_s, r.result.hash.substr(0, 16));
  }
  write_text(file, text);
}

void write_overlay(const std::vector<std::pair<std::string, double>>& parameters,
                   const std::filesystem::path& file) {
  std::string text;
  for (const auto& [key, value] : parameters) text += fmt::format("{}={:.6g}\n", key, value);
  write_text(file, text);
}

std::string run_command(const CalibrationRequest& request,
                        const std::vector<std::pair<std::string, double>>& parameters) {
  std::string command = "dipper run " + request.case_folder.string();
  for (const cases::Override& o : request.overrides)
    command += fmt::format(" --set '{}={}'", o.key, o.value);
  for (const auto& [key, value] : parameters)
    command += fmt::format(" --set {}={:.6g}", key, value);
  return command;
}

}  // namespace dipper::calibrate

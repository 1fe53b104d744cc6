#include <fmt/format.h>

#include "coupler/case/sieve.hpp"
#include "coupler/check/warning_parts.hpp"

namespace dipper::check {
namespace {

constexpr double kWhole_percent = 95;
constexpr double kCut_percent = 50;  // of the mass, outside the sizes of the case

}  // namespace

// A sieve curve that ends well below 100 % says nothing of the coarsest rock; one that jumps from
// a share up to 1 may have that in shares of 1.
void warn_of_sieve(const cases::Case& c, std::vector<Finding>& warnings) {
  if (c.rock.sieve.file.empty()) return;
  const cases::SieveCurve curve = cases::read_sieve(c.rock.sieve.file);
  const double passing = curve.passing_percent(curve.largest_m());
  if (passing < kWhole_percent)
    warnings.push_back(cases::finding_at(
        c, "rock.sieve.file",
        fmt::format("the curve ends at {:g} %, at {:g} m: the {:g} % of rock that are coarser are "
                    "taken to be of the largest class; are these shares of each sieve?",
                    passing, curve.largest_m(), 100 - passing)));
  const cases::SieveCase& how = c.rock.sieve;
  const double finer = how.min_size_m > 0 ? curve.passing_percent(how.min_size_m) : 0;
  const double coarser = how.max_size_m > 0 ? passing - curve.passing_percent(how.max_size_m) : 0;
  if (finer + coarser > kCut_percent)
    warnings.push_back(cases::finding_at(
        c, finer > coarser ? "rock.sieve.min_size_m" : "rock.sieve.max_size_m",
        fmt::format("{:.0f} % of the rock's mass are outside min_size_m ... max_size_m ({:.0f} % "
                    "finer, {:.0f} % coarser) and go to the smallest and the largest class: are "
                    "the sizes right?",
                    finer + coarser, finer, coarser)));
  if (const auto jump = cases::find_share_jump(curve.points()))
    warnings.push_back(
        {c.rock.sieve.file, jump->to.line, "",
         fmt::format(
             "passing_percent jumps from {:g} at {:g} m, line {}, to {:g} at {:g} m: is the "
             "{:g} a share of 1? 1 = 100 %",
             jump->from.passing_percent, jump->from.size_m, jump->from.line,
             jump->to.passing_percent, jump->to.size_m, jump->from.passing_percent)});
}

}  // namespace dipper::check

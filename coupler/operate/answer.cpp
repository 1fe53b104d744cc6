#include "coupler/operate/answer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/json_text.hpp"
#include "common/seconds.hpp"
#include "coupler/operate/instruments.hpp"

namespace dipper::operate {
namespace {

constexpr std::size_t kShown = 80;  // of a line, in a message
constexpr double kRoundOff = 1e-9;

/// What a drive may be sent to, and how fast.
struct Reach {
  double least, most, speed;
};

Reach reach(const machine::MachineData::Limits& m, const DriveWords& drive) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (drive.drive == &machine::Drives::hoist) return {m.hoist_min, m.hoist_max, m.hoist_speed};
  if (drive.drive == &machine::Drives::crowd) return {m.crowd_min, m.crowd_max, m.crowd_speed};
  if (drive.drive == &machine::Drives::swing) return {-kAny, kAny, m.swing_speed};
  return {m.door_min, m.door_max, kAny};
}

double number(const nlohmann::json& answer, const std::string& key) {
  const nlohmann::json& value = answer.at(key);
  if (!value.is_number())
    throw std::runtime_error(fmt::format("{}: {} is not a number", key, value.dump()));
  const double x = value.get<double>();
  if (!std::isfinite(x)) throw std::runtime_error(key + ": is not finite");
  return x;
}

void require_known(const nlohmann::json& answer) {
  for (const auto& item : answer.items()) {
    bool known = item.key() == "done";
    for (const DriveWords& d : kDriveWords)
      known = known || item.key() == position_key(d) || item.key() == rate_key(d);
    if (!known)
      throw std::runtime_error(fmt::format(
          "{}: unknown key; an answer has hoist_m, crowd_m, swing_rad and door_rad, and may have "
          "hoist_m_s, crowd_m_s, swing_rad_s, door_rad_s and done",
          item.key()));
  }
}

void require_speed(const std::string& key, const char* what, double speed, double most,
                   const char* unit) {
  if (std::abs(speed) <= most * (1 + kRoundOff)) return;
  throw std::runtime_error(fmt::format("{}: {} {:.6g} {}/s; the drive's limit is {:.6g} {}/s", key,
                                       what, speed, unit, most, unit));
}

}  // namespace

nlohmann::json parsed(const std::string& line) {
  try {
    return parse_json(line);
  } catch (const nlohmann::json::exception&) {
    const std::string shown = line.size() > kShown ? line.substr(0, kShown) + "..." : line;
    throw std::runtime_error(
        fmt::format("not a line of JSON: '{}' (other output belongs on stderr)", shown));
  }
}

AnswerReader::AnswerReader(const machine::MachineData& machine, double rake)
    : machine_(machine), shovel_(machine, Pose{}, rake) {}

Answer AnswerReader::read(const std::string& line, std::int64_t t_ns, std::int64_t by_ns,
                          const machine::Drives& sent) const {
  const nlohmann::json said = parsed(line);
  if (!said.is_object()) throw std::runtime_error("not a JSON object: '" + line + "'");
  require_known(said);
  Answer answer;
  answer.order.by_ns = by_ns;
  const double within_s = seconds(by_ns - t_ns);
  machine::Drives to;
  std::vector<double> rates;
  for (const DriveWords& d : kDriveWords) {
    const std::string key = position_key(d), of_rate = rate_key(d);
    if (!said.contains(key)) throw std::runtime_error(key + ": missing key");
    const double at = to.*d.drive = number(said, key);
    const Reach r = reach(machine_.limits, d);
    if (at < r.least - kRoundOff || at > r.most + kRoundOff)
      throw std::runtime_error(fmt::format(
          "{}: {:.6g} is out of the drive's reach, {:.6g} to {:.6g}", key, at, r.least, r.most));
    const double mean = (at - sent.*d.drive) / within_s;
    require_speed(key, "asks for", mean, r.speed, d.unit);
    const double rate = said.contains(of_rate) ? number(said, of_rate) : mean;
    require_speed(of_rate, "is", rate, r.speed, d.unit);
    answer.order.to.push_back(at);
    rates.push_back(rate);
  }
  answer.order.to.insert(answer.order.to.end(), rates.begin(), rates.end());
  try {
    shovel_.saddle_angle(to.hoist, to.crowd);
  } catch (const std::domain_error& e) {
    throw std::runtime_error(std::string("hoist_m, crowd_m: ") + e.what());
  }
  if (said.contains("done")) {
    if (!said.at("done").is_boolean())
      throw std::runtime_error("done: " + said.at("done").dump() + " is not true or false");
    answer.done = said.at("done");
  }
  return answer;
}

}  // namespace dipper::operate

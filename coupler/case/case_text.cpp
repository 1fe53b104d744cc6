#include "coupler/case/case_text.hpp"

#include <fmt/format.h>

#include <map>

#include "common/yaml_tree.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/case/pile_profile.hpp"
#include "coupler/case/schema.hpp"

namespace fs = std::filesystem;

namespace dipper::cases {
namespace {

// + 0.0 turns -0 into 0: equal numbers must print alike.
std::string number(double x) { return fmt::format("{:.17g}", x + 0.0); }

struct ValueText {
  const PathText& path_text;
  const KeySpec& spec;

  std::string operator()(double* x) const { return number(*x); }
  std::string operator()(int* n) const { return fmt::format("{}", *n); }
  std::string operator()(std::int64_t* n) const { return fmt::format("{}", *n); }
  std::string operator()(std::string* text) const { return in_quotes(*text); }
  std::string operator()(fs::path* path) const { return in_quotes(path_text(*path)); }
  std::string operator()(Eigen::Vector3d* v) const {
    return fmt::format("[{}, {}, {}]", number(v->x()), number(v->y()), number(v->z()));
  }
  std::string operator()(std::vector<std::string>* names) const {
    std::string text;
    for (const std::string& name : *names) text += (text.empty() ? "" : ", ") + in_quotes(name);
    return "[" + text + "]";
  }
  std::string operator()(const Choice& choice) const {
    return in_quotes(spec.allowed.at(choice.get()));
  }
};

}  // namespace

std::string case_text(const Case& c, const PathText& path_text) {
  const PathText relative = [&](const fs::path& path) {
    return path.lexically_relative(c.folder).generic_string();
  };
  const PathText& text_of_path = path_text ? path_text : relative;
  Case copy = c;  // a slot gives write access, so reading through it needs a mutable case
  std::map<std::string, std::string> lines;
  for (const KeySpec& spec : schema()) {
    // The classes have the curve's result: a text with both would not be a valid case.
    if (spec.key.rfind("rock.sieve.", 0) == 0) continue;
    if (spec.key == "effects.*") continue;  // the keys they change have their values already
    if (spec.key == "pile.profile" && c.pile.profile.empty()) continue;
    if (spec.key == "machine.plan" && c.machine.plan.empty()) continue;
    if (is_replaced_by_profile(c, spec.key) || is_of_other_kind(c, spec.key)) continue;
    for (const Place& place : places_of(c, spec)) {
      lines[concrete_key(spec, place)] =
          std::visit(ValueText{text_of_path, spec}, spec.slot(copy, place));
    }
  }
  std::string text;
  for (const auto& [key, value] : lines) text += fmt::format("{}={}\n", key, value);
  return text;
}

}  // namespace dipper::cases

// Every key of case.yaml, as data, for the loader, the canonical text and docs/case.md.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "common/range.hpp"
#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Which element of a list (`#` in a key) or entry of a map of free names (`*`) is meant.
struct Place {
  std::size_t index = 0;
  std::string name;
};

/// A member of a Case that is one of a few words in a case file: a bool or an enum.
class Choice {
 public:
  /// \param values  the values of the words of KeySpec::allowed, in their order
  template <class T>
  Choice(T& member, std::vector<T> values)
      : get_([&member, values] {
          return static_cast<std::size_t>(std::find(values.begin(), values.end(), member) -
                                          values.begin());
        }),
        set_([&member, values](std::size_t word) { member = values.at(word); }) {}

  std::size_t get() const { return get_(); }  ///< index of the word
  void set(std::size_t word) const { set_(word); }

 private:
  std::function<std::size_t()> get_;
  std::function<void(std::size_t)> set_;
};

/// Access to a key's value in a Case. Its type is the key's type.
using Slot = std::variant<double*, int*, std::int64_t*, std::string*, std::filesystem::path*,
                          Eigen::Vector3d*, std::vector<std::string>*, Choice>;

/// What has to be made again when a key changes: this stage and those below it.
enum class Affects {
  settling,     ///< the pile, which is kept in the cache
  dig,          ///< the run
  machine,      ///< forces of its drives; its motion too where they have limits, and then the dig
  instruments,  ///< the run as a mine's instruments would show it
  output        ///< no result: what is written, time limits, the end
};

/// One key.
struct KeySpec {
  std::string key;   ///< dotted; `#` stands for a list index, `*` for a name
  std::string unit;  ///< "kg/m3", "%"; "" for a pure number or no number
  Range range;
  /// The words of a text or a choice; empty: any. Of a number: words that it may have instead, for
  /// which it is kept as 0.
  std::vector<std::string> allowed;
  bool required = true;
  Affects affects;
  std::string doc;
  Slot (*slot)(Case&, const Place&);

  std::string leaf() const;      ///< the last part of `key`
  std::string stem() const;      ///< the leaf without its unit: "density" of "density_kg_m3"
  std::string expected() const;  ///< "a number in kg/m3"
};

/// All keys, in the order of a case file.
const std::vector<KeySpec>& schema();

/// The key `key` of the schema (a pattern with # and *), or nullptr.
const KeySpec* find_spec(const std::string& key);

/// The schema's key for a key of a case's text: "rock.classes.#.name" for
/// "rock.classes.0.name"; an element of a vector, "domain.min_m.0", is its key's. Or nullptr.
const KeySpec* spec_of(const std::string& key);

/// True when a key's value is a path: the file's contents matter, not its name.
bool is_path(const KeySpec& spec);

/// "settling", "dig", "machine", "instruments" or "output".
std::string to_string(Affects affects);

/// The keys and sections directly below a section ("" is the whole file), in order.
std::vector<std::string> children_of(const std::string& section);

/// True when a case file must have this key or section.
bool is_required(const std::string& key_or_section);

/// The places at which a key occurs in a case: one, or one an element or name.
std::vector<Place> places_of(const Case& c, const KeySpec& spec);

/// The dotted key at a place: "rock.classes.0.size_m".
std::string concrete_key(const KeySpec& spec, const Place& place);

/// The word of a case for a key with a choice of words: "corrected" of "coupling.scheme".
std::string word_of(const Case& c, const std::string& key);

/// "_kg_m3" for "kg/m3", "_percent" for "%", "" for "".
std::string unit_suffix(const std::string& unit);

/// docs/case.md's table of keys.
std::string schema_markdown();

}  // namespace dipper::cases

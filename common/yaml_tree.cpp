#include "common/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "common/text_file.hpp"

namespace dipper {
namespace {

// yaml-cpp's events rather than its Node: a Node loses the line of a key, keeps both of two equal
// keys silently, and follows an alias into a cycle.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::filesystem::path file, std::string set_key, std::vector<Finding>& findings)
      : file_(std::move(file)), set_key_(std::move(set_key)), findings_(findings) {}

  YamlTree root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { leaf(mark, {}); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    add(mark, "YAML aliases (*name) are not read here; write the value out");
    leaf(mark, {});
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    YamlTree node;
    node.kind = YamlTree::Kind::scalar;
    node.scalar = value;
    node.quoted = tag == "!";
    leaf(mark, std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, YamlTree::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark, YamlTree::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  // A map or list that is being read. `key` is the map key that waits for its value.
  struct Level {
    YamlTree node;
    std::string key;
    Origin key_origin;
    bool has_key = false;
  };

  bool expects_key() const {
    return !levels_.empty() && levels_.back().node.kind == YamlTree::Kind::map &&
           !levels_.back().has_key;
  }

  Origin origin(const YAML::Mark& mark) const {
    return {file_, set_key_.empty() && !mark.is_null() ? mark.line + 1 : 0};
  }

  void add(const YAML::Mark& mark, const std::string& message) {
    const Origin at = origin(mark);
    findings_.push_back({at.file, at.line, dotted(), message});
  }

  std::string dotted() const {
    std::string key = set_key_;
    for (const Level& level : levels_) {
      const std::string part = level.node.kind == YamlTree::Kind::list
                                   ? std::to_string(level.node.children.size())
                                   : level.key;
      if (!part.empty()) key += (key.empty() ? "" : ".") + part;
    }
    return key;
  }

  void leaf(const YAML::Mark& mark, YamlTree node) {
    if (expects_key()) {
      levels_.back().key = node.scalar;
      levels_.back().key_origin = origin(mark);
      levels_.back().has_key = true;
      return;
    }
    node.origin = origin(mark);
    attach(std::move(node));
  }

  void open(const YAML::Mark& mark, YamlTree::Kind kind) {
    // "? [a, b]" is legal YAML, but never a key of ours.
    if (expects_key()) throw YAML::ParserException(mark, "a key must be a plain word");
    Level level;
    level.node.kind = kind;
    level.node.origin = origin(mark);
    levels_.push_back(std::move(level));
  }

  void close() {
    YamlTree node = std::move(levels_.back().node);
    levels_.pop_back();
    attach(std::move(node));
  }

  void attach(YamlTree node) {
    if (levels_.empty()) {
      root = std::move(node);
      return;
    }
    Level& parent = levels_.back();
    if (parent.node.kind == YamlTree::Kind::list) {
      parent.node.children.emplace_back(std::to_string(parent.node.children.size()),
                                        std::move(node));
      return;
    }
    node.origin = parent.key_origin;
    if (const YamlTree* first = parent.node.find(parent.key)) {
      findings_.push_back(
          {node.origin.file, node.origin.line, dotted(),
           fmt::format("given twice, first in line {}; keep one of the two", first->origin.line)});
    } else {
      parent.node.children.emplace_back(parent.key, std::move(node));
    }
    parent.has_key = false;
    parent.key.clear();
  }

  std::filesystem::path file_;
  std::string set_key_;
  std::vector<Finding>& findings_;
  std::vector<Level> levels_;
};

}  // namespace

const YamlTree* YamlTree::find(const std::string& key) const {
  const auto it = std::find_if(children.begin(), children.end(),
                               [&](const auto& child) { return child.first == key; });
  return it == children.end() ? nullptr : &it->second;
}

YamlTree* YamlTree::find(const std::string& key) {
  return const_cast<YamlTree*>(std::as_const(*this).find(key));
}

std::optional<std::size_t> first_not_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    const unsigned lead = byte(i);
    const std::size_t length = lead < 0x80                    ? 1
                               : lead >= 0xC2 && lead <= 0xDF ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    // The second byte excludes long forms, surrogates and values beyond the last code point.
    const unsigned second = length > 1 ? byte(i + 1) : 0x80U;
    bool sound = length > 0 && !(lead == 0xE0 && second < 0xA0) &&
                 !(lead == 0xED && second > 0x9F) && !(lead == 0xF0 && second < 0x90) &&
                 !(lead == 0xF4 && second > 0x8F);
    for (std::size_t k = 1; k < length; ++k) sound = sound && (byte(i + k) & 0xC0U) == 0x80U;
    if (!sound) return i;
    i += length;
  }
  return std::nullopt;
}

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char ch : text) {
    if (ch == '"' || ch == '\\') out += '\\';
    if (static_cast<unsigned char>(ch) < 0x20) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(ch));
    } else {
      out += ch;
    }
  }
  return out + "\"";
}

YamlTree parse_yaml(const std::string& text, const std::filesystem::path& file,
                    const std::string& set_key, std::vector<Finding>& findings) {
  if (const auto bad = first_not_utf8(text)) {
    const auto lines = std::count(text.begin(), text.begin() + static_cast<long>(*bad), '\n');
    findings.push_back({file, set_key.empty() ? static_cast<int>(lines) + 1 : 0, set_key,
                        "holds a byte that is not UTF-8; save the text as UTF-8"});
    return {};
  }
  TreeBuilder builder(file, set_key, findings);
  const auto line = [&](const YAML::Mark& mark) {
    return set_key.empty() && !mark.is_null() ? mark.line + 1 : 0;
  };
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    parser.HandleNextDocument(builder);
    TreeBuilder rest(file, set_key, findings);
    if (parser.HandleNextDocument(rest)) {
      findings.push_back({file, line(YAML::Mark::null_mark()), set_key,
                          "holds several YAML documents (---); write one"});
    }
  } catch (const YAML::Exception& e) {
    findings.push_back({file, line(e.mark), set_key, "not valid YAML: " + e.msg});
  }
  // The root of an empty file has the file's first line.
  if (builder.root.origin.file.empty()) builder.root.origin = {file, set_key.empty() ? 1 : 0};
  return std::move(builder.root);
}

YamlTree read_yaml(const std::filesystem::path& file, std::vector<Finding>& findings) {
  const std::optional<std::string> text = read_bytes(file);
  if (!text) {
    findings.push_back({file, 0, "", "cannot be read"});
    YamlTree none;
    none.origin = {file, 0};
    return none;
  }
  return parse_yaml(*text, file, "", findings);
}

std::string shown(const YamlTree& node) {
  switch (node.kind) {
    case YamlTree::Kind::empty:
      return "nothing";
    case YamlTree::Kind::list:
      return "a list";
    case YamlTree::Kind::map:
      return "a section";
    case YamlTree::Kind::scalar:
      break;
  }
  return node.quoted ? "\"" + node.scalar + "\"" : "'" + node.scalar + "'";
}

}  // namespace dipper

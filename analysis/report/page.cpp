#include "analysis/report/page.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>

#include "analysis/report/packing.hpp"
#include "analysis/report/web_bundle.hpp"

namespace dipper::analysis::report {
namespace {

using json = nlohmann::json;

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string text_of(const json& data, const char* key) {
  if (!data.is_object() || !data.contains(key) || !data[key].is_string())
    throw std::invalid_argument(
        fmt::format("{}: missing; the data of a page must have it, as a string", key));
  return data[key].get<std::string>();
}

std::string_view script_of(const std::string& kind) {
  std::string known;
  for (const PageScript& script : page_scripts()) {
    if (script.kind == kind) return script.text;
    known += (known.empty() ? "" : ", ") + std::string(script.kind);
  }
  throw std::invalid_argument(fmt::format("kind: there is no page \"{}\"; one of {}", kind, known));
}

}  // namespace

std::string page(const json& data, const std::vector<std::vector<std::uint8_t>>& frames) {
  const std::string_view script = script_of(text_of(data, "kind"));
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{} – Dipper</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>",
      html_text(text_of(data, "title")));
  out += kPageStyle;
  out +=
      "</style>\n</head>\n<body>\n<noscript>This page draws itself with JavaScript, which is off "
      "here. Its numbers are in the JSON file beside it.</noscript>\n<main id=\"page\"></main>\n";
  const auto add = [&out](const std::string& name, const std::vector<std::uint8_t>& bytes) {
    out += "<script type=\"text/plain\" data-" + name + ">" + base64(bytes) + "</script>\n";
  };
  // Names may hold bytes that are not UTF-8; the page shows a replacement character.
  const std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  add("head", gzip(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  for (const auto& block : frames) add("frames", block);
  out += "<script>";
  out += script;
  out += "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace dipper::analysis::report

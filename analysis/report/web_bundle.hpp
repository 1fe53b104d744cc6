// The pages' style and scripts, bundled at build time from analysis/report/web.
#pragma once

#include <string_view>
#include <vector>

namespace dipper::analysis::report {

struct PageScript {
  std::string_view kind;  ///< as in the page's JSON; its source is web/pages/KIND.js
  std::string_view text;
};

extern const std::string_view kPageStyle;
const std::vector<PageScript>& page_scripts();

}  // namespace dipper::analysis::report

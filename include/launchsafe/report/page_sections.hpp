// A page of texts, tables and figures as files: for a browser, in Markdown, and in JSON for programs.
#pragma once

#include "launchsafe/report/cell_plot.hpp"
#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/report.hpp"

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace launchsafe::report {

/// A figure, or an SVG that was drawn before.
using Drawing = std::variant<Plot, CellPlot, std::string>;

/// What a page tells.
struct PageFacts {
  Row facts = Row::object();                     ///< by the names that texts know
  std::map<std::string, Drawing> drawings = {};  ///< by file; facts say which are shown, and where
};

/// Draws the figures and fills the templates. `order`: the texts in the order of the page, whose words
/// `templates` may replace. `head`: "format", "title", "subject" and "answer" of the page. Whatever facts say
/// is escaped, so that markup in it is shown. A figure that gnuplot does not draw is a remark, in the page
/// too. Equal facts make equal files. Errors: corrupt (a template that cannot be rendered).
store::Result<RenderedReport> render_page(const std::vector<PageText>& order, const PageFacts& all,
                                          const PageTemplates& templates, const Row& head,
                                          const DrawingLimits& limits = {});

}  // namespace launchsafe::report

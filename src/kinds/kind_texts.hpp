// What the pages of studies say: texts of src/kinds/templates, filled with facts.
#pragma once

#include "launchsafe/report/page_texts.hpp"

#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What the texts under a name say, "accuracy.answer" those of "accuracy.answer.bound" too: in their order,
/// each once for everything that it is said of; empty ones are left out.
std::vector<std::string> said(const std::string& name, const report::Row& facts = report::Row::object());

/// The same below each other, as part of a page: with a line break behind each.
std::string said_below(const std::string& name, const report::Row& facts = report::Row::object());

/// The panel of a fit, to be filled: src/kinds/templates/ask.html.
const std::string& ask_template();

}  // namespace launchsafe::kinds

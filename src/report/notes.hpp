// What tables and pages of several kinds of study say: texts of src/report/notes.mustache, filled with facts.
#pragma once

#include "launchsafe/report/page_texts.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// What the notes under a name say, "mesh" those of "mesh.stated" too; empty ones are left out.
std::vector<std::string> noted(const std::string& name, const Row& facts = Row::object());

}  // namespace launchsafe::report

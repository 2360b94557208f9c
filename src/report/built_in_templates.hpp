// Made of src/report/templates and src/report/notes.mustache when the build is configured.
#pragma once

#include "launchsafe/report/page_texts.hpp"

namespace launchsafe::report {

/// Of a safety report.
extern const char *const built_in_html, *const built_in_markdown, *const built_in_texts;
/// What is said of a study while it runs.
extern const char *const status_text_template, *const status_page_template;
/// Of the page that leads to all reports of a folder.
extern const char* const index_template;

/// What the notes under a name say of tables and pages of several kinds of study, "mesh" those of
/// "mesh.stated" too; empty ones are left out.
std::vector<std::string> noted(const std::string& name, const Row& facts = Row::object());

}  // namespace launchsafe::report

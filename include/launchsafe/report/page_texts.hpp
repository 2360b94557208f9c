// The texts of a page under their names, and how they are filled with facts: rows as JSON, and what was
// selected from them. What is said, where and in which digits stands in templates, not in C++. Then, of
// such texts, tables and figures, a page as files: for a browser, in Markdown, and in JSON for programs.
#pragma once

#include "launchsafe/report/report.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::report {

/// A row of a table of study.json, or another object of it.
using Row = nlohmann::ordered_json;

/// A member of a row that is a text, or a number; "", NaN where it is none.
std::string text_of(const Row& row, const std::string& key);
double number_of(const Row& row, const std::string& key);

/// What stands under a dotted name; null where nothing does.
const Row& found_in(const Row& facts, const std::string& name);

/// A column of a table: a text over the row.
struct TextColumn {
  std::string key, heading, cell;
};

/// A text with its name and, of what a page says by itself, its place in the page.
struct PageText {
  std::string id;
  std::string look = {};               ///< "lead", "plain", "item", "code", "section", "table", "figure"
  std::string of = {};                 ///< the facts that fill it, once for each of a list
  std::vector<std::string> from = {};  ///< study, table, setting: where its facts come from, texts themselves
  std::vector<TextColumn> columns = {};
  std::string words = {};
};

/// The texts of a file in their order. Throws store::Error, corrupt: words before the first name, or tags
/// that do not fit together.
std::vector<PageText> texts_in(const std::string& file, const std::string& name);

/// What a text is said of: "main.gap_shares where case {{own.case}} largest lowers_cm". Once where it names
/// nothing; facts that are false or empty have nothing to say. All rows with the largest or smallest number
/// are chosen; "lowest" are those without a number where there are such, and else those with the smallest.
std::vector<const Row*> selected(const PageText& text, const Row& facts);

/// A template filled with facts, the inner ones last; nothing is escaped unless by `escape`. Throws
/// store::Error, corrupt, as one that was read before never does.
std::string filled(const std::string& text, std::vector<const Row*> facts,
                   std::string (*escape)(const std::string&) = nullptr);

/// What the texts under a name say, "answer" those of "answer.value" too: in their order, each once for
/// everything that it is said of; empty ones are left out.
std::vector<std::string> said(const std::vector<PageText>& texts, const std::string& name, const Row& facts);

/// Mustache templates of the pages, and the texts by their names, each a template too.
struct PageTemplates {
  std::string html, markdown;
  std::map<std::string, std::string> texts;
};

/// Those in a folder; what is not there, files or single texts, stays as it is built in. Errors: missing
/// (none of the files is there), corrupt (no template: tags that do not fit together, a text without a name).
store::Result<PageTemplates> read_templates(const std::filesystem::path& folder, PageTemplates built_in);

/// What a page tells.
struct PageFacts {
  /// By the names that texts know. A figure has its "file", and "svg" where it is drawn already.
  Row facts = Row::object();
  std::map<std::string, Drawing> drawings = {};  ///< by file: to be drawn where facts show it
};

/// Draws the figures and fills the templates. `order`: the texts in the order of the page, whose words
/// `templates` may replace. `head`: "format", "title", "subject" and "answer" of the page. Whatever facts say
/// is escaped, so that markup in it is shown. A figure that gnuplot does not draw is a remark, in the page
/// too. Equal facts make equal files. Throws store::Error, corrupt: a template that cannot be rendered.
RenderedReport render_page(const std::vector<PageText>& order, const PageFacts& all,
                           const PageTemplates& templates, const Row& head, const DrawingLimits& limits = {});

/// How a page of `index_page` begins, by which it is known.
inline constexpr const char* index_begin = "<!DOCTYPE html>\n<!-- launchsafe report --index 1 -->\n";

/// An entry for every folder within `folder` that holds a page or a picture: title and answer as its
/// study.json or report.json has them, or else the heading of its page, with links to its pages and pictures.
/// Folders further down are links in the entry of the folder that they are in. Empty where there is no
/// report.
std::string index_page(const std::filesystem::path& folder);

// Built in, as they are in src/report/templates and src/report/notes.mustache.

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

// The report of a study as one value, and what becomes of it: a page, tables and pictures in files, text for
// a terminal, and one JSON object.
#pragma once

#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"

namespace launchsafe::report {

/// Paragraphs, lists and headings of the page, in Markdown, ending with a line break; left out where empty.
struct Statement {
  std::string markdown;
};

/// Where a table is shown, besides its own file. One without rows is nowhere.
enum class Shown { page_and_terminal, page, terminal, file };

struct ReportTable {
  Table table;
  std::string csv = {};     ///< name of a file with all of it; empty: none
  std::string member = {};  ///< of study.json: an array of the rows of all tables of that name; empty: none
  Shown shown = Shown::page_and_terminal;
  std::size_t most_rows = std::numeric_limits<std::size_t>::max();  ///< on the page
};

struct Picture {
  std::string file;  ///< "temperature.svg"
  Plot plot;
  std::string alternative;  ///< what it shows, for who cannot see it
};

using store::TextFile;

struct Report {
  std::string title;
  std::string answer;   ///< what the study was asked, in a few lines
  std::string command;  ///< that makes the report again
  std::vector<std::variant<Statement, ReportTable, Picture>> items = {};  ///< in the order of the page
  std::vector<TextFile> files = {};
  std::string json = {};                  ///< study.json; none where empty
  std::vector<std::string> remarks = {};  ///< for the end of the page, and for people
  std::string launch = {};                ///< a sentence that stands first: how fast the load makes the shell

  // The next item of the page.
  void say(std::string markdown) { items.emplace_back(Statement{std::move(markdown)}); }
  void add(ReportTable table) { items.emplace_back(std::move(table)); }
  void draw(Picture picture) { items.emplace_back(std::move(picture)); }
};

/// A report as it is written into a folder.
struct RenderedReport {
  std::vector<TextFile> files;
  std::vector<std::string> remarks;  ///< what could not be made and why, such as a missing gnuplot
  int pictures_missing = 0;          ///< because they could not be drawn: another time they may be
};

/// The page. `missing`: names of pictures that were not drawn.
std::string to_markdown(const Report& report, const std::vector<std::string>& missing = {});

/// The launch, the tables and the answer. `folder`: where the whole of a long table is; `width`: of each
/// table.
std::string to_text(const Report& report, const std::filesystem::path& folder, std::size_t width = 0);

/// The tables of study.json for a results file, by their names there.
std::vector<store::PlainTable> plain_tables(const Report& report);

/// Tables, files, pictures, report.md and study.json. A picture that gnuplot does not draw is a remark, and
/// none after it is tried.
RenderedReport render_report(const Report& report, const DrawingLimits& limits = {});

// --- the texts of a page under their names, and how they are filled with facts: rows as JSON, and what was
// selected from them. What is said, where and in which digits stands in templates, not in C++. Then, of such
// texts, tables and figures, a page as files: for a browser, in Markdown, and in JSON for programs ---

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

/// What a text is said of: "main.causes where case {{own.case}} largest shorter_cm". Once where it names
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

/// What a page tells.
struct PageFacts {
  /// By the names that texts know. A figure has its "file", and "svg" where it is drawn already.
  Row facts = Row::object();
  std::map<std::string, Drawing> drawings = {};  ///< by file: to be drawn where facts show it
};

/// Draws the figures and fills the built-in templates. `texts`: in the order of the page. `head`: "format",
/// "title", "subject" and "answer" of the page. Whatever facts say is escaped, so that markup in it is shown.
/// A figure that gnuplot does not draw is a remark, in the page too. Equal facts make equal files.
RenderedReport render_page(const std::vector<PageText>& texts, const PageFacts& all, const Row& head,
                           const DrawingLimits& limits = {});

// Built in, as they are in src/report/templates and src/report/notes.mustache.

/// Of a safety report.
extern const char *const built_in_html, *const built_in_markdown, *const built_in_texts;
/// What is said of a study while it runs.
extern const char* const status_text_template;

/// What the notes under a name say of tables and pages of several kinds of study, "verdicts" those of
/// "verdicts.models" too; empty ones are left out.
std::vector<std::string> noted(const std::string& name, const Row& facts = Row::object());

}  // namespace launchsafe::report

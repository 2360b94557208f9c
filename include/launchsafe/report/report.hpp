// The report of a study as one value, and what becomes of it: a page, tables and pictures in files, text for
// a terminal, and one JSON object.
#pragma once

#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/report/template.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"

namespace launchsafe::report {

/// Where a table is shown, besides its own file. One without rows is nowhere.
enum class Shown { page_and_terminal, page, file };

struct ReportTable {
  Table table;
  std::string csv = {};     ///< name of a file with all of it; empty: none
  std::string member = {};  ///< of study.json: an array of its rows; each table has its own. Empty: none
  Shown shown = Shown::page_and_terminal;
};

struct Picture {
  std::string file;  ///< "field_temperature_10ms.svg"
  Drawing drawing;
  std::string alternative = {};     ///< what it shows, for who cannot see it
  std::optional<double> time = {};  ///< s, of a field
  std::optional<double> gap = {};   ///< m, of what belongs to one gap
  std::string svg = {};             ///< where it was drawn before
};

using store::TextFile;

struct Report {
  std::string title;
  std::string answer;   ///< what the study was asked, in a few lines
  std::string command;  ///< that makes the report again
  /// In the order of the page. Texts are paragraphs, lists and headings in Markdown, each ending with a line
  /// break; they are left out where empty.
  std::vector<std::variant<std::string, ReportTable, Picture>> items = {};
  std::vector<TextFile> files = {};
  std::string json = {};                  ///< study.json; none where empty
  std::vector<std::string> remarks = {};  ///< for the end of the page, and for people
  std::string launch = {};                ///< a sentence that stands first: how fast the load makes the shell

  // The next item of the page.
  void say(std::string markdown) { items.emplace_back(std::move(markdown)); }
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

/// The launch, the tables and the answer. `width`: of each table.
std::string to_text(const Report& report, std::size_t width = 0);

/// The tables of study.json for a results file, by their names there.
std::vector<store::PlainTable> plain_tables(const Report& report);

/// Adds the pictures to the files, until gnuplot is missing, fails or takes too long at one, which is a
/// remark. The names of those that are not there.
std::vector<std::string> draw(const std::vector<const Picture*>& pictures, const DrawingLimits& limits,
                              RenderedReport& rendered);

/// Tables, files, pictures, report.md and study.json. A picture that gnuplot does not draw is a remark, and
/// none after it is tried.
RenderedReport render_report(const Report& report, const DrawingLimits& limits = {});

/// Built in, as src/report/templates has it: the page of a safety report.
extern const char* const safety_report_template;

}  // namespace launchsafe::report

// A safety report as one value: sections of paragraphs, tables and figures, each with where its numbers come
// from. Its words are not here but in a template, under the names of what is to be said.
#pragma once

#include "launchsafe/report/cell_plot.hpp"
#include "launchsafe/report/gap_criterion.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/safety_evidence.hpp"
#include "launchsafe/report/table.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::report {

/// Where the numbers of a block come from.
struct Origin {
  std::string study = {};    ///< "S1"; empty for what rests on no study
  std::string of = {};       ///< table of its study.json, or what else of it
  std::string setting = {};  ///< case, gap, mesh
};

/// Named parts of a text: texts, numbers as {"text", "value", "unit"}, truths, and lists of objects.
using Parts = nlohmann::ordered_json;
/// A number as it is printed, beside what it is.
Parts part(std::string text, double value, std::string unit);

/// How a paragraph looks.
enum class Look { lead, plain, item, code };
std::string to_string(Look look);

struct SaidParagraph {
  std::string id;  ///< of its text
  Look look = Look::plain;
  Parts parts = {};
  Origin origin = {};
};

/// The names of columns are replaced by the texts "column.KEY" where there are such.
struct SaidTable {
  std::string id;
  Table table;
  Origin origin = {};
};

struct SaidFigure {
  std::string id;    ///< of its caption and of what it shows for who cannot see it
  std::string file;  ///< "temperature.svg"
  std::variant<Plot, CellPlot, std::string> picture;  ///< or the SVG itself
  Parts parts = {};
  Origin origin = {};
};

using Block = std::variant<SaidParagraph, SaidTable, SaidFigure>;

struct SafetySection {
  std::string id;
  std::vector<Block> blocks = {};
  void say(std::string text, Parts parts = {}, Origin origin = {}, Look look = Look::plain) {
    blocks.push_back(SaidParagraph{std::move(text), look, std::move(parts), std::move(origin)});
  }
  void show(std::string table, Table content, Origin origin = {}) {
    blocks.push_back(SaidTable{std::move(table), std::move(content), std::move(origin)});
  }
  void draw(std::string figure, std::string file, std::variant<Plot, CellPlot, std::string> picture,
            Parts parts, Origin origin) {
    blocks.push_back(SaidFigure{std::move(figure), std::move(file), std::move(picture), std::move(parts),
                                std::move(origin)});
  }
  void item(std::string text, Parts parts = {}, Origin origin = {}) {
    say(std::move(text), std::move(parts), std::move(origin), Look::item);
  }
};

struct SafetyDocument {
  std::string title;    ///< of the main study
  std::string subject;  ///< title of the scene
  Parts answer;  ///< for programs: the criterion and what it allows, and the critical gap of every case
  std::vector<SafetySection> sections;
};

/// Equal evidence and criterion make equal documents.
SafetyDocument make_safety_document(const SafetyEvidence& evidence,
                                    const std::optional<GapCriterion>& criterion = {});

}  // namespace launchsafe::report

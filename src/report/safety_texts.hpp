// The texts of a safety report, and how they are filled.
#pragma once

#include "launchsafe/report/safety_evidence.hpp"

#include <string>
#include <vector>

namespace launchsafe::report::safety {

// The templates that are built in, of src/report/templates.
extern const char* const built_in_html;
extern const char* const built_in_markdown;
extern const char* const built_in_texts;

/// A column of a table: a text over the row.
struct TextColumn {
  std::string key, heading, cell;
};

/// A text with its name and, of what the report says by itself, its place in the report.
struct Text {
  std::string id;
  std::string look = {};               ///< "lead", "plain", "item", "code", "section", "table", "figure"
  std::string of = {};                 ///< the facts that fill it, once for each of a list
  std::vector<std::string> from = {};  ///< study, table, setting: where its facts come from, texts themselves
  std::vector<TextColumn> columns = {};
  std::string words = {};
};

/// The texts of a file in their order. Errors: corrupt (words before the first name, or tags that do not fit
/// together).
store::Result<std::vector<Text>> texts_in(const std::string& file, const std::string& name);

/// What stands under a dotted name; null where nothing does.
const Row& found_in(const Row& facts, const std::string& name);

/// A text, a number as its shortest text, or "true"; empty for anything else.
std::string fact_text(const Row& fact);

/// A template filled with facts, the inner ones last. Errors: corrupt.
store::Result<std::string> filled(const std::string& text, std::vector<const Row*> facts,
                                  std::string (*escape)(const std::string&));
/// Of a text that was read: nothing is escaped.
std::string filled(const std::string& text, std::vector<const Row*> facts);

}  // namespace launchsafe::report::safety

// Mustache templates, filled with JSON.
#pragma once

#include "launchsafe/store/file.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::report {

/// A row of a table of study.json, or another object of it.
using Row = nlohmann::ordered_json;

/// A member of a row that is a text, or a number; "", NaN where it is none.
std::string text_of(const Row& row, const std::string& key);
double number_of(const Row& row, const std::string& key);

/// What stands under a dotted name; null where nothing does.
const Row& found_in(const Row& facts, const std::string& name);

/// A template filled with facts, the inner ones last; nothing is escaped unless by `escape`. Behind a bar
/// stands the form of a fact: "fixed 1", "sig 4"; "mega 3", millions; "duration" of seconds; "counted case",
/// "2 cases"; "list" of texts; "padded 22", as wide as that at least; and as a condition "over 0", "is yes",
/// or "some" of a list. Throws store::Error, corrupt.
std::string filled(const std::string& text, std::vector<const Row*> facts,
                   std::string (*escape)(const std::string&) = nullptr);

}  // namespace launchsafe::report

// The sections of a safety report, and what they share.
#pragma once

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/safety_document.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::report::safety {

using Row = nlohmann::json;

/// Text, truth and number of a member; "", NaN where it is none.
std::string text_of(const Row& row, const std::string& key);
double number_of(const Row& row, const std::string& key);

/// One case of the main study with its verdicts.
struct JudgedCase {
  std::string label;
  const Row* critical = nullptr;  ///< its row of `cases`
  std::vector<const Row*> verdicts;
  std::vector<JudgedGap> gaps;  ///< the same as a criterion sees them
  /// Whether its run came to its end: temperatures of one that was cut off are those of a part of the launch,
  /// and no number of it is told.
  bool completed = false;
};

/// What every section reads.
struct Subject {
  const SafetyEvidence& evidence;
  const StudyEvidence& study;     ///< the main one
  std::vector<JudgedCase> cases;  ///< none unless it is a finished study of kind critical-gap
  const std::optional<GapCriterion>& criterion;

  const scene::Scene& scene() const { return study.scene.scene; }
  /// Whether a case is of the scene's own load and defect.
  bool is_own(const JudgedCase& each) const;
  /// That case, or else the one with the smallest critical gap; nullptr without any.
  const JudgedCase* own_case() const;
  Origin origin(std::string of, std::string setting = {}) const;
};

/// Whether nothing says how wrong a row is: its uncertainty is then no number to hold a margin against.
bool has_validity_warning(const Row& verdict);

/// The rows of a case that do not ignite: T max (K) as a function of the gap (cm).
struct InertRows {
  std::vector<double> gaps, temperatures;
};
InertRows inert_rows(const JudgedCase& each);

std::vector<const Row*> pointers_to(const Row& rows);
/// Rows of a study's table under the columns, by their keys.
/// Nothing for a number that is not there.
inline Cell optional_number(double value) { return keys::cell_of(known(value)); }
Table table_of(const std::vector<const Row*>& rows, std::vector<Column> columns);

Subject subject_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion);
Origin origin_of(const StudyEvidence& study, std::string of, std::string setting = {});
/// The setting of an accuracy study whose uncertainty stands in the main study's input; nullptr where the
/// main study took no record of it.
const Row* setting_taken_by(const StudyEvidence& main, const StudyEvidence& accuracy);

bool is_value(const Row& critical);
/// cm: the critical gap with its uncertainty as printed; what moves towards ignition alone lowers it alone.
/// Nothing where it is no value.
std::optional<Measured> measured_gap(const Row& critical);
/// That as text, or how the study reads it.
std::string gap_text(const Row& critical);

/// Verdict rows that page one holds.
inline constexpr std::size_t most_rows_on_page_one = 12;
/// Verdict rows of all cases as a table for people.
Table verdict_table(const Subject& subject);

/// The shares of the uncertainty of a verdict row, K, under the names of the texts.
struct Share {
  std::string name;
  double size = 0;
};
inline constexpr const char* share_names[] = {"computation", "fit", "inputs", "model_form"};
std::vector<Share> shares_of(const Row& verdict);

/// "300 K": what the verdicts of the main study hold for; of a sweep over it "219 to 344 K".
std::string launch_temperature_text(const Subject& subject);
/// The initial temperatures of a sweep over them, K; none of another study.
std::vector<double> swept_temperatures(const StudyEvidence& study);

/// The verdict rows of the main study, where it judges gaps.
std::vector<const Row*> all_verdicts(const Subject& subject);
std::size_t count_of(const std::vector<const Row*>& rows, const std::string& verdict);
/// Whether complete coupled runs on both sides of a case's critical gap do what is expected of them.
bool is_confirmed(const Subject& subject, const std::string& label);
/// What the answer rests on and does not cover: items.
void say_limits(const Subject& subject, SafetySection& section);

/// How often draws of the sensitivity study's inputs ignite, where it is of the main study's launch: an item.
void say_probability(const Subject& subject, SafetySection& section);

/// A count that a text tells only where there is something to count.
Parts count_part(std::size_t count);

/// The label of a case; of a sweep the values of its axes.
std::string name_of_case(const StudyEvidence& study, const Row& row);

/// The answer for programs.
Parts answer_parts(const Subject& subject);

SafetySection answer_section(const Subject& subject);
SafetySection gap_section(const Subject& subject);
SafetySection scene_section(const Subject& subject);
SafetySection place_section(const Subject& subject);
SafetySection fit_section(const Subject& subject);
SafetySection budget_section(const Subject& subject);
SafetySection published_section(const Subject& subject);
SafetySection validity_section(const Subject& subject);

}  // namespace launchsafe::report::safety

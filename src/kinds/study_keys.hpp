// What the sources of kinds share.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/case_rows.hpp"

namespace launchsafe::kinds {

// --- what the outcomes, tables and pages of several kinds of study share ---

namespace quantity = report::quantity;

// What all sources of kinds speak of.
using keys::Cell, keys::centimetre, keys::count, keys::fixed, keys::Form, keys::joined, keys::kelvin,
    keys::millisecond, keys::percent, keys::second, keys::significant, keys::text;
using report::centimetres, report::Column, report::digits_of, report::in_words, report::json_of, report::Mark,
    report::milliseconds, report::Picture, report::Plot, report::Quantities, report::reads_as, report::Report,
    report::ReportTable, report::Row, report::Series, report::Shown, report::shown_gap, report::shown_value,
    report::ShownKey, report::Style, report::Table, report::table_of;
using run::MechanicsResult;
using scene::format_quantity, scene::Load, scene::Scene;
using study::Axis, study::RunOutcome, study::Verdict;
using study::CaseInDetail, study::CaseRow, study::CriticalGap, study::CriticalGapKind, study::FinishedRun,
    study::GapRow, study::not_a_number, study::of_each, study::Reference, study::Study, study::StudyCase,
    study::StudyFile, study::StudyOptions;
using surface::SkinModel;
using trace::BottomTrace;

// Every kind, and what its tables hold.
Kind critical_gap_kind(), calibration_kind(), sensitivity_kind(), accuracy_kind(), stability_kind();
std::vector<ReportTable> critical_gap_results(), calibration_results(), sensitivity_results(),
    accuracy_results(), stability_results();

/// Adds what came to nothing, unless another shard runs it.
template <class Ended>
void add_failure(std::vector<Failure>& failures, const std::string& label, const Ended& ended) {
  if (!ended.failure.empty() && ended.outcome != RunOutcome::other_shard)
    failures.push_back({label, ended.failure, ended.outcome});
}

/// Of a kind that has a row for every case.
template <class Result>
std::vector<Failure> failures_of(const Result& result) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    add_failure(failures, result.study.cases.label(i), result.rows[i]);
  return failures;
}

/// Kind::run from the function that runs a study of the kind, and the one that says what failed of its
/// result. The report is that of the whole study: a shard and an interrupted study have none.
template <auto run, auto failures>
StudyOutcome outcome_of(const StudyFile& study, const StudyOptions& options) {
  const auto result = run(study, options);
  StudyOutcome outcome{result.interrupted, failures(result), result.timing, {}};
  if (!result.interrupted && options.shard.whole()) outcome.report = report_of(result);
  return outcome;
}

/// Whether a gap of the study ignites in any case, so that T max jumps to that of a burning skin.
inline bool any_ignites(const std::vector<CaseRow>& rows, std::size_t gap) {
  return std::ranges::any_of(rows, [gap](const CaseRow& row) {
    return row.gaps.size() > gap && row.gaps[gap].ignition.has_value();
  });
}

/// K, T max at a gap of the study; `inert`: of a skin that does not react. NaN of a case that failed.
inline double temperature_of(const CaseRow& row, std::size_t gap, bool inert) {
  if (!row.completed()) return not_a_number;
  return inert ? row.gaps[gap].heated : row.gaps[gap].maximum.temperature;
}

/// m, of a case that completed; NaN where it is no number.
inline double critical_gap_number(const CaseRow& row) {
  return row.critical.kind == CriticalGapKind::value ? row.critical.value : not_a_number;
}

inline bool is_bound(const CaseRow& row) {
  return row.critical.kind == CriticalGapKind::all_safe || row.critical.kind == CriticalGapKind::all_ignite;
}

/// Cases that came to nothing.
std::size_t count_failed(const std::vector<CaseRow>& rows);

/// "completed", how the run ended instead, or "failed" where it never was.
std::string status_of(const CaseRow& row);

/// Why a case has no numbers, or no bounds; else empty.
inline std::string remark_of(const CaseRow& row) { return row.completed() ? row.incomplete : row.failure; }

/// Where a case lies, or its label if it has no coordinates.
std::string name_of(const std::vector<ShownKey>& keys, const StudyCase& input);

/// What failed and why, at most three by name: "496 MPa, 30 µm (energy drift); ...; and 4 more". By label
/// where no keys are given.
std::string failures_list(const std::vector<ShownKey>& keys, const StudyFile& study,
                          const std::vector<CaseRow>& rows);

/// What must be said where limiters acted; else empty.
std::string limited_text(const std::vector<CaseRow>& rows, const std::string& noun);

/// The lines of an answer below each other; empty ones are left out.
std::string joined_lines(std::vector<std::string> lines);

/// A part of something that is told with it, as a row of a table.
template <class Whole, class Part>
struct PartOf {
  const Whole* whole;
  Part part;
};

/// What there is to say of both.
template <class Whole, class Part>
Quantities<PartOf<Whole, const Part*>> with_whole(const Quantities<Whole>& of_whole,
                                                  const Quantities<Part>& of_part) {
  using Both = PartOf<Whole, const Part*>;
  return joined<Both>(
      {keys::of_part<Both>(of_whole, &Both::whole), keys::of_part<Both>(of_part, &Both::part)});
}

/// A row for every part of all, which `list` has.
template <class Part, class Whole, class List>
std::vector<PartOf<Whole, const Part*>> parts_of(const std::vector<Whole>& all, List list) {
  std::vector<PartOf<Whole, const Part*>> rows;
  for (const Whole& whole : all)
    for (const Part& each : std::invoke(list, whole)) rows.push_back({&whole, &each});
  return rows;
}

/// A case with its row, and where it lies.
struct PlacedCase {
  const StudyFile* study;
  std::size_t index;
  const CaseRow* row;
  const std::vector<double>& coordinates() const { return study->cases.coordinates(index); }
  const std::string& label() const { return study->cases.label(index); }
  StudyCase input() const { return study->cases[index]; }
};
std::vector<PlacedCase> placed(const StudyFile& study, const std::vector<CaseRow>& rows);
Quantities<PlacedCase> placed_axes(const Study& study);

// --- what reads the study files of several kinds: keys, tables of published results, the scene that cases
// start from, and [[vary]] ---

// What all readers of study files speak of.
using scene::above, scene::above_to, scene::any_number, scene::at_least, scene::between, scene::required,
    scene::usually;
using scene::allowed_text, scene::error_at, scene::found_text;
using scene::Dimension, scene::Key, scene::KeyDescription, scene::Place, scene::Standing, scene::Value;
using scene::Expected, scene::Limits, scene::range_key, scene::SceneFile;
using scene::flag_key, scene::list_key, scene::number_key, scene::text_key, scene::word_key;
using study::Change, study::Leaf;

using StudyKeys = std::vector<Key<Study>>;

// Readers of study files throw what is wrong; kinds::read_study gives it back as a value.

/// What was read, or else refused.
template <class Read>
Read taken(Expected<Read> read) {
  return std::move(read).or_throw();
}

/// Keys of every kind, with the kind itself.
const StudyKeys& common_keys();
/// Gaps to judge; where the search for the critical gap ends; all that verdicts rest on besides: spreads,
/// stated numerics, other constants, what is accepted; a file of published rows.
StudyKeys gaps_keys(), search_keys(), verdict_keys(), reference_keys();
/// Refuses a reason that is none in words, and stated numerics without value or ground.
void check_reasons(const StudyFile& study);

/// The settings of a kind as keys of the study that holds them.
template <class Settings>
StudyKeys own_keys(const std::vector<Key<Settings>>& keys) {
  StudyKeys result;
  for (const Key<Settings>& key : keys) {
    Key<Study> lifted{KeyDescription(key), {}, {}};
    lifted.set = [key](Study& study, const Value& value) { key.set(settings_of<Settings>(study), value); };
    lifted.get = [key](const Study& study) { return key.get(settings_of<Settings>(study)); };
    result.push_back(std::move(lifted));
  }
  return result;
}

/// The default of a key for documentation; empty for a value that stands for none.
std::string default_text(const KeyDescription& key, const Value& value);

/// A table of a study file with the keys of one of its entries, for documentation.
template <class Owner>
StudyTable study_table_of(const std::string& name, const std::vector<Key<Owner>>& keys) {
  StudyTable table{name, {}};
  for (const Key<Owner>& key : keys) {
    scene::DocumentedKey entry{key, default_text(key, key.default_value())};
    entry.description.name = name + "." + key.name;
    table.keys.push_back(std::move(entry));
  }
  return table;
}

StudyTable reference_table(), vary_table();

/// Reads [[reference]], or the file that holds them, into Study::references.
void read_references(const StudySource& source, StudyFile& study);

/// Scene keys with other values than the scene has: a table of the study file, by its name there. No node:
/// none.
struct OverrideTable {
  std::string name;
  const toml::node* node = nullptr;
};

/// The changes that a table asks of a scene, or what is wrong with a value. A key that the scene does not
/// know is refused in any case. `written`: how the table is written.
Expected<std::vector<Change>> changes_in(const OverrideTable& table, const std::string& file,
                                         const std::string& written, const SceneFile& scene);

/// Reads the scene that the study names, its constants, then the overrides, in their order, and the other
/// constants.
void settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides, StudyFile& study);

/// Reads all entries into Study::axes. Needs the study's scene and overrides. An entry that the
/// kind does not admit is refused.
void read_vary(const StudySource& source, const Varied& admitted, StudyFile& study);

}  // namespace launchsafe::kinds

// The study of kind accuracy: what settings cost, and how wrong the answers are that users decide by.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::kinds {

/// What one [[settings]] does to one scene key, a change for every value.
using SettingsAxis = std::vector<study::Change>;

/// One [[variant]] of a study file: what the file says of all, and what the variant says otherwise, as a
/// study of its own.
struct AccuracyVariant {
  std::string name;
  study::StudyFile study;
};

/// What a study file of this kind says besides.
struct AccuracySettings {
  std::vector<double> reference_cell_sizes;         ///< m, finest first once read; at least three
  std::vector<std::vector<SettingsAxis>> settings;  ///< every combination within each
  std::vector<AccuracyVariant> variants;            ///< none for a file that is one study by itself
};

/// What the reference meshes tend to. T max and critical gap are those of the record: their limits may be off
/// by what no mesh has exact.
struct AccuracyReference : study::RecordedReference {
  std::vector<bool> inert;  ///< for every gap: of a skin that does not react, since one ignites
};

/// One setting: what its run came to, and how far that is from the reference. Errors are signed: this minus
/// the extrapolated value; NaN where one of them is none.
struct AccuracyRow {
  study::CaseAnswer answer;       ///< or why there are no numbers
  std::string validity_warnings;  ///< why its numbers are no basis for a verdict; empty for a sound run
  /// Its cost and, of T max and the critical gap, what is compared and the bounds of the error. The processor
  /// time is the wall time where the run did not note it.
  study::RecordedSetting setting;

  // found by comparing
  bool baseline = false;                                   ///< the scene as it is
  bool other_model = false;                                ///< its difference is no numerical error
  std::vector<double> temperature_error;                   ///< K, for every gap
  double largest_temperature_error = study::not_a_number;  ///< K, absolute
  double critical_gap_error = study::not_a_number;         ///< m
  bool computed() const { return answer.completed(); }
  bool sound() const { return computed() && validity_warnings.empty(); }
};

/// What came of one variant, or of a study without variants, whose only one has no name.
struct VariantAccuracy {
  std::string name;
  study::StudyFile study;
  std::vector<AccuracyRow> rows = {};               ///< one for each of its cases
  std::optional<AccuracyReference> reference = {};  ///< none where a reference mesh failed
  std::string no_reference = {};                    ///< why there is none
  study::AccuracyRecord record = {};                ///< for the studies that use these settings
  /// There is no reference, or no extrapolation of a temperature is justified.
  bool any_indeterminate() const;
  const AccuracyRow* baseline() const;  ///< that of the scene as it is; nullptr where it did not run soundly
  /// K, by which the reference of T max itself may be off: the largest over the gaps; NaN where not known.
  double reference_uncertainty() const;
};

struct AccuracyResult : StudyResult {
  std::vector<VariantAccuracy> variants;  ///< at least one; their cases follow each other
  bool any_indeterminate() const;         ///< of any variant
};

AccuracyResult run_accuracy(const study::StudyFile& study, const study::StudyOptions& options = {});
/// How wrong the own setting of the first variant is, what the cheapest good settings are.
std::string answer(const AccuracyResult& result);
report::Report report_of(const AccuracyResult& result);

/// A row for every variant: how wrong its own setting is.
report::Table variant_table(const AccuracyResult& result);
/// A row for every setting, and for every compared quantity: of all variants that have a reference, with
/// their names in front where there are several.
report::Table setting_table(const AccuracyResult& result);
report::Table reference_table(const AccuracyResult& result);

/// Distance of T max from its limit against processor time.
report::Plot error_plot(const VariantAccuracy& variant);

}  // namespace launchsafe::kinds

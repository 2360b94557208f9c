// The study of kind accuracy: what settings cost, and how wrong the answers are that users decide by.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/rows.hpp"

namespace launchsafe::kinds {

/// What one [[settings]] does to one scene key, a change for every value.
using SettingsAxis = std::vector<study::Change>;

/// What a study file of this kind says besides.
struct AccuracySettings {
  std::vector<double> reference_cell_sizes;         ///< m, finest first once read; at least three
  std::vector<std::vector<SettingsAxis>> settings;  ///< every combination within each
};

/// Values of the reference meshes, finest first, and their limit.
struct ReferenceValue {
  std::vector<double> values;  ///< none where a mesh has none
  math::Extrapolation limit;
  /// In the unit of the values, >= 0: by how much the limit itself may be off, as the meshes share numerics
  /// that are not exact; NaN where no setting shows what the exact value changes.
  double inexactness = 0;
};

/// What the reference meshes tend to.
///
/// The meshes differ in the cell size alone and share all other numerics with the scene. Their limit is free
/// of the error of the cells. Where they have a key such as numerics.inertial_scaling at another value than
/// the exact one, the limit is off by what that changes. It is known where two settings differ in this key
/// alone, one of them with the exact value: three times the largest such difference counts, as for any limit
/// that two values point to (see math::Extrapolation). Otherwise no bound is known.
struct AccuracyReference {
  std::vector<ReferenceValue> temperature;  ///< K, T max for every gap
  ReferenceValue critical_gap;              ///< m; without values where a mesh has none
  std::vector<bool> inert;            ///< for every gap: of a skin that does not react, since one ignites
  std::vector<std::string> unvaried;  ///< inexact keys that no setting varies: no bound is known
};

/// One setting: the result of its run, and how far that is from the reference. Errors are signed: this minus
/// the extrapolated value; NaN where one of them is none.
struct AccuracyRow {
  std::string label;          ///< "cell_size 2.5 mm"
  study::CaseRow result;      ///< or why there are no numbers
  double cell = 0;            ///< m, sqrt(dx dr) of the charge's smallest cells
  double processor_time = 0;  ///< s; the wall time of a run that did not note it
  bool reference_mesh = false;
  bool baseline = false;     ///< the scene as it is
  bool other_model = false;  ///< it differs from the scene in more than numerics: no numerical error

  // found by comparing
  std::vector<double> temperature;                         ///< K, T max for every gap, as compared
  double critical_gap = study::not_a_number;               ///< m
  std::vector<double> temperature_error;                   ///< K, for every gap
  double largest_temperature_error = study::not_a_number;  ///< K, absolute
  double critical_gap_error = study::not_a_number;         ///< m
  /// Distance from the finest mesh plus the uncertainty of the reference; NaN where that is not known.
  double temperature_bound = study::not_a_number;   ///< K, the largest over the gaps
  double critical_gap_bound = study::not_a_number;  ///< m

  bool computed() const { return result.completed(); }
  /// Warnings about the computation, which no study may accept: "...; ...". Empty without any.
  std::string warnings() const;
  bool sound() const { return computed() && warnings().empty(); }
  /// Sound, and of the scene's model: its difference from the reference is a numerical error.
  bool comparable() const { return sound() && !other_model; }
};

struct AccuracyResult : StudyResult {
  std::vector<AccuracyRow> rows;               ///< one for each of its cases
  std::optional<AccuracyReference> reference;  ///< none where a reference mesh failed
  std::string no_reference;                    ///< why there is none
  const AccuracyRow* baseline() const;  ///< that of the scene as it is; nullptr where it did not run soundly
  /// K, by which the reference of T max itself may be off: the largest over the gaps; NaN where not known.
  double reference_uncertainty() const;
};

AccuracyResult run_accuracy(const study::StudyFile& study, const study::StudyOptions& options = {});
/// How wrong the setting of the scene is, and which settings are the cheapest.
std::string answer(const AccuracyResult& result);
report::Report report_of(const AccuracyResult& result);

/// A row for every setting, and for every compared quantity; none without a reference.
report::Table setting_table(const AccuracyResult& result);
report::Table reference_table(const AccuracyResult& result);

/// Distance of T max from its limit against processor time.
report::Plot error_plot(const AccuracyResult& result);

}  // namespace launchsafe::kinds

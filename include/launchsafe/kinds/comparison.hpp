// The study of kind comparison: the same scene under several named variants, side by side. It compares
// numbers and judges no gap: verdicts are those of critical-gap, which counts what is uncertain.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::kinds {

/// The scene as it is, which comes first, or with the keys of one of its variants.
struct Variant {
  std::string name, description;     ///< what it is, for people; the second may be empty
  std::string record;                ///< path of that of its own calibration; empty: the study's
  std::vector<std::string> changes;  ///< "numerics.cell_size = 2.5 mm": what it has otherwise than the scene
  scene::Scene scene;                ///< that its cases start from
  study::Study judged;               ///< the study with the constants of this variant
  std::optional<study::CalibrationRecord> calibration;  ///< of the record that it names, or the study
};

/// What a study file of this kind says besides.
struct ComparisonSettings {
  std::string name = "as in the scene";  ///< of the scene without changes
  std::string description;               ///< what that is, for people; may be empty
  std::vector<Variant> variants;         ///< the scene as it is, then those of the file
};

/// One case of one variant.
struct ComparedCase : study::CaseAnswer {
  std::size_t variant = 0;  ///< of ComparisonSettings::variants
  /// T max of every station for every gap, of a skin that air and friction heat and that does not react:
  /// after ignition all stations are as hot as the flame.
  std::vector<std::vector<study::StationTemperature>> stations;  ///< none for a run without a result
  double processor_time = study::not_a_number;                   ///< s, of its run
};

struct ComparisonResult : StudyResult {
  std::vector<ComparedCase> answers;  ///< one for each of StudyFile::cases
  const std::vector<Variant>& variants() const {
    return settings_of<ComparisonSettings>(study.study).variants;
  }
  /// The cases of a variant follow each other in the order of the peak pressures.
  std::size_t cases_per_variant() const { return study.cases.size() / variants().size(); }
  /// The case of the scene as it is under the same pressure.
  std::size_t counterpart(std::size_t index) const { return index % cases_per_variant(); }
  bool any_indeterminate() const;  ///< a critical gap is
};

/// Runs a study of kind comparison. A case's failure is that case's row. Apart from times the result depends
/// on the study alone.
ComparisonResult run_comparison(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The scene's critical gap, and how far the variants move it.
std::string answer(const ComparisonResult& result);
report::Report report_of(const ComparisonResult& result);

/// What is said, tabled, drawn and written of other models; nothing where a comparison is of no calibrated
/// models. Then what its tables hold, but for the pressures of a study.
void add_model_form(const ComparisonResult& result, report::Report& report);
std::vector<report::ReportTable> model_form_results();

}  // namespace launchsafe::kinds

// What a verdict's uncertainty is made of: the computation itself, as stated, from an accuracy record, or
// assumed; the calibrated constants; and what is not known of the launch.
#pragma once

#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/study/verdict.hpp"

namespace launchsafe::study {

/// Two standard deviations (coverage_factor) that are assumed of a launch of which a study states no input
/// uncertainty: the chamber pressure from round to round, as in the shipped sensitivity study, the
/// temperature of the charge, and the length of the pulse at the same peak.
inline constexpr double assumed_load_spread = 0.04;
inline constexpr double assumed_temperature_spread = 12.0;  ///< K
/// Of what cooling opens: the temperatures by which charge and shell fitted and are fired differ by as much
/// more, and they expand by a quarter more unequally, which holds what is plausible of the charge.
inline constexpr double assumed_expansion_spread = 0.25;
/// m, by which a gap that opened by cooling may be thicker; 0 of one that is stated.
double cooling_spread(const scene::Scene& scene);
/// Of the length of the pulse: a launch that lasts longer leaves the hot air more time.
inline constexpr double assumed_pulse_spread = 0.05;

/// Heat grows with the square of the pressure where the steel stays elastic; near 496 MPa, where the wall of
/// the 155 mm shell yields, with its power of 3.6 (17 K of 116 K for 4 %). Rounded up.
inline constexpr double heat_exponent = 4.0;

/// How far a skin without reaction is heated (K) above the initial temperature: by friction, and by the air
/// of a gap in addition.
struct Rises {
  double friction = 0;
  double air = 0;
};

/// K, uncertainty of T max by the calibrated constants: the stated one, or that of the
/// calibration. It is that of the rows that the constants were fitted to; their relative errors are carried
/// to the case's own rises. Another load shape was held out in no row but those at another time, and other
/// numerics have another mesh error than the constants absorbed: both add to it. Where firings calibrated, it
/// is what a factor on the launch's own heat adds (`heat_factor`), no less than stated. 0 for a study without
/// verdicts.
double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises, double heat_factor);

/// By which the heat of a launch may be larger for all that its firings leave open of the constants, under
/// either prior, without a gap or at one (m), whichever is more. 1 where no firings calibrated; infinite
/// where nothing tells.
double heat_factor(const Study& study, const scene::Scene& scene, const trace::BottomTrace& trace,
                   double gap);

/// What the study states of the model form, or assumes where its record does not speak of a case, K.
/// Nothing where the record does: it gives a shift of the gap (`recorded`).
std::optional<double> stated_model_form_share(const Study& study, const StudyCase& input,
                                              const ModelFormShift& recorded);
/// Shares of the bounds of a case that are assumed, as neither the study nor a record speaks of it.
struct AssumedShares {
  bool computation = false, model_form = false;
  bool any() const { return computation || model_form; }
  std::string text() const;  ///< "computation, model form"; empty for none
};
/// Those of a case with a critical gap (m).
AssumedShares assumed_shares(const Study& study, const StudyCase& input, double critical_gap);

/// K, as a study states it for its own scene; it grows with the pressure as the heat does.
double stated_input_share(const Study& study, const StudyCase& input);

/// What the measured curve of a load may have wrong, as shares of the rises; 0 for an analytic load.
struct LoadCurveErrors {
  double of_friction = 0;  ///< the noise of a gauge heats by friction; swings that smoothing took out did
  double of_both = 0;      ///< what smoothing took from the peak
  double in_kelvin(const Rises& rises) const {
    return rises.friction * of_friction + (rises.friction + rises.air) * of_both;
  }
};
LoadCurveErrors load_curve_errors(const scene::Load& load);

/// What all cases of a study rest on, each once.
struct AcceptancesOfStudy {
  std::vector<scene::Implausible> accepted;  ///< by key and by what the user writes as its value
  std::vector<scene::Implausible> missing;   ///< by key and value
  std::vector<std::string> extrapolated;     ///< as in the reasons of verdicts
};
AcceptancesOfStudy acceptances_of(const StudyFile& study);

/// Those that a study names. Refused are: none there, no record, or a stated uncertainty beside it.
AccuracyRecords read_records(StudyFile& study, const std::filesystem::path& folder);

/// Puts the cheapest recorded setting within the tolerance (K) into the study's scene. Needs the overrides.
void choose_setting(StudyFile& study, const AccuracyRecords& records, double tolerance);

/// Numerical uncertainty of each case of the study, known once the case is made. Without a statement, or
/// elsewhere than it holds, nothing is known, and a large one is assumed, so that no verdict is SAFE on the
/// strength of silence.
void settle_uncertainty(StudyFile& study, const AccuracyRecords& records);

/// Of all cases of a study, each of which is made for it.
struct NumericalUncertainty {
  double largest = 0;    ///< K, of T max
  bool assumed = false;  ///< for some case
  std::string source;    ///< where it comes from, a clause
};
NumericalUncertainty numerical_uncertainty_of(const StudyFile& study);

/// "it was made at ... (20 of 45 cases); ... (4 of 45 cases)": reasons of some cases, the commonest first.
std::string commonest_first(const std::map<std::string, std::size_t>& reasons, std::size_t cases);

/// K, of T max of a gap (m) by mesh, step and scaling, where T max is `rise` (K) above the initial
/// temperature.
double numerical_share(const StudyCase& input, double gap, double rise);

/// The same of a launch in which a gap closes.
struct ClosingShare {
  double kelvin = assumed_numerical_uncertainty;
  bool recorded = false;  ///< rather than assumed
};
/// Of a case whose gap (m) closes as `closing` has it, by a record that was made of a gap closing on those
/// very terms (base, roughness, release), at no lower a pressure, temperature, localisation and defect, and
/// up to no thinner a gap: nothing is carried beyond. A record of the reservoir says nothing of it.
ClosingShare closing_share(const StudyCase& input, const scene::Scene& closing, double gap, double rise);

}  // namespace launchsafe::study

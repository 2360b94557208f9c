// What a calibration found, on published results or on firings, kept for the studies that use its constants.
// What firings say of these constants: which of them, from a stated prior, agree with rounds that ignited and
// rounds that did not (Bayes), and how much more heat a launch has to bear for that.
#pragma once

#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/surface/ignition_boundary.hpp"

namespace launchsafe::study {

inline constexpr int most_rounds = 100'000;  ///< of one firing

/// Rounds as severe as a launch without which nothing is SAFE: where none of so many ignites, one does with
/// less than 5 %, by 95 % (Clopper and Pearson, 1 - 0.05^(1/59)).
inline constexpr int fewest_rounds = 59;

/// Rounds of one kind that ended alike.
struct Firing {
  std::string name;
  bool ignited = false;
  int rounds = 1;
  double pressure = math::not_a_number;            ///< Pa, mean peak pressure
  double pressure_spread = math::not_a_number;     ///< Pa, standard deviation between rounds
  double temperature = math::not_a_number;         ///< K, mean, of charge and air
  double temperature_spread = math::not_a_number;  ///< K, likewise
  double gap = 0;       ///< m, the least that it can have been: what a thicker one shows is not known
  double most_gap = 0;  ///< m, the largest that it can have been

  bool operator==(const Firing&) const = default;
};

/// Pa, the peak pressure by which a launch is held against firings: that of the scene; of a measured curve
/// that is not scaled, that of its points.
double fired_pressure(const scene::Load& load);
/// m, up to which firings speak of a launch of a peak pressure (Pa) and temperature (K): the largest gap that
/// did not ignite at no less of both, and thinner than any that ignited at no more of both; below 0 without
/// one.
double calibrated_gap(const std::vector<Firing>& firings, double pressure, double temperature);

/// What is believed of the constants before any firing: logarithms of localisation and exchange time and the
/// ignition temperature are normal and independent. Rounds that are fired alike differ in what no record
/// tells, such as flaws: the heat of a round has a factor whose logarithm is normal about 0, and whose
/// standard deviation, the scatter, is not known either; its logarithm is normal.
struct FiringPrior {
  surface::SurfaceConstants centre;
  double log_localisation = 0.4;       ///< standard deviation
  double log_exchange_time = 0.7;      ///< likewise
  double ignition_temperature = 30.0;  ///< K, likewise
  /// K: a charge of a lower one would have ignited where it lay.
  double least_ignition_temperature = 0.0;
  double scatter = 0.05;     ///< median
  double log_scatter = 0.7;  ///< standard deviation
  /// With all standard deviations so many times as large.
  FiringPrior widened(double factor) const;
  /// Over which the posterior is sought: this many standard deviations on both sides.
  surface::Extent ignition_temperatures() const;  ///< K
  surface::Extent log_products() const;           ///< of IgnitionBoundary
};

/// One of many combinations that are equally probable.
struct PosteriorPoint {
  surface::SurfaceConstants constants;
  double scatter = 0;  ///< of the logarithm of a round's heat
};
using Posterior = std::vector<PosteriorPoint>;

/// A calibration on firings of the shell itself, rather than on published temperatures.
struct FiringEvidence {
  std::vector<Firing> firings;
  Posterior posterior;         ///< under the prior as stated
  Posterior of_doubled_prior;  ///< with all its widths doubled: what SAFE rests on must hold there too
  bool demonstration = false;  ///< the firings are invented, to show the way
};

/// A kind of round with what its launch needs to ignite.
struct FiredLaunch {
  surface::IgnitionBoundary boundary;
  double log_heat_spread = 0;  ///< by the spreads of pressure and temperature
  int rounds = 1;
  bool ignited = false;
};

/// The posterior on a lattice of the prior, `nodes` (odd, 5 at the least) of localisation and of exchange
/// time, half as many of the others, as so many points that are equally probable; none where nothing within
/// the prior explains the firings. A pure function of its arguments.
Posterior posterior_of(const FiringPrior& prior, const std::vector<FiredLaunch>& launches, int nodes = 25,
                       std::size_t points = 400);

/// The probability that a round ignites, for every point.
std::vector<double> ignition_probabilities(const Posterior& posterior,
                                           const surface::IgnitionBoundary& boundary, double log_heat_spread);

/// How probable it is, over all points (with the probabilities that a round ignites), that no more of so many
/// rounds ignite, or no fewer, whichever is less: below some per cent the firings contradict the model.
double tail_probability(const std::vector<double>& probabilities, int ignited, int rounds);

/// The boundary of a gap (m) for all points of a posterior and for the model's own constants.
std::optional<surface::IgnitionBoundary> boundary_for(const Posterior& posterior,
                                                      const surface::SkinModel& model,
                                                      const trace::BottomTrace& trace, double gap);

/// Which share of the rounds, over all that is not known, is closer to ignition than SAFE counts with.
inline constexpr double firing_risk = 0.01;

/// The factor on the heat of a launch with `constants`, 1 at the least, after which it is as close to
/// ignition as all but `firing_risk` of the rounds at most are. Infinite without points.
double heat_factor(const Posterior& posterior, const surface::IgnitionBoundary& boundary,
                   const surface::SurfaceConstants& constants);

/// Weighted evenly: the value that a share of the values lies below; NaN of none.
double quantile_of(std::vector<double> values, double share);

/// Largest change of the end temperature of any station without a gap, with the constants of one mesh, to a
/// finer mesh and from a coarser one.
struct StationConvergence {
  double finer = not_a_number;    ///< K
  double coarser = not_a_number;  ///< K
  /// By the rule of studies/model_form/README.md.
  bool converges() const;
};

/// The calibrated launch, how well it meets what is published, and whether its stations converge; or why
/// there is no calibration. Of one on firings the launch with the constants at the middle of their posterior,
/// and nothing after `calibration`.
struct CalibrationRecord {
  std::string title;         ///< of the calibration
  std::string failure = {};  ///< why no constants meet the rows, and nothing below means anything; else empty
  Calibration calibration;
  bool load_fitted = false;               ///< the shape of the load is calibrated too, not only the constants
  std::string references_digest = {};     ///< SHA-256 of the published rows and of what each was used for
  double ignition_lowest = not_a_number;  ///< K, T max without a trigger at the largest gap that is safe
  double ignition_highest = not_a_number;  ///< K, and at the smallest that ignites: T1 is in the middle
  /// K, below which 95 % of the misfits of temperatures lie, by so many that nothing was fitted to: Student's
  /// factor for their number times their root mean square. NaN without any.
  double misfit_bound = not_a_number;
  int misfits = 0;
  /// Of the logarithms of `fitted_keys`, row by row; empty where the load was not fitted.
  std::vector<double> covariance = {};
  double selection_root_mean_square = not_a_number;  ///< K; NaN where no row was used for selection
  StationConvergence stations = {};                  ///< K; NaN where not measured
};

/// What a calibration with its load fits by least squares, in the order of its covariance.
inline constexpr std::array fitted_keys{"load.peak_time", "load.width", "load.steepness",
                                        "friction.localisation", "gap.exchange_time"};

/// Of a calibration that found no constants.
inline constexpr CalibrationEvidence no_evidence{not_a_number, not_a_number, not_a_number, not_a_number};

/// The record as a file, with the SHA-256 of its content.
std::string to_json_text(const CalibrationRecord& record);
/// Refuses an edited record, one of another model version, one on firings, and a scene that no reader takes.
/// `file` is named in errors.
scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text, const std::string& file);
/// Likewise, or one on firings. Rounds that were made up and a digest that was computed anew are not
/// recognised, as firings that were made up are not: a digest guards against mistakes and idle edits.
/// Constants of the scene that are not those of the posterior buy nothing, as verdicts count with the heat
/// that the posterior asks for.
scene::Expected<CalibrationRecord> parse_either_calibration(const std::string& text, const std::string& file);

/// Reads the record that a study names, if it names one, gives its load and constants to the scene, and notes
/// them among the overrides. A fit uncertainty that the study does not state becomes the record's.
void use_calibration(StudyFile& study, const std::filesystem::path& folder);

/// Reads the record of other models that a study names, if it names one.
void read_model_form(StudyFile& study, const std::filesystem::path& folder);

}  // namespace launchsafe::study

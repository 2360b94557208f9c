// Safe, unsafe or indeterminate: the rules.
#pragma once

#include "launchsafe/study/bracket.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace launchsafe::study {

enum class Verdict { safe, unsafe, indeterminate };
std::string to_string(Verdict verdict);

/// Uncertainty of T max at one gap, K, part by part: to be read beside the margin, while the verdict is
/// judged in gap. A part under which the gap ignites is infinite: all that is known of it is that it is at
/// least the margin.
struct Uncertainty {
  double sampling = 0;     ///< against a trace with half the samples
  double integration = 0;  ///< against a tolerance ten times wider
  double coupling = 0;     ///< largest difference between trace and coupled runs, where confirmed
  double numerical = 0;    ///< of mesh, step and scaling: from an accuracy study, stated, or assumed
  double fit = 0;          ///< of the calibrated constants, carried to this case
  double input = 0;        ///< of what is not known of the launch: its random causes together
  double load_curve = 0;   ///< of a measured curve: what its noise heats, and what smoothing took from it
  double model_form = 0;   ///< by which other models of the launch move towards ignition
  double sliding = 0;  ///< of a base on which the charge slides: all heat of friction, and the gap that opens
  /// Of the computation itself: the sum, since the parts are bounds and have common causes.
  double computed() const { return sampling + integration + coupling + numerical + sliding; }
  /// Of the launch: both may be wrong in the same direction.
  double inputs() const { return input + load_curve; }
  /// As the shares of a critical gap are combined (see gap_share.hpp): `input` holds the random causes, and
  /// the causes of knowledge are added to it.
  double total() const { return input + load_curve + computed() + fit + model_form; }
};

/// All that a verdict rests on.
struct Evidence {
  bool completed = false;          ///< the run ended as it should
  std::string failure;             ///< why not, otherwise
  bool ignited = false;            ///< at a station
  double gap = 0;                  ///< m
  double maximum_temperature = 0;  ///< K, over the stations
  double margin = 0;               ///< K, ignition temperature minus maximum temperature
  double uncertainty = 0;          ///< K
  /// Why a completed run is no basis (see run::validity_warnings); empty for a sound one.
  std::string validity_warnings = {};
  /// What of the input is not plausible, or foreign to the calibration, and not accepted; empty for nothing.
  std::string unaccepted = {};
  /// K, margin with the constants of the surface as calibrated; infinite where they are.
  double calibrated_margin = std::numeric_limits<double>::infinity();
  std::string optimistic = {};  ///< why no ignition shows nothing, for people; empty where it shows something
  std::string limited = {};     ///< limiters that acted, for people; empty where none did
  std::string noise = {};       ///< what the noise of a measured curve counts, for people; empty for nothing
  std::string ring = {};        ///< that a measured curve rings, for people; empty where it does not
  std::string accepted = {};    ///< what is not plausible and why it is meant, for people; empty: nothing
  std::string model_form = {};  ///< models that could change the verdict, for people; empty: none
  std::string extrapolated = {};  ///< what lies outside the calibration's domain, for people; empty: nothing
};

/// The rule of the contract below that decided.
enum class ReasonCode {
  failed,
  no_temperature,
  validity_warning,
  ignition,
  not_accepted,
  no_margin,
  optimistic,
  critical_gap_indeterminate,
  several_crossings,
  ignites_at_smaller_gaps,
  no_lower_bound,
  above_lower_bound,
  below_lower_bound,
  within_uncertainty,
  within_uncertainty_as_calibrated,
  over_uncertainty
};
std::string to_string(ReasonCode code);

struct Judgement {
  Verdict verdict = Verdict::indeterminate;
  std::string reason;  ///< the cause, and what else the evidence says, for people
  ReasonCode code = ReasonCode::failed;
  std::string cause = {};  ///< what decided, for people
};

/// The contract of a verdict, for a sound run: one that completed with finite temperatures and without
/// validity warnings of its own. Every other run is INDETERMINATE.
///
/// - UNSAFE: the gap ignites in the computation as it is stated, whatever of its input nobody accepts.
/// - SAFE: all of the input is plausible and of the calibration, or accepted; the gap does not ignite, and is
///   thinner than the lower bound of the critical gap (CriticalGap::bounds). Where nothing ignites up to the
///   end of the search, that is the bound, and the margin must exceed the uncertainty besides, also with the
///   constants of the surface as calibrated.
/// - INDETERMINATE: everything else.
///
/// More uncertainty, a wider range or less evidence never moves a verdict towards SAFE. A verdict on a run in
/// which limiters acted says so.
Judgement judge(const Evidence& evidence, const CriticalGap& critical);

}  // namespace launchsafe::study

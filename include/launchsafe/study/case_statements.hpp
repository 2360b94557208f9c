// What the input of a case says of all its verdicts. It is found once a case and never stored: a verdict that
// is read rests on what its input says now.
#pragma once

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/study/model_form.hpp"
#include "launchsafe/study/record_domain.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace launchsafe::study {

struct Study;
struct StudyCase;

/// Calibres of travel: no barrel is shorter.
inline constexpr double fewest_calibres = 10.0;
/// K, by which friction heats the bottom of a charge that was launched, at the least.
inline constexpr double least_friction_rise = 1.0;

/// Why a case that does not ignite is not safe for that, whatever it accepts.
struct Optimistic {
  enum class Why {
    nothing,
    film,          ///< air as a film that conserves energy is a bound on that side
    cooling,       ///< `cooling` only averages or removes heat beside the calibrated model
    short_travel,  ///< the launch ends after `number` calibres of travel
    unheated       ///< friction heats the bottom by `number` K: it was not launched
  };
  Why why = Why::nothing;
  std::vector<std::string> cooling = {};
  double number = 0;
  explicit operator bool() const { return why != Why::nothing; }
};

struct CaseStatements {
  std::vector<std::string> uncovered_load;  ///< of run::uncovered_load
  Optimistic optimistic;                    ///< by the input alone; a study without verdicts knows films only
  std::string ring;  ///< that a measured curve rings, for people; empty for none; in detail with
                     ///< a mode of the shell (run::ring_text)

  bool closes = false;  ///< gaps are to be looked at as they close, too

  // The rest is empty for a study without verdicts.
  RecordDistance distance;                      ///< to the calibration
  std::vector<scene::Implausible> implausible;  ///< of the case and of what its study states, accepted or not
  std::vector<std::string> extrapolated;  ///< what lies beyond the calibration's domain at any gap, by name
  /// m, up to which a gap lies within it.
  double calibrated_gap = std::numeric_limits<double>::infinity();
  bool calibrated_by_firings = false;  ///< so that nothing is known of a gap beyond
  bool demonstration = false;          ///< of something that was invented

  /// Of the study's record of other models; not known where there is none.
  ModelFormShift model_form{std::nan(""), std::nan(""), {}};

  /// What is implausible, and what is foreign to the calibration.
  std::vector<scene::Implausible> to_be_accepted() const;
  /// Whether something is not plausible, or foreign to the calibration, and nobody accepts it.
  bool has_unaccepted() const;
  /// Whether a gap (m) lies beyond those of the calibration.
  bool is_beyond(double gap) const;
};

CaseStatements statements_of(const Study& study, const StudyCase& input);

/// Of what its run shows: a bottom that friction hardly heats (`friction_rise`, of T max without a gap, K)
/// was not launched.
Optimistic optimistic_by_run(double friction_rise);

}  // namespace launchsafe::study

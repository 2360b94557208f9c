// Safe, unsafe or indeterminate: the rules (model section 7).
#pragma once

#include "launchsafe/study/bracket.hpp"

#include <string>

namespace launchsafe::study {

enum class Verdict { safe, unsafe, indeterminate };
std::string to_string(Verdict verdict);

/// Uncertainty of a maximum temperature, K, part by part.
struct Uncertainty {
  double sampling = 0;     ///< against a trace with half the samples
  double integration = 0;  ///< against a tolerance ten times wider
  double coupling = 0;     ///< largest difference between traced and coupled runs, where confirmed
  double numerical = 0;    ///< of the mesh, as stated in the study
  /// The sum: the parts are bounds, not deviations.
  double total() const { return sampling + integration + coupling + numerical; }
};

/// All that a verdict rests on.
struct Evidence {
  bool completed = false;          ///< the run ended as it should
  std::string failure;             ///< why not, otherwise
  bool ignited = false;            ///< at an observation point
  double gap = 0;                  ///< m
  double maximum_temperature = 0;  ///< K, at the observation points
  double margin = 0;               ///< K, ignition temperature minus maximum temperature
  double uncertainty = 0;          ///< K
};

struct Judgement {
  Verdict verdict = Verdict::indeterminate;
  std::string reason;
};

/// Unsafe: ignition. Safe: none, the margin exceeds the uncertainty, and so does the distance to the critical
/// gap. Indeterminate: everything else; a failed or undefined computation never is anything else.
Judgement judge(const Evidence& evidence, const CriticalGap& critical);

}  // namespace launchsafe::study

// The criterion under which a user recommends a largest gap. None is built in.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <limits>
#include <string>
#include <vector>

namespace launchsafe::report {

/// A row of a verdict table, as far as a criterion asks.
struct JudgedGap {
  double gap = 0;  ///< cm
  bool safe = false;
  double margin = 0;                                           ///< K, ignition temperature minus T max
  double uncertainty = 0;                                      ///< K, of the margin
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< cm, to the critical gap; NaN without one
  double distance_uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< cm, of the critical gap
  double temperature = std::numeric_limits<double>::quiet_NaN();           ///< K, T max
  /// Upper end, of 95 %, of the probability that it ignites; NaN where nothing shows it.
  double probability = std::numeric_limits<double>::quiet_NaN();
};

/// Conditions that a gap must meet besides the verdict SAFE.
struct GapCriterion {
  struct Condition {
    double JudgedGap::*of;
    double JudgedGap::*unit = nullptr;  ///< an uncertainty; null: K, cm
    double limit = 1.0;                 ///< in that unit
    bool at_most = false;               ///< else at least
  };
  std::string text;    ///< as the user wrote it, on one line
  std::string source;  ///< who asks for it, likewise
  std::vector<Condition> conditions;

  bool met_by(const JudgedGap& row) const;
};

/// Reads "T max <= 450 K", "margin >= 2 uncertainty", "margin >= 20 K", "distance >= 0.01 cm", "distance >= 1
/// uncertainty", "probability <= 0.05", or several of them with "and" between, with blanks or without.
/// Margins are in K, distances are those to the critical gap in cm (or mm). Numbers must be positive; one
/// uncertainty is part of SAFE already, so fewer are refused. Errors: any other text, no source.
scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source);

/// The place of the largest computed gap that meets the criterion together with every smaller computed one;
/// `rows.size()` where there is none. Only gaps that were computed count: nothing is interpolated.
std::size_t largest_gap_under(const GapCriterion& criterion, const std::vector<JudgedGap>& rows);

}  // namespace launchsafe::report

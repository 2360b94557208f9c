// The criterion under which a user recommends a largest gap. It comes from the user; none is built in.
#pragma once

#include "launchsafe/report/page_texts.hpp"

namespace launchsafe::report {

/// Conditions that a gap must meet besides the verdict SAFE.
struct GapCriterion {
  struct Condition {
    const char* of;              ///< member of a verdict's row
    const char* unit = nullptr;  ///< another, an uncertainty; null: K, cm
    double limit = 1.0;          ///< in that unit
    bool at_most = false;        ///< else at least
  };
  std::string text;    ///< as the user wrote it, on one line
  std::string source;  ///< who asks for it, likewise
  std::vector<Condition> conditions;

  /// A row of a verdict table, with distance_cm to the critical gap and distance_uncertainty_cm where that is
  /// a value, and with the upper end, of 95 %, of the probability that the gap ignites where one is shown.
  /// What a row lacks meets no condition.
  bool met_by(const Row& verdict) const;
};

/// Reads "T max <= 450 K", "margin >= 2 uncertainty", "margin >= 20 K", "distance >= 0.01 cm", "distance >= 1
/// uncertainty", "probability <= 0.05", or several of them with "and" between, with blanks or without.
/// Margins are in K, distances are those to the critical gap in cm (or mm). Numbers must be positive; one
/// uncertainty is part of SAFE already, so fewer are refused. Errors: any other text, no source.
scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source);

/// cm: the largest computed gap that meets the criterion together with every smaller computed one. Only gaps
/// that were computed count: nothing is interpolated.
std::optional<double> largest_gap_under(const GapCriterion& criterion, std::vector<Row> verdicts);

}  // namespace launchsafe::report

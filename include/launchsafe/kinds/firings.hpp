// A study of kind calibration whose rows are firings of the shell: what they leave of the constants that the
// published record has.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What a study file with [[firing]] says besides.
struct FiringSettings {
  std::vector<study::Firing> firings;
  double localisation_factor = 1.5;    ///< of one standard deviation of the prior
  double exchange_time_factor = 2.0;   ///< likewise
  double ignition_temperature = 30.0;  ///< K, one standard deviation
  double scatter = 0.05;               ///< median of the prior
  std::vector<double> next_gaps;       ///< m, among which the next one to fire is sought
  study::FiringPrior prior_about(const surface::SurfaceConstants& centre) const;
};

/// The launch of one peak pressure and temperature.
struct FiredCondition {
  study::StudyCase input;
  run::MechanicsResult mechanics;
  study::RunOutcome outcome = study::RunOutcome::ran;
  std::string failure;  ///< why it is no evidence; empty where it is
};

/// The probability that a round ignites by the posterior: its mean, and where its middle 90 % lie.
struct IgnitionProbability {
  double mean = study::not_a_number, lowest = study::not_a_number, highest = study::not_a_number;
};

/// One firing beside what is computed of it.
struct FiringRow {
  study::Firing firing;
  std::size_t condition = 0;  ///< of FiringResult::conditions
  double log_heat_spread = study::not_a_number;
  int rounds = 0, ignited = 0;  ///< of this pressure, temperature and gap, in this and other firings
  /// With 95 % each the probability of a round is above and below these, by the rounds of this pressure,
  /// temperature and gap alone (Clopper and Pearson).
  double shown_lowest = 0, shown_highest = 1;
  IgnitionProbability predicted;
};

/// A constant before and after the firings: geometric mean and middle 90 %, SI.
struct ConstantRange {
  std::string name;
  double prior_lowest = 0, prior_centre = 0, prior_highest = 0;
  double lowest = 0, centre = 0, highest = 0;
  double change_of_coarser = 0;  ///< share by which the mean is higher on a lattice of half as many nodes
};

/// A round that could be fired next.
struct NextFiring {
  double pressure = 0;     ///< Pa
  double temperature = 0;  ///< K
  double gap = 0;          ///< m
  double ignition = 0;     ///< probability
  double information = 0;  ///< bits that its outcome tells of the constants, on average
};

struct FiringResult {
  study::StudyFile study;
  std::vector<FiredCondition> conditions;
  std::vector<FiringRow> rows;
  std::vector<ConstantRange> constants;
  std::vector<NextFiring> next;  ///< that which tells most first
  std::optional<study::FiringRecord> record;
  std::string failure;  ///< why nothing was calibrated; empty where there is a posterior
  std::vector<std::string>
      contradicting;  ///< firings that no constants make probable; then there is no record
  study::Timing timing;
  bool interrupted = false;
  /// Whether what was asked for, a record, is not there.
  bool any_indeterminate() const { return !record; }
};

/// The keys of such a study, and its table.
std::vector<scene::Key<study::Study>> firing_keys();
StudyTable firing_table();
/// Reads [[firing]], where there are any.
study::Fault read_firings(const toml::table& root, study::StudyFile& study);
/// Whether a study has firings.
bool has_firings(const study::Study& study);
/// Of every firing, the place of its pressure and temperature among those that differ, in their order.
std::vector<std::size_t> conditions_of(const std::vector<study::Firing>& firings);
/// A case for every pressure and temperature that was fired, in that order.
study::Fault make_firing_cases(study::StudyFile& study);

/// One mechanical run a pressure and temperature; then boundaries of ignition on their traces, and the
/// posterior.
FiringResult run_firings(const study::StudyFile& study, const study::StudyOptions& options = {});

std::string answer(const FiringResult& result);
report::Report report_of(const FiringResult& result);
/// What the tables of the report hold.
std::vector<ResultTable> firing_results();

}  // namespace launchsafe::kinds

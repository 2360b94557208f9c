// What single cases came to, as tables: their runs, and what followed ignition.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/run/case_result.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::report {

/// A run with the name of its case.
struct NamedRun {
  std::string name;
  std::string failure;  ///< why it is no basis for results; empty where it is
  const run::MechanicsResult* mechanics = nullptr;
  std::string stored;  ///< the file in the folder of results that holds it; empty: none
};

/// What the launch did to the steel, and friction heat of the charge over the net work done on it.
const Quantities<run::MechanicsResult>& launch_effects();

/// A row for every run: how it ended, its `launch_effects`, energy drift, steps, particles, limiters.
Table run_table(const std::vector<NamedRun>& runs);

/// A row a gap that burnt in a run with two-way coupling: end state, balance of energy, cost.
/// No rows where none did.
Table combustion_table(const run::CaseResult& result);

// --- the pictures of one case: histories, profiles along the charge's bottom, and fields over the section;
// and the numbers of some of them as tables ---

/// A case and what of it is to be drawn.
struct DrawnCase {
  const scene::Scene& scene;
  const run::CaseResult& result;
  /// s, of fields and profiles. Without any: every snapshot, and the profile at the end.
  std::vector<double> times = {};
};

struct PictureKind {
  const char* word;   ///< by which it is asked for
  const char* shows;  ///< for people
  /// What a case has not that this kind needs; empty where it can be drawn.
  std::string (*lacks)(const DrawnCase&);
  /// Only where nothing is lacking.
  std::vector<Picture> (*pictures)(const DrawnCase&);
  /// Likewise, of the pressures or of every gap's skin; null where there are none.
  std::vector<ReportTable> (*tables)(const DrawnCase&) = nullptr;
};

/// All of them, in the order in which they are drawn.
const std::vector<PictureKind>& picture_kinds();

/// A snapshot of a case: of the launch, or of a gap that burns.
struct ShownSnapshot {
  const run::Snapshot* snapshot;
  std::optional<double> asked_for = {};  ///< s, the scene's time; none where an event alone asked for it
  std::optional<double> gap = {};        ///< m, of one that burns
  double time() const { return asked_for.value_or(snapshot->time); }  ///< s
};
/// All of them, those of the launch first.
std::vector<ShownSnapshot> shown_snapshots(const DrawnCase& drawn);
/// Whether it is the one of a time (s) that a user names.
bool is_of_time(const ShownSnapshot& snapshot, double time);

}  // namespace launchsafe::report

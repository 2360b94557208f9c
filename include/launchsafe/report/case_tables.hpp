// What single cases came to, as tables: their runs, how bodies slid, what followed ignition, and the energy
// of the air; and decomposition kinetics in words.
#pragma once

#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
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

/// A row for every run: how it ended, energy drift, steps, particles, particle updates per second, limiters.
Table run_table(const std::vector<NamedRun>& runs);

/// A row for every face of the charge on which a body can slide: friction work, the largest heat by friction
/// and where, the longest way slid, and the widest opening. Without rows where all bodies are bonded.
Table interface_table(const run::MechanicsResult& mechanics);

/// What a run that burnt came to.
Quantities<run::CombustionHistory> burnt_state_quantities();

/// A row a gap that burnt in a run with two-way coupling: flame speeds, end state, balance of energy, cost.
/// No rows where none did.
Table combustion_table(const scene::Scene& scene, const run::CaseResult& result);

/// What the columns of the energy of the air are.
std::vector<Column> air_energy_columns();

/// The air of one gap of one case.
struct AuditedGap {
  std::string label;  ///< of the case; empty where there is only one
  double gap = 0;     ///< m
  surface::AirEnergy air;
};

/// What the audit says of temperatures and critical gaps, as a short paragraph: at the gap where the skin
/// took most against its supply, whether that is more than compression can supply, and what follows.
std::string air_energy_statement(const std::vector<AuditedGap>& gaps);

/// A row for every gap: taken by the skin, supplied by compression, their ratio; under it the statement.
/// Without rows where there is no gap.
Table air_energy_table(const std::vector<AuditedGap>& gaps);

/// A sentence: which decomposition the flame of a coupled run lives on, and which decides ignition.
std::string flame_kinetics_note(const scene::Scene& scene);

// --- the pictures of one case: histories, profiles along the charge's bottom, and fields over the section;
// and the numbers of some of them as tables. Besides, the picture of a shell at rest ---

/// A case and what of it is to be drawn.
struct DrawnCase {
  const scene::Scene& scene;
  const run::CaseResult& result;
  /// s, of fields and profiles. Without any: every snapshot, and profiles at six times that divide the run
  /// evenly.
  std::vector<double> times = {};
  /// What was published of this launch; temperatures of a gap that ignited until then alone.
  std::vector<study::Reference> published = {};
  double early_time = study::Study{}.early_time;  ///< s, of early temperatures
};

/// A picture and the name of its file, which follows from what it shows.
struct CasePicture {
  std::string file;  ///< "field_temperature_10ms.svg"
  Drawing plot;
  std::optional<double> time = {};  ///< s, of a field
  std::optional<double> gap = {};   ///< m, of what belongs to one gap
};

/// What a kind of pictures shows, as numbers, and the name of their file: "field_10ms.csv".
struct CaseTable {
  std::string file;
  Table table;
};

struct PictureKind {
  const char* word;   ///< by which it is asked for
  const char* shows;  ///< for people
  /// What a case has not that this kind needs; empty where it can be drawn.
  std::string (*lacks)(const DrawnCase&);
  /// Only where nothing is lacking.
  std::vector<CasePicture> (*pictures)(const DrawnCase&);
  /// Likewise; null where there are none. One of the pressures, of every gap's skin, or of every snapshot: a
  /// row a particle.
  std::vector<CaseTable> (*tables)(const DrawnCase&) = nullptr;
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

/// Bodies in colours with their names in a legend, the lines of the grid, the axis of symmetry, the
/// observation points with their names, and both axes in mm. A slender shell with a charge is drawn whole,
/// and enlarged around the bottom of the charge. Names of points for which there is no room are left out, and
/// the picture counts them. Needs at least one body. No other program takes part, and equal scenes have equal
/// pictures.
std::string section_svg(const scene::Scene& scene);

}  // namespace launchsafe::report

// The pictures of one case: histories, profiles along the charge's bottom, and fields over the section; and
// the numbers of some of them as tables. Besides, the picture of a shell at rest.
#pragma once

#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::report {

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

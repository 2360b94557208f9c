// Text and files that the reports of all studies share, and the scene keys that a study varies, as people and
// programs read them: one unit for all values of a key; verdicts and critical gaps; and how far a study is.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/rows.hpp"

#include <ctime>

namespace launchsafe::report {

/// The heading is "peak pressure" or "load.exponent", the name peak_pressure or load_exponent.
struct ShownKey : Column {
  std::string scene_key;  ///< "load.peak"

  double value(double value_si) const { return shown_value(value_si, form); }
  std::string text(double value_si) const { return in_words(value_si, form); }  ///< "496 MPa"
};

ShownKey shown(const study::Axis& axis);
std::vector<ShownKey> shown_axes(const study::Study& study);
/// What the axes of a study are in a case, of its coordinates.
Quantities<std::vector<double>> axis_quantities(const study::Study& study);

/// "400, 450, 496 MPa"; long lists by their ends and their number.
std::string values_text(const ShownKey& key, const std::vector<double>& si_values);
/// "uniform from 400 to 600 MPa", "normal, 30 ± 5 µm, cut off at 10 and 50 µm".
std::string distribution_text(const ShownKey& key, const math::Distribution& distribution);

/// Of a key's name, in a picture: "face friction" of "charge.face_friction".
std::string plain_words(std::string name);

/// "600 MPa, 30 µm": where a case lies; empty without coordinates.
std::string place_text(const std::vector<ShownKey>& keys, const std::vector<double>& coordinates);

/// The study file as in a command that works anywhere: never an absolute path.
std::string study_file_name(const study::StudyFile& study);
/// The command that remakes a report.
std::string remaking_command(const study::StudyFile& study);
/// What was simulated, as Markdown list items: scene, overrides, what is varied, load, mesh, surface
/// constants.
std::string setup_text(const study::StudyFile& study);
/// Activation temperature [K], frequency factor [1/s] and heat of reaction [J/kg] of the charge, where they
/// come from, and all of it as `text`; null in a scene without a charge.
Row kinetics_json(const scene::SceneFile& file);

/// Whether a study varies the scene key of that name.
bool varies(const study::Study& study, const std::string& key);
/// "re-used 3 mechanical runs, ran 12 ...": runs, rate, wall time.
std::string timing_text(const study::Timing& timing);
nlohmann::ordered_json timing_json(const study::Timing& timing);
/// "crack bound 12, tension cut-off 3", or "none".
std::string limiters_text(const run::LimiterCounts& limiters);
/// A number, or null where it is not finite.
nlohmann::ordered_json number(double value);
/// What a study varies: name, scene key, key of its column, unit, and its values or its distribution.
nlohmann::ordered_json axes_json(const study::Study& study);
/// study.json: kind, study, title and answer, `members` of the kind, and the rows of the report's tables.
/// Rows have a line each and are never objects in memory, as large sweeps would take too much of it.
std::string study_json(const study::StudyFile& study, const Report& report,
                       const nlohmann::ordered_json& members);

// --- verdicts and critical gaps as cells and sentences, the same in every study that judges gaps ---

/// A gap with the case that it belongs to.
struct JudgedGap {
  const study::CaseRow* of;
  const study::GapRow* gap;
};
/// Columns of a gap: temperatures, uncertainty, verdict, ignition, energy of the air.
Quantities<JudgedGap> verdict_quantities(const study::Study& study);

/// The columns of a gap, with the gap itself, that are the same in all studies.
std::vector<Column> verdict_columns();
/// The reason of a verdict without what the study accepts, which stands beside the case.
std::string rule_in(const std::string& reason);

/// Columns of a case: the critical gap with its bounds, basis, warnings, and what is accepted.
Quantities<study::CaseRow> case_quantities();

/// Notes for every page with verdicts: numerics stated by hand, no other models, no expected velocity, a
/// charge off the grid lines, and what `acceptances_to_write` returns. `rows`: of the study's cases; none for
/// a study that gives no verdicts.
std::vector<std::string> verdict_notes(const study::StudyFile& study,
                                       const std::vector<study::CaseRow>& rows);
/// Lines of a study file that accept the open warnings and extrapolations of these cases, each name once,
/// with reasons to be filled in; empty where nothing is open that a study may accept.
std::vector<std::string> acceptances_to_write(const std::vector<study::CaseRow>& rows);
/// A note on the stations over which temperatures are averaged.
std::string station_note(const study::StudyFile& study);

/// The number of a critical gap, m; NaN where the search found no ignition or nothing.
double value_of(const study::CriticalGap& gap);
/// "0.039 ± 0.010 cm"; `reads_as` where the bounds are not known.
std::string measured_text(const study::CaseRow& of_case);
/// "0.0395 cm", "> 1 cm", "ignites without a gap", "several, the first at 0.0395 cm", "unknown".
std::string reads_as(const study::CriticalGap& gap);

/// On what the absolute value of a critical gap rests.
std::string friction_remark(const study::StudyFile& study);

// --- how far a study is ---

/// A line of a terminal.
std::string progress_line(const study::Progress& progress, std::time_t now);

/// When the local clock shows "06:00" next after `now`, s since the epoch; nothing for what is no time of
/// day.
std::optional<std::time_t> next_clock_time(const std::string& text, std::time_t now);

/// State (running, finished, interrupted or failed), cases, time left and exit code of the studies in
/// folders, and as `exit_code` the largest. A study whose writer neither lives nor came to its end was
/// interrupted.
Row status_facts(const std::map<std::string, store::StudyStatus>& studies, std::time_t now);

/// These facts for a terminal, a line a folder.
std::string status_text(const Row& facts, std::time_t now);

}  // namespace launchsafe::report

// Text and files that the reports of all studies share, and the scene keys that a study varies, as people and
// programs read them: one unit for all values of a key.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

#include <nlohmann/json.hpp>

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
/// Whether a study varies the scene key of that name.
bool varies(const study::Study& study, const std::string& key);
/// "re-used 3 mechanical runs, ran 12 ...": runs, rate, wall time.
std::string timing_text(const study::Timing& timing);
/// That as a sentence of a report.
std::string timing_sentence(const study::Timing& timing);
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

}  // namespace launchsafe::report

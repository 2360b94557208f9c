// A safety report: the folders that studies left, and the page that is made of their rows.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {

/// One study.
struct StudyEvidence {
  std::string label;  ///< "A", "B", ... in the order in which the user named them
  std::filesystem::path folder;
  store::StudyRecord record;
  std::string kind, title;
  scene::SceneFile scene;                       ///< what was simulated, with what the study sets
  Row study;                                    ///< study.json; null while it is not finished
  std::map<std::string, std::string> pictures;  ///< SVG, by the name of the file
  std::vector<std::string> differences = {};    ///< from the main study's scene: study::differences

  bool finished() const { return study.is_object(); }
  bool has_verdicts() const { return study.contains("verdicts"); }
  /// Whether it has verdicts of one launch, or of a few, and tells how each of them ran.
  bool is_of_launch() const { return has_verdicts() && study.contains("runs"); }
  /// The command that makes it again, or goes on with it.
  std::string command() const;
  /// The rows of a table of study.json; null where it has no such table.
  const Row& rows(const std::string& table) const { return found_in(study, table); }
  /// The verdicts of the case at a place, for all gaps of the study.
  Row verdicts_of(std::size_t place) const;
  /// Whether that case of a launch completed: temperatures of a run that was cut off are those of a part.
  bool completed(std::size_t place) const { return text_of(rows("runs")[place], "status") == "completed"; }
};

/// All of it. There is at least one study.
struct SafetyEvidence {
  std::vector<StudyEvidence> studies;
  /// The launch of the main study, if it has no axes and its case was kept, with the gaps that are in it as
  /// warm as their verdicts say.
  std::optional<run::CaseResult> stored = {};
  /// The one that the report is about: that of a launch, or else the first that is not finished or has
  /// verdicts, or the first.
  const StudyEvidence& main() const;
};

/// Reads the folders of studies. Errors, a message each: no study there, a file that is missing or cannot be
/// read, another model version than this program's, a damaged case, two studies of launches, studies of
/// different shells.
store::Result<SafetyEvidence> read_safety_evidence(const std::vector<std::filesystem::path>& folders);

/// T max against gap of one launch in the colours of its verdicts, with its critical gap and what was
/// published. `tables`: rows of its study.
Plot verdict_plot(const Row& tables, const scene::Scene& scene);

/// report.html, its pictures, and report.json with its facts. A picture that gnuplot does not
/// draw is a remark, in the page too. Equal evidence makes equal files.
RenderedReport make_safety_report(const SafetyEvidence& evidence, const DrawingLimits& limits = {});

}  // namespace launchsafe::report

// A kind of study as one value: all that the rest of the program asks of it. kinds.cpp has the table of them.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/run_cases.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::kinds {

/// A case that came to nothing.
struct Failure {
  std::string label;
  std::string reason;
  study::RunOutcome outcome = study::RunOutcome::failed;  ///< of the run behind it
};

/// What came of a study, to which its kind adds.
struct StudyResult {
  study::StudyFile study;
  study::Timing timing;
  bool interrupted = false;
};

/// What became of a study of any kind.
struct StudyOutcome {
  bool interrupted = false;
  std::vector<Failure> failures;  ///< in the order of the cases; without those that another shard runs
  study::Timing timing;
  report::Report report;  ///< nothing of a study that was interrupted
};

/// A table of a study file that is read apart from the keys.
struct StudyTable {
  std::string name;                        ///< "vary", "reference"
  std::vector<scene::DocumentedKey> keys;  ///< "reference.gap"; none where any scene key may stand
};

/// A study file as it was parsed.
struct StudySource {
  const toml::table& root;
  std::filesystem::path folder;  ///< of the file, from which paths in it start
};

/// Which entries of [[vary]] an analysis can make something of.
struct Varied {
  bool values = false;         ///< the cases are all combinations
  bool distributions = false;  ///< instead: the cases are samples
  std::string needed = {};     ///< what an entry has at the least, where there must be one
};

struct Kind {
  study::KindTraits traits;
  std::vector<scene::Key<study::Study>> keys;  ///< of its study files, besides those of every kind
  std::vector<StudyTable> tables;
  Varied varies = {};  ///< of what becomes Study::axes; with none there is no [[vary]]
  /// Reads its own tables but [[vary]], and fills StudyFile::cases. All else is known, the gaps to judge too.
  /// Throws what is wrong with them (src/kinds/study_keys.hpp).
  void (*make_cases)(const StudySource& source, study::StudyFile& study);
  StudyOutcome (*run)(const study::StudyFile& study, const study::StudyOptions& options);
  /// Its tables, without rows, of a study with the defaults: some columns depend on what it asks.
  std::vector<report::ReportTable> (*results)();
};

/// What a study asks of its kind alone: CriticalGapSettings and the like; the defaults where it asks nothing.
/// The second is for changing it.
template <class Settings>
const Settings& settings_of(const study::Study& study) {
  static const Settings defaults{};
  return study.settings ? std::any_cast<const Settings&>(*study.settings) : defaults;
}
template <class Settings>
const Settings& settings_of(const study::StudyFile& study) {
  return settings_of<Settings>(study.study);
}
template <class Settings>
Settings& settings_of(study::Study& study) {
  if (study.settings.use_count() != 1)
    study.settings = std::make_shared<std::any>(settings_of<Settings>(std::as_const(study)));
  return std::any_cast<Settings&>(*study.settings);
}

/// Every kind of study there is: each is a row, with what its tables hold but for what a study asks.
const std::vector<Kind>& kinds();
/// The kind of a study that was read.
const Kind& kind_of(const study::Study& study);
/// The kind of that name; a name that no kind has is a programming error.
const Kind& kind_named(std::string_view name);
inline const study::KindTraits& traits_of(std::string_view name) { return kind_named(name).traits; }

/// Runs a study as its kind asks.
StudyOutcome run_study(const study::StudyFile& study, const study::StudyOptions& options);

// --- a study from a file: what is asked of a scene, read and validated before anything is computed ---

/// What the command line adds to a study file.
struct StudyRequest {
  std::size_t most_cases = study::largest_case_count;  ///< more are refused
};

/// Reads and validates a study file and its scene. Nothing is computed. Never throws.
scene::Expected<study::StudyFile> read_study(const std::filesystem::path& file,
                                             const StudyRequest& request = {});
/// The same from text; `file` is named in errors, and the scene is sought from its folder.
scene::Expected<study::StudyFile> parse_study(std::string_view text, const std::filesystem::path& file,
                                              const StudyRequest& request = {});

/// The keys of a study file and of its tables, "reference.gap" being that of one [[reference]], for
/// documentation. Sentences end with the kinds that a key belongs to, unless it belongs to all.
std::vector<scene::DocumentedKey> describe_study_keys();

}  // namespace launchsafe::kinds

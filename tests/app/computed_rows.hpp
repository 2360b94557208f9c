// Studies given as text, beside the files of a folder, computed in this process.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_rows.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::app {

/// Rows of the cases of a study, or why it is refused; no launch takes longer than `time_limit` (s).
inline scene::Expected<std::vector<study::CaseRow>> computed_rows(const std::string& text,
                                                                  const std::filesystem::path& folder,
                                                                  double time_limit = math::infinity) {
  const auto file = kinds::parse_study(text, folder / "study.toml");
  if (!file) return file.error();
  study::StudyOptions options;
  options.time_limit = time_limit;
  study::Timing timing;
  study::ProgressTracker tracker({});
  return study::draw_rows(*file, options, timing, tracker);
}

}  // namespace launchsafe::app

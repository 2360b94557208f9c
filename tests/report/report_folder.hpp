// Where reports are written in tests, and what they hold.
#pragma once

#include "launchsafe/report/report.hpp"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace launchsafe::report {

/// The text of a file of a report; empty without one of that name.
inline std::string text_in(const RenderedReport& rendered, const std::string& name) {
  const auto found = std::ranges::find(rendered.files, name, &TextFile::name);
  return found == rendered.files.end() ? "" : found->text;
}

/// study.json of a study's report.
template <class Result>
nlohmann::ordered_json json_of(const Result& result) {
  return nlohmann::ordered_json::parse(report_of(result).json);
}

/// A line or the marks of a plot; nullptr without one of that name.
inline const Series* series_named(const Plot& plot, const std::string& label) {
  const auto found = std::find_if(plot.series.begin(), plot.series.end(),
                                  [&](const Series& each) { return each.label == label; });
  return found == plot.series.end() ? nullptr : &*found;
}

/// A folder of its own, gone with the test.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("launchsafe_" + std::to_string(::getpid()));
  Folder() { std::filesystem::remove_all(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

}  // namespace launchsafe::report

// Edits of a scene or of its pressure curve: one that makes an indeterminate verdict SAFE does so through a
// plausible value that is printed beside the verdict.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/record_domain.hpp"
#include "study/synthetic_launch.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string curve_text =
    "time_ms,pressure_MPa\n0,0.1\n3,5\n5,60\n7,240\n9,430\n11,496\n13,430\n15,270\n17,120\n18,70\n";

const std::string& scene_text() {
  static const std::string text = [] {
    std::ifstream file(studies_folder / "scene_155mm.toml");
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return text;
}

const StudyFile& study_of_one_gap() {
  static const StudyFile study = study_of(critical_text + "gaps = \"0.0198 cm\"\n");
  return study;
}

/// The row of the gap of 0.0198 cm on a launch whose friction heats in proportion to the square of the
/// pressure that is simulated, by 116.1 K at 496 MPa.
GapVerdict row_of(const scene::SceneFile& file) {
  StudyCase input = study_of_one_gap().cases.front();
  input.scene = file;
  const double peak = scene::PressureHistory(file.scene.load).peak();
  const double localisation = calibration_scene().surface.localisation;
  run::MechanicsResult mechanics = synthetic_mechanics(file.scene);
  mechanics.trace =
      synthetic_trace(peak, 116.1 * 1717.0 * 1780.0 / localisation * peak * peak / (496e6 * 496e6));
  return answer_of(study_of_one_gap().study, input, mechanics).verdicts.at(0);
}

/// One slip of a person or an editor: another digit, factor, unit or sign, or a line that is gone, twice or
/// elsewhere.
std::string edited(std::string text) {
  std::vector<std::string> lines{""};
  for (const char letter : text) {
    if (letter == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += letter;
    }
  }
  const auto any_line = [&lines] { return *rc::gen::inRange<std::size_t>(0, lines.size()); };
  std::string& line = lines[any_line()];
  const std::size_t at = line.empty() ? 0 : *rc::gen::inRange<std::size_t>(0, line.size());
  switch (*rc::gen::inRange(0, 7)) {
    case 0:
      if (!line.empty()) line[at] = static_cast<char>(*rc::gen::inRange(32, 127));
      break;
    case 1:
      if (!line.empty()) line.erase(at, 1);
      break;
    case 2:
      line.insert(at, 1, *rc::gen::element('0', '1', '9', '.', '-', ',', 'e', '#', '"', ' '));
      break;
    case 3: {
      const auto words = std::vector<std::string>{"MPa", "kPa", "Pa", "GPa", "ms", "us",   "s",
                                                  "mm",  "cm",  "um", "m",   "K",  "kg/m3"};
      const std::string from = *rc::gen::elementOf(words), to = *rc::gen::elementOf(words);
      if (const std::size_t found = line.find(from); found != std::string::npos)
        line.replace(found, from.size(), to);
      break;
    }
    case 4:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(any_line()));
      break;
    case 5: {
      const std::string copy = line;
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(any_line()), copy);
      break;
    }
    default:
      std::swap(lines[any_line()], lines[any_line()]);
  }
  std::string result;
  for (const std::string& each : lines) result += each + '\n';
  return result;
}

/// Keys that no verdict rests on, or that are judged by their own numbers beside it (the gap, the trace's
/// sampling).
bool is_silent(const std::string& key) {
  static const std::set<std::string> silent{"title",
                                            "load.curve",
                                            "gap.thickness",
                                            "kinetics.set",
                                            "numerics.energy_drift_limit",
                                            "numerics.time_step_factor"};
  return silent.contains(key) || key.starts_with("output.") || key.starts_with("physics.");
}

/// What the reason calls a key that differs from the calibration's.
std::string name_of(const std::string& key) {
  if (key == "load.peak") return "peak pressure";
  if (key == "charge.crack_radius") return "crack radius";
  if (key == "charge.flaw_size") return "flaw size";
  if (key == "initial_temperature") return "initial temperature";
  if (key.starts_with("load.")) return "load shape";
  if (key == "frame" || key.starts_with("numerics.")) return "numerics";
  return key;
}

void expect_told(const scene::Scene& scene, const GapVerdict& row) {
  RC_ASSERT(scene::implausible_values(scene).empty());
  const scene::Scene calibrated = calibration_scene();
  std::size_t untold = 0;
  for (const auto& key : scene::scene_keys()) {
    if (is_silent(key.name) ||
        scene::format_value(key, key.get(scene)) == scene::format_value(key, key.get(calibrated)))
      continue;
    if (reason_text(row).find(name_of(key.name)) == std::string::npos) ++untold;
  }
  // Of a long list the reason names four and counts the rest.
  RC_ASSERT(untold == 0 || reason_text(row).find(" more") != std::string::npos);
}

TEST(EditedInput, IsIndeterminateBefore) {
  const auto scene = scene::parse_scene(scene_text(), studies_folder / "scene.toml");
  ASSERT_TRUE(scene);
  const GapVerdict row = row_of(*scene);
  EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate) << reason_text(row);
  // So that little makes it safe.
  EXPECT_NE(reason_text(row).find("as small as 0.0193 cm"), std::string::npos) << reason_text(row);
}

std::string edited_a_few_times(std::string text) {
  for (int edits = *rc::gen::inRange(1, 4); edits > 0; --edits) text = edited(std::move(text));
  return text;
}

void expect_edit_of_scene_told() {
  const std::string text = edited_a_few_times(scene_text());
  const auto file = scene::parse_scene(text, studies_folder / "scene.toml");
  if (!file || !scene::has_charge(file->scene)) return;
  const GapVerdict row = row_of(*file);
  if (row.judgement.verdict == Verdict::safe) expect_told(file->scene, row);
}

void expect_edit_of_curve_told() {
  const std::string text = edited_a_few_times(curve_text);
  const auto curve = scene::parse_pressure_curve(text, "pressure.csv");
  if (!curve) return;
  auto file = scene::parse_scene(scene_text(), studies_folder / "scene.toml").value();
  file.scene.load.curve_time = curve->time;
  file.scene.load.curve_pressure = curve->pressure;
  if (curve->time.back() < scene::end_time(file.scene.load)) return;  // the reader refuses it
  const GapVerdict row = row_of(file);
  if (row.judgement.verdict != Verdict::safe) return;
  const scene::PressureHistory history(file.scene.load);
  RC_ASSERT(history.peak() >= 0.995 * history.stated_peak());
  RC_ASSERT(history.peak() >= 10e6);  // the least plausible peak
  expect_told(file.scene, row);
}

constexpr int edits_a_case = 5;  // of the hundred cases of a property

RC_GTEST_PROP(EditedInputProperty, OfASceneIsSafeOnlyThroughAPlausibleValueThatIsPrinted, ()) {
  for (int edit = 0; edit < edits_a_case; ++edit) expect_edit_of_scene_told();
}

RC_GTEST_PROP(EditedInputProperty, OfACurveIsSafeOnlyThroughAPlausiblePeakThatIsSimulated, ()) {
  for (int edit = 0; edit < edits_a_case; ++edit) expect_edit_of_curve_told();
}

}  // namespace
#endif

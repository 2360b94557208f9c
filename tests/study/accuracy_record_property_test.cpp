// No edit of a record's text gives a case a smaller uncertainty than the record did. One that its digest does
// not know is refused: accuracy_record_json_test.cpp.
#include "launchsafe/kinds/read_study.hpp"
#include "study/made_record.hpp"

#include <gtest/gtest.h>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include "report/report_folder.hpp"

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using nlohmann::ordered_json;

/// Cases within a record, grown, beyond it and with settings that it does not have; none where the record is
/// refused.
std::vector<StudyCase> settled(const std::string& record) {
  static const report::Folder folder;
  std::filesystem::create_directories(folder.path);
  std::ofstream(folder.path / "accuracy.json") << record;
  const auto study =
      parse_study("kind = \"sweep\"\nscene = \"" + (studies_folder / "scene_155mm.toml").string() +
                      "\"\naccuracy = \"accuracy.json\"\n[axes]\ngap = \"0, 0.04 cm\"\n"
                      "peak_pressure = \"400, 496, 550, 700 MPa\"\ncrack_radius = \"30, 60 um\"\n"
                      "numerics.inertial_scaling = [1, 4, 16]\n",
                  folder.path / "study.toml");
  return study ? study->cases : std::vector<StudyCase>{};
}

/// At any rise: the larger of the stated and of what the rise makes of it.
bool any_smaller(const std::vector<StudyCase>& edited, const std::vector<StudyCase>& original) {
  for (std::size_t i = 0; i < original.size(); ++i) {
    const auto at_rise = [](const StudyCase& each, double rise) {
      const double hotter = rise / each.rise_of_uncertainty;
      return each.numerical_uncertainty * (hotter > 1.0 ? hotter : 1.0);
    };
    for (const double rise : {10.0, 216.0, 500.0})
      if (at_rise(edited[i], rise) < at_rise(original[i], rise) * (1.0 - 1e-9)) return true;
  }
  return false;
}

/// Refused, or no smaller uncertainty for any case.
void expect_no_smaller(const std::string& text) {
  static const std::vector<StudyCase> original = settled(to_json_text(made_record()));
  RC_ASSERT(original.size() == 24u);
  const std::vector<StudyCase> edited = settled(text);
  RC_CLASSIFY(edited.empty(), "refused");
  if (!edited.empty()) RC_ASSERT(!any_smaller(edited, original));
}

/// What follows from the rest cannot be made smaller even with the digest computed anew, nor can what a
/// record is not about. (The temperatures themselves and the launch are believed then.)
RC_GTEST_PROP(AccuracyRecordProperty, NoRehashedBoundMakesAnUncertaintySmaller, ()) {
  ordered_json record = ordered_json::parse(to_json_text(made_record()));
  const auto setting = *rc::gen::inRange<std::size_t>(0, record["settings"].size());
  const std::string key = *rc::gen::element<std::string>("temperature_bound_K", "critical_gap_bound_m",
                                                         "processor_time_s", "label", "reference");
  ordered_json& value = record["settings"][setting][key];
  const double factor = *rc::gen::element(0.0, 1e-6, 0.5, 0.999, 1.001, 2.0, 1e300);
  if (value.is_number()) {
    value = value.get<double>() * factor;
  } else if (value.is_boolean()) {
    value = !value.get<bool>();
  } else {
    value = *rc::gen::element<std::string>("", "inertial_scaling 1", "x\n");
  }
  expect_no_smaller(rehashed(record));
}

}  // namespace
#endif

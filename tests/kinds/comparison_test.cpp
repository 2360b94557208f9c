// Variants of a scene side by side, on a launch in closed form.
#include "launchsafe/kinds/comparison.hpp"

#include "study/read_error.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string comparison_start =
    "kind = \"comparison\"\nscene = \"scene_155mm.toml\"\nname = \"own\"\ngaps = \"0, 0.02, 0.04 cm\"\n";

/// What varies, and variants after it.
const std::string variants_follow = "\n[[vary]]\n";
const std::string two_pressures = "\n[[vary]]\nkey = \"peak_pressure\"\nvalues = \"450, 496 MPa\"\n";

StudyFile comparison_of(const std::string& variants, const std::string& varied = {}) {
  return study_of(comparison_start + synthetic_constants + varied + variants_follow + variants);
}

std::string variant(const std::string& name, const std::string& set) {
  return "\n[[vary.variants]]\nname = \"" + name + "\"\nset = { " + set + " }\n";
}

TEST(Comparison, TheSceneItselfComesFirstAndEveryVariantHasItsOwnScene) {
  const StudyFile study = comparison_of(variant("coarse", "numerics.cell_size = \"2.5 mm\"") +
                                        variant("chamber", "gap.pressure = \"chamber\""));
  ASSERT_EQ(study.cases.size(), 3u);
  EXPECT_EQ(study.cases[0].scene.scene.numerics.cell_size, study.scene.scene.numerics.cell_size);
  EXPECT_EQ(study.cases[1].scene.scene.numerics.cell_size, 2.5e-3);
  EXPECT_EQ(study.cases[2].scene.scene.surface.air_pressure, scene::AirPressure::chamber);
  EXPECT_TRUE(study.cases[1].label.starts_with("coarse: ")) << study.cases[1].label;
}

TEST(Comparison, EveryVariantIsRunUnderEveryPeakPressure) {
  const StudyFile study = comparison_of(variant("coarse", "numerics.cell_size = \"2.5 mm\""), two_pressures);
  ASSERT_EQ(study.cases.size(), 4u);
  EXPECT_EQ(study.cases[2].peak_pressure, 450e6);
  EXPECT_EQ(study.cases[3].peak_pressure, 496e6);
  const ComparisonResult result = run_comparison(study, synthetic_options());
  EXPECT_EQ(result.counterpart(3), 1u);
  // The launch in closed form knows no cells: nothing is different but what the peak does.
  EXPECT_EQ(result.answers[3].critical.value, result.answers[1].critical.value)
      << text_of(result.answers[3].critical.reason);
  EXPECT_LT(result.answers[1].critical.value, result.answers[0].critical.value);
}

// The constants say nothing of another way to hold the charge, unless the variant itself says why they may.
TEST(Comparison, AVariantOutsideTheCalibrationIsIndeterminateUntilItAcceptsThat) {
  const std::string bonded = variant("bonded", "interface.wall.condition = \"bonded\"");
  const auto critical = [](const std::string& text) {
    return run_comparison(comparison_of(text), synthetic_options()).answers[1].critical;
  };
  const CriticalGap unknown = critical(bonded);
  EXPECT_EQ(unknown.kind, CriticalGapKind::indeterminate);
  const auto accepted = critical(bonded +
                                 "accept = [{ key = \"calibration.interfaces\", value = \"nose sliding, "
                                 "friction 0\", because = \"of this variant alone\" }]\n");
  EXPECT_EQ(accepted.kind, CriticalGapKind::value) << text_of(accepted.reason);
  EXPECT_EQ(accepted.value, unknown.indicative);
  const auto foreign = critical(
      bonded + variant("other", "gap.pressure = \"chamber\"") +
      "accept = [{ key = \"gap.pressure\", value = \"chamber\", because = \"of the other alone\" }]\n");
  EXPECT_EQ(foreign.kind, CriticalGapKind::indeterminate);
}

TEST(Comparison, StationsAreComparedOnASkinThatDoesNotReact) {
  const ComparisonResult result = run_comparison(
      comparison_of(variant("coarse", "numerics.cell_size = \"2.5 mm\"")), synthetic_options());
  const auto& stations = result.answers[0].stations;
  ASSERT_EQ(stations.size(), 3u);
  ASSERT_EQ(stations[2].size(), 3u) << "the observation point G1 is no station of its own";
  // 0.04 cm ignites, and yet the second station, which friction heats most, is not as hot as a flame.
  EXPECT_TRUE(result.answers[0].verdicts[2].ignition.has_value());
  EXPECT_GT(stations[2][1].temperature, stations[2][2].temperature);
  EXPECT_LT(stations[2][1].temperature, 600.0);
}

TEST(Comparison, TheReportHoldsVariantsAndStationsAndJudgesNoGap) {
  const ComparisonResult result = run_comparison(
      comparison_of(variant("coarse", "numerics.cell_size = \"2.5 mm\"")), synthetic_options());
  const auto json = nlohmann::json::parse(report_of(result).json);
  EXPECT_EQ(json["kind"], "comparison");
  EXPECT_EQ(json["cases"].size(), 2u);
  EXPECT_FALSE(json.contains("verdicts"));
  EXPECT_EQ(json["stations"].size(), 2u * 3u * 3u);
  EXPECT_EQ(json["cases"][1]["critical_gap_difference_cm"], 0.0);
}

// The table of other models that verdicts rest on is a comparison of calibrated models over the peak
// pressure.
TEST(Comparison, OfCalibratedModelsWritesTheRecordOfOtherModels) {
  const auto calibrated = [](const std::string& model) {
    return "calibration = \"../reports/model_form/" + model + "/calibration/calibration.json\"\n";
  };
  const auto accepted = [](const std::string& key, const std::string& value) {
    return "accept = [{ key = \"" + key + "\", value = \"" + value + "\", because = \"to compare\" }]\n";
  };
  const std::string start =
      "kind = \"comparison\"\nscene = \"scene_155mm.toml\"\nname = \"own\"\n"
      "gaps = \"0, 0.02 cm\"\n" +
      calibrated("smooth_wall") + "[[vary]]\nkey = \"peak_pressure\"\nvalues = \"496, 450 MPa\"\n" +
      variants_follow;
  const std::string bonded =
      variant("bonded", "interface.nose.condition = \"bonded\", interface.wall.condition = \"bonded\"");
  const std::string no_crack_friction = variant("no_crack_friction", "charge.crack_friction = false") +
                                        calibrated("no_crack_friction") +
                                        accepted("charge.crack_friction", "false");
  const std::string others =
      variant("inelastic", "friction.closure = \"inelastic\"") + calibrated("inelastic") + no_crack_friction +
      variant("station_10mm", "station.width = \"10 mm\"") + calibrated("station_10mm");
  const ComparisonResult result =
      run_comparison(study_of(start + bonded + "description = \"glued\"\n" + calibrated("bonded") + others),
                     synthetic_options());
  const auto files = report_of(result).files;
  ASSERT_EQ(files.size(), 1u);
  ASSERT_EQ(files[0].name, "model_form.json");
  const auto record = parse_model_form(files[0].text, files[0].name);
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_EQ(record->peak_pressures, (std::vector<double>{450e6, 496e6}));
  ASSERT_EQ(record->alternatives.size(), 4u);
  EXPECT_EQ(record->alternatives[0].critical_gap[1], result.answers[2].critical.value);
  const auto plot_of = [](const ComparisonResult& of) {
    for (const auto& item : report_of(of).items)
      if (const auto* picture = std::get_if<report::Picture>(&item)) return picture->plot;
    return report::Plot{};
  };
  ASSERT_EQ(plot_of(result).series.size(), 3u) << "all but one of the others are on the default's line";
  EXPECT_EQ(plot_of(result).series[0].label, "own (default)");
  EXPECT_EQ(plot_of(result).series[1].label, "glued: no share in verdicts") << "in plain words";
  ASSERT_EQ(plot_of(result).vertical_lines.size(), 1u) << "where both records were calibrated";
  EXPECT_NEAR(plot_of(result).vertical_lines[0].at, 496.0, 1e-9);
  ComparisonResult alike = result;
  for (const std::size_t i : {0u, 1u}) alike.answers[2 + i].critical = alike.answers[i].critical;
  EXPECT_EQ(plot_of(alike).series.size(), 2u) << "a line on another is named";
  EXPECT_NE(plot_of(alike).subtitle.find("; within 0.0002 cm of the default: glued"), std::string::npos)
      << plot_of(alike).subtitle;
  const ComparisonResult without = run_comparison(
      study_of(start + bonded +
               "accept = [{ key = \"calibration.interfaces\", value = \"bonded for good\", because "
               "= \"of this variant alone\" }]\n"),
      synthetic_options());
  EXPECT_TRUE(report_of(without).files.empty());
}

// Its record of a calibration knows the constants to 2.87 K, that of the scene to 2.86 K.
TEST(Comparison, AVariantTakesTheFitUncertaintyOfItsOwnCalibration) {
  const StudyFile study = study_of(
      "kind = \"comparison\"\nscene = \"scene_155mm.toml\"\ngaps = \"0 cm\"\n"
      "calibration = \"../reports/model_form/smooth_wall/calibration/calibration.json\"\n" +
      variants_follow + variant("inelastic", "friction.closure = \"inelastic\"") +
      "calibration = \"../reports/model_form/inelastic/calibration/calibration.json\"\n");
  const auto& variants = kinds::settings_of<ComparisonSettings>(study.study).variants;
  ASSERT_EQ(variants.size(), 2u);
  EXPECT_NEAR(variants[0].judged.calibration.evidence.fit_uncertainty, 2.8592, 1e-3);
  EXPECT_NEAR(variants[1].judged.calibration.evidence.fit_uncertainty, 2.8702, 1e-3);
}

// With constants it would be another study.
TEST(Comparison, RestsOnTheRecordOfACalibrationThatFailed) {
  const std::string start = "kind = \"comparison\"\nscene = \"scene_155mm.toml\"\ngaps = \"0 cm\"\n" +
                            variants_follow + variant("no_crack_friction", "charge.crack_friction = false");
  const std::size_t without = study_of(start).records.size();
  EXPECT_EQ(study_of(start + "calibration = "
                             "\"../reports/model_form/no_crack_friction/calibration/calibration.json\"\n")
                .records.size(),
            without + 1);
}

TEST(Comparison, FaultsNameTheVariant) {
  const auto fault = [](const std::string& text) {
    const auto study = parse_here(comparison_start + text);
    return study ? std::string("none") : study.error().message();
  };
  EXPECT_NE(fault("").find("vary: found no vary"), std::string::npos) << fault("");
  EXPECT_NE(fault(two_pressures).find("vary.variants: found no variant"), std::string::npos);
  EXPECT_NE(fault("[[variant]]\nname = \"a\"\n").find("[[vary.variants]]"), std::string::npos);
  const std::string unknown = fault(variants_follow + variant("a", "numerics.cell_sise = \"5 mm\""));
  EXPECT_NE(unknown.find("vary.variants.set.numerics.cell_sise"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("cell_size"), std::string::npos) << unknown;
  const std::string gaps = fault(variants_follow + variant("a", "gap.thickness = \"1 mm\""));
  EXPECT_NE(gaps.find("vary.variants.set.gap.thickness: found gaps of a variant"), std::string::npos) << gaps;
  const std::string same = fault(variants_follow + "[[vary.variants]]\nname = \"a\"\n");
  EXPECT_NE(same.find("\"a\", which is the scene as it is"), std::string::npos) << same;
  const std::string twice = fault(variants_follow + variant("a", "gap.pressure = \"chamber\"") +
                                  variant("a", "station.width = \"10 mm\""));
  EXPECT_NE(twice.find("vary.variants.name: found \"a\" a second time"), std::string::npos) << twice;
  const std::string both = fault(two_pressures + variants_follow + variant("a", "load.peak = \"500 MPa\""));
  EXPECT_NE(both.find("vary.key: found load.peak"), std::string::npos) << both;
}

}  // namespace

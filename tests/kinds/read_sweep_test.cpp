#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/study/study_uncertainty.hpp"
#include "store/temporary_folder.hpp"
#include "study/read_error.hpp"

#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The [axes] start at line 4.
const std::string sweep_text = "kind = \"sweep\"\nscene = \"scene_155mm.toml\"\n[axes]\n";

void expect_axes_error(const std::string& axes, const ExpectedError& expected) {
  expect_error_in(sweep_text + axes + "\n", expected);
}

std::string numbers(int count, double first, double step) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(first + step * static_cast<double>(i));
  return text;
}

/// Labels have six digits, and reports find cases by them.
TEST(ReadSweep, CasesThatDifferInTheSeventhDigitHaveLabelsOfTheirOwn) {
  const StudyFile study = study_of(sweep_text + "peak_pressure = \"400, 400.0001, 500 MPa\"\n");
  ASSERT_EQ(study.cases.size(), 3u);
  EXPECT_EQ(study.cases[0].label, "peak_pressure 400 MPa");
  EXPECT_EQ(study.cases[1].label, "peak_pressure 400 MPa (2)");
  EXPECT_EQ(study.cases[2].label, "peak_pressure 500 MPa");
}

TEST(ReadSweep, MakesTheProductOfTheAxesInTheOrderWritten) {
  const StudyFile study = study_of(sweep_text +
                                   "peak_pressure = \"400, 496 MPa\"\n"
                                   "gap = \"0, 0.02 cm\"\n"
                                   "flaw_size = [\"1 mm\", \"2 mm\"]\n"
                                   "load.steepness = [1.5, 1.4, 1.3]\n"
                                   "crack_radius = \"30 um\"\n");
  EXPECT_EQ(study.study.kind.name, kinds::traits_of("sweep").name);
  EXPECT_EQ(study.study.gaps, (std::vector<double>{0.0, 2e-4}));
  ASSERT_EQ(study.study.axes.size(), 4u);
  const char* names[] = {"peak_pressure", "flaw_size", "load.steepness", "crack_radius"};
  const char* keys[] = {"load.peak", "charge.flaw_size", "load.steepness", "charge.crack_radius"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(study.study.axes[i].name, names[i]);
    EXPECT_EQ(study.study.axes[i].key.name, keys[i]);
  }
  EXPECT_EQ(study.study.axes[2].values, (std::vector<double>{1.5, 1.4, 1.3}));
  ASSERT_EQ(study.cases.size(), 12u);
  const StudyCase& second = study.cases[1];
  EXPECT_EQ(second.label, "peak_pressure 400 MPa, flaw_size 0.1 cm, load.steepness 1.4, crack_radius 30 um");
  EXPECT_EQ(second.coordinates, (std::vector<double>{400e6, 1e-3, 1.4, 30e-6}));
  EXPECT_EQ(second.peak_pressure, 400e6);
  EXPECT_EQ(second.flaw_size, 1e-3);
  EXPECT_EQ(second.crack_radius, 30e-6);
  EXPECT_EQ(second.cell_size, study.scene.scene.numerics.cell_size);
  const scene::Scene& last = study.cases.back().scene.scene;
  EXPECT_EQ(last.load.peak, 496e6);
  EXPECT_EQ(last.charge().strength.flaw_size, 2e-3);
  EXPECT_EQ(last.load.steepness, 1.3);
}

TEST(ReadSweep, ACaseIsTheSceneWithItsKeys) {
  const StudyFile study =
      study_of(sweep_text + "gap.exchange_time = \"0.2, 0.3 ms\"\ninitial_temperature = \"290, 310 K\"\n");
  const scene::Place place{"a.toml", 1, 1};
  for (const StudyCase& each : study.cases) {
    const auto time = scene::with_key(study.scene, "gap.exchange_time", each.coordinates[0], place);
    const auto both = scene::with_key(*time, "initial_temperature", each.coordinates[1], place);
    EXPECT_EQ(scene::to_toml(each.scene.scene), scene::to_toml(both->scene));
  }
}

TEST(ReadSweep, TakesKeysDottedQuotedOrAsTables) {
  const std::string values = "[1.4, 1.5]\n";
  const std::vector<std::string> ways{
      sweep_text + "load.steepness = " + values, sweep_text + "\"load.steepness\" = " + values,
      sweep_text + "load = { steepness = [1.4, 1.5] }\n", sweep_text + "[axes.load]\nsteepness = " + values,
      "kind = \"sweep\"\nscene = \"scene_155mm.toml\"\naxes = { load.steepness = [1.4, 1.5] }\n"};
  for (const std::string& text : ways) {
    const StudyFile study = study_of(text);
    ASSERT_EQ(study.study.axes.size(), 1u) << text;
    EXPECT_EQ(study.study.axes[0].name, "load.steepness");
    EXPECT_EQ(study.cases.size(), 2u);
  }
  const StudyFile beside = study_of(sweep_text + "gap = \"0.01 cm\"\n\"gap.exchange_time\" = \"0.3 ms\"\n");
  EXPECT_EQ(beside.study.gaps, std::vector<double>{1e-4});
  EXPECT_EQ(beside.cases[0].coordinates, std::vector<double>{3e-4});
}

TEST(ReadSweep, WithoutAxesIsTheSceneAlone) {
  for (const std::string& text : {sweep_text, sweep_text.substr(0, sweep_text.find("[axes]"))}) {
    const StudyFile study = study_of(text);
    EXPECT_EQ(study.study.gaps, study.scene.scene.surface.gaps);
    ASSERT_EQ(study.cases.size(), 1u);
    EXPECT_EQ(study.cases[0].label, "496 MPa, 30 um, 1 mm");
    EXPECT_TRUE(study.cases[0].own_conditions);
    EXPECT_TRUE(study.cases[0].coordinates.empty());
  }
}

TEST(ReadSweep, TakesTheKeysThatJudgeGaps) {
  const StudyFile study = study_of(
      "kind = \"sweep\"\nscene = \"scene_155mm.toml\"\ntolerance = \"2 um\"\nlargest_gap = \"0.2 cm\"\n"
      "numerical_uncertainty = { value = \"1.5 K\", because = \"for a test\" }\n[axes]\npeak_pressure = "
      "\"400, 496 MPa\"\n"
      "[[reference]]\ngap = \"0 cm\"\nmaximum_temperature = \"416 K\"\n");
  EXPECT_EQ(study.study.tolerance, 2e-6);
  EXPECT_EQ(study.study.largest_gap, 2e-3);
  EXPECT_EQ(numerical_uncertainty_of(study).largest, 1.5);
  EXPECT_EQ(study.study.references.size(), 1u);
  EXPECT_FALSE(study.cases[0].own_conditions);
  EXPECT_TRUE(study.cases[1].own_conditions);
}

TEST(ReadSweep, OnlyAnotherLaunchIsNotTheReferences) {
  const auto own = [](const std::string& axis) {
    return study_of(sweep_text + axis + "\n").cases[0].own_conditions;
  };
  EXPECT_TRUE(own("numerics.cell_size = \"5 mm\""));
  EXPECT_TRUE(own("friction.localisation = 500"));
  EXPECT_TRUE(own("charge.density = \"1717 kg/m3\""));
  EXPECT_FALSE(own("charge.density = \"1700 kg/m3\""));
  EXPECT_FALSE(own("load.steepness = 1.5"));
  EXPECT_FALSE(own("initial_temperature = \"310 K\""));
}

class SlidingSweep : public launchsafe::testing::TemporaryFolder {};

TEST_F(SlidingSweep, FrictionMayVaryAndHasNoStatedUncertainty) {
  std::filesystem::copy_file(studies_folder / "scene_155mm.toml", folder() / "slides.toml");
  const auto study = parse_study(
      "kind = \"sweep\"\nscene = \"slides.toml\"\nnumerical_uncertainty = { value = \"1 K\", because = \"for "
      "a test\" }\n[axes]\n"
      "interface.wall.friction = [0, 0.3]\n",
      folder() / "study.toml");
  ASSERT_TRUE(study) << study.error().message();
  ASSERT_EQ(study->cases.size(), 2u);
  const auto friction_of_wall = [](const StudyCase& input) {
    const auto wall = std::find_if(input.scene.scene.interfaces.begin(), input.scene.scene.interfaces.end(),
                                   [](const scene::Interface& each) { return each.body == "wall"; });
    return wall->friction;
  };
  EXPECT_EQ(friction_of_wall(study->cases[0]), 0.0);
  EXPECT_EQ(friction_of_wall(study->cases[1]), 0.3);
  EXPECT_EQ(numerical_uncertainty_of(*study).largest, assumed_numerical_uncertainty);
}

TEST(ReadSweep, NumericsOnAnAxisHaveNoStatedUncertainty) {
  const std::string start = "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n";
  EXPECT_EQ(numerical_uncertainty_of(study_of(start + sweep_text + "peak_pressure = \"400 MPa\"\n")).largest,
            1.0);
  const StudyFile other = study_of(start + sweep_text + "numerics.cell_size = \"2.5, 5 mm\"\n");
  EXPECT_EQ(numerical_uncertainty_of(other).largest, assumed_numerical_uncertainty);
  EXPECT_TRUE(numerical_uncertainty_of(other).assumed);
  // An even grid with cells of 5 mm does not run along the charge; a lattice always does.
  const StudyFile off_grid = study_of(
      start + sweep_text + "numerics.cell_size = \"2.5, 5 mm\"\n" +
      "[set]\nnumerics.formulation = \"updated-lagrangian\"\nnumerics.growth_x = 1\nnumerics.growth_r = 1\n"
      "interface.nose.condition = \"bonded\"\ninterface.wall.condition = \"bonded\"\n");
  EXPECT_EQ(numerical_uncertainty_of(off_grid).largest, assumed_uncertainty_off_grid);
}

TEST(ReadSweep, ChangesThatNeedEachOtherAreOneScene) {
  // Either alone, on a scene of 0.1 MPa to 496 MPa, is a base above the peak.
  const std::string base_first = "load.base = \"600 MPa\"\npeak_pressure = \"700, 800 MPa\"\n";
  const std::string peak_first = "peak_pressure = \"700, 800 MPa\"\nload.base = \"600 MPa\"\n";
  for (const std::string& axes : {base_first, peak_first}) {
    const StudyFile study = study_of(sweep_text + axes);
    ASSERT_EQ(study.cases.size(), 2u);
    EXPECT_EQ(study.cases[1].scene.scene.load.base, 600e6);
    EXPECT_EQ(study.cases[1].scene.scene.load.peak, 800e6);
  }
}

TEST(ReadSweep, FaultsOfAxesNameFileLineKeyFoundAndAllowed) {
  expect_axes_error("gap.thickness = \"0.01 cm\"", {4, "axes.gap.thickness", "as an axis", "gap", "gap"});
  expect_axes_error("gap = \"0.01 mm, 10 um\"", {4, "axes.gap", "twice", "once"});
  expect_axes_error("gap = \"-1 cm\"", {4, "axes.gap", "-1 cm", "length"});
  expect_axes_error("gap = []", {4, "axes.gap", "empty"});
  expect_axes_error("gaps = \"1 mm\"", {4, "axes.gaps", "unknown key", "peak_pressure", "gap"});
  expect_axes_error("peak_presure = \"1 MPa\"",
                    {4, "axes.peak_presure", "unknown key", "load.steepness", "peak_pressure"});
  expect_axes_error("peak_pressures = \"1 MPa\"", {4, "axes.peak_pressures", "unknown", "", "peak_pressure"});
  expect_axes_error("load.stepness = 3",
                    {4, "axes.load.stepness", "unknown key", "[load]", "load.steepness"});
  expect_axes_error("load.steepness = 3\nload.stepness = 3", {5, "axes.load.stepness", "unknown key"});
  expect_axes_error("peak_pressure = \"400, 400 MPa\"", {4, "axes.peak_pressure", "twice", "once"});
  expect_axes_error("peak_pressure = [400]", {4, "axes.peak_pressure", "without a unit", "", "400 MPa"});
  expect_axes_error("peak_pressure = \"400, 500\"", {4, "axes.peak_pressure", "without a unit"});
  expect_axes_error("peak_pressure = \"-1 MPa\"", {4, "axes.peak_pressure", "-1 MPa", "0 MPa (excluded)"});
  expect_axes_error("peak_pressure = []", {4, "axes.peak_pressure", "empty"});
  expect_axes_error("peak_pressure = \"\"", {4, "axes.peak_pressure", ""});
  expect_axes_error("peak_pressure = \"300 K\"", {4, "axes.peak_pressure", "which is a temperature"});
  expect_axes_error("peak_pressure = { a = 1 }", {4, "axes.peak_pressure.a", "unknown"});
  expect_axes_error("numerics.particles_per_cell = [1, 1.5]", {4, "axes.numerics.particles_per_cell", "1.5"});
  expect_axes_error("peak_pressure = \"400 MPa\"\nload.peak = \"500 MPa\"",
                    {5, "axes.load.peak", "second time, after peak_pressure", "once"});
  expect_axes_error("crack_radius = \"30 um\"\n[set]\ncharge.crack_radius = \"20 um\"",
                    {4, "axes.crack_radius", "[set]", "either"});
  expect_error_in("kind = \"sweep\"\nscene = \"scene_155mm.toml\"\naxes = 3\n", {3, "axes", "3", "[axes]"});
}

TEST(ReadSweep, AnAxisIsAKeyThatTakesOneNumber) {
  const std::string allowed = "a scene key that takes one number";
  expect_axes_error("symmetry = \"axisymmetric\"", {4, "axes.symmetry", "takes a word", allowed});
  expect_axes_error("load.curve = \"a.csv\"", {4, "axes.load.curve", "takes a text", allowed});
  expect_axes_error("charge.shear_moduli = \"1 MPa\"", {4, "axes.charge.shear_moduli", "a list", allowed});
  expect_axes_error("charge.crack_growth = [true, false]", {4, "axes.charge.crack_growth", "true", allowed});
  expect_axes_error("body.nose.x = \"0 to 1 cm\"", {4, "axes.body.nose.x", "takes a range", allowed});
}

TEST(ReadSweep, AValueThatTheSceneCannotHaveNamesTheAxis) {
  expect_axes_error("load.base = \"1, 900 MPa\"",
                    {4, "axes.load.base", "a base of 900 MPa and a peak of 496 MPa", "at most the peak"});
  expect_axes_error("flaw_size = \"1 mm\"\nload.base = \"900 MPa\"\npeak_pressure = \"400 MPa\"",
                    {5, "axes.load.base", "900 MPa and a peak of 400 MPa"});
  expect_axes_error("numerics.cell_size = \"50 cm\"", {4, "axes.numerics.cell_size", "50 cm"});
  expect_axes_error("load.duration = \"1 us\"",
                    {4, "axes.load.duration", "1 us, with which output.trace_interval is", "at most"});
}

TEST(ReadSweep, KeysOfOtherKindsAreErrors) {
  const std::string start = "kind = \"sweep\"\nscene = \"scene_155mm.toml\"\n";
  expect_error_in(start + "confirm = true\n", {3, "confirm", "kind \"critical-gap\"", "\"sweep\""});
  expect_error_in(start + "gaps = \"1 mm\"\n", {3, "gaps", "critical-gap", "", "gap in [axes]"});
  expect_error_in(start + "peak_pressures = \"1 MPa\"\n", {3, "peak_pressures", "", "", "peak_pressure in"});
  expect_error_in(start + "meshes = \"1 mm\"\n", {3, "meshes", "kind \"calibration\""});
  expect_error_in(start + "samples = 3\n", {3, "samples", "kind \"sensitivity\""});
  expect_error_in(start + "[[input]]\nkey = \"peak_pressure\"\n", {3, "input", "kind \"sensitivity\""});
  expect_error_in(critical_kind + "[axes]\ngap = \"1 mm\"\n", {3, "axes", "kind \"sweep\"", "critical-gap"});
  expect_error_in("kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n[axes]\n",
                  {3, "axes", "kind \"sweep\"", "calibration"});
}

TEST(ReadSweep, TheAnalyticLoadDoesNotVaryUnderAMeasuredCurve) {
  const std::string file = ::testing::TempDir() + "read_sweep_curve.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  const std::string curve = "[set]\nload.curve = \"" + file + "\"\n";
  expect_error_in(sweep_text + "peak_pressure = \"400 MPa\"\n" + curve,
                  {4, "axes.peak_pressure", "not rescaled", "load.rescale_to_peak = true"});
  expect_error_in(sweep_text + "load.steepness = 10\n" + curve, {4, "axes.load.steepness", "measured curve"});
  const StudyFile study =
      study_of(sweep_text + "peak_pressure = \"300 MPa\"\n" + curve + "load.rescale_to_peak = true\n");
  EXPECT_EQ(study.cases[0].peak_pressure, 300e6);
  EXPECT_TRUE(study_of(sweep_text + curve).cases[0].own_conditions);
}

TEST(ReadSweep, ThereIsAMostOfCases) {
  const std::string axis = "= [" + numbers(101, 1.0, 0.01) + "]\n";
  expect_axes_error(
      "load.steepness " + axis + "charge.face_friction = [" + numbers(101, 0.0, 0.01) +
          "]\nsteel.gruneisen = [" + numbers(101, 1.0, 0.01) + "]",
      {4, "axes.load.steepness", "1030301 mechanical runs, 101 of axes.load.steepness x", "at most 1000000"});
}

}  // namespace

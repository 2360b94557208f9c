#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "study/read_error.hpp"
#include "study/synthetic_launch.hpp"

#include <cstddef>
#include <utility>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

scene::InputError error_of(const std::string& text) {
  const auto study = parse_here(text);
  EXPECT_FALSE(study) << "the study was accepted";
  return study ? scene::InputError{} : study.error();
}

/// A study with one more line must fail there.
void expect_error(const std::string& line, const std::string& key, const std::string& found,
                  const std::string& allowed = "") {
  const scene::InputError error = error_of(critical_kind + line + "\n");
  EXPECT_NE(error.file.find("some_study.toml"), std::string::npos) << error.message();
  EXPECT_EQ(error.line, 3) << error.message();
  EXPECT_EQ(error.key, key) << error.message();
  EXPECT_NE(error.found.find(found), std::string::npos) << error.message();
  EXPECT_NE(error.allowed.find(allowed), std::string::npos) << error.message();
  EXPECT_FALSE(error.allowed.empty()) << error.message();
}

TEST(ReadStudy, SetsInterfacesThatTheSceneDoesNotHave) {
  const std::string start = "kind = \"critical-gap\"\nscene = \"scene_155mm.toml\"\n";
  const StudyFile study =
      study_of(start + "[set]\ninterface.base.condition = \"sliding\"\ninterface.base.friction = 0\n");
  ASSERT_EQ(study.scene.scene.interfaces.size(), 3u);  // nose and wall stand in the scene
  EXPECT_EQ(study.scene.scene.interfaces[2].body, "base");
  EXPECT_EQ(study.scene.scene.interfaces[2].friction, 0.0);
  expect_error_in(start + "[set]\ninterface.base.condition = \"sliding\"\n",
                  {4, "set.interface.base.condition", "without their friction", "interface.base.friction"});
  expect_error_in(start + "[set]\ninterface.barrel.friction = 0.1\n",
                  {4, "set.interface.barrel.friction", "unknown"});
  expect_error_in(start + "[set]\ninterface.wall.condition = \"sliding\"\ninterface.wall.friction = 11\n",
                  {5, "set.interface.wall.friction", "11", "0 to 10"});
}

TEST(ReadStudy, TheShippedStudiesAreValid) {
  const auto critical = read_study(studies_folder / "critical_gap_155mm.toml");
  ASSERT_TRUE(critical) << critical.error().message();
  EXPECT_EQ(critical->study.kind.name, kinds::traits_of("critical-gap").name);
  EXPECT_EQ(critical->study.gaps.size(), 6u);
  EXPECT_EQ(critical->study.tolerance, 1e-6);
  EXPECT_EQ(critical->study.references.size(), 6u);
  EXPECT_EQ(critical->cases.size(), 1u);
  const auto calibration = read_study(studies_folder / "calibrate_table8.toml");
  ASSERT_TRUE(calibration) << calibration.error().message();
  EXPECT_EQ(calibration->study.kind.name, kinds::traits_of("calibration").name);
  ASSERT_EQ(calibration->cases.size(), 3u);
  EXPECT_EQ(calibration->cases[1].cell_size(), 2.5e-3);
  EXPECT_EQ(calibration->cases[1].scene.scene.numerics.cell_size, 2.5e-3);
}

TEST(ReadStudy, TakesWhatItDoesNotSayFromTheScene) {
  const StudyFile study = study_of(critical_kind);
  EXPECT_EQ(study.study.gaps, study.scene.scene.surface.gaps);
  ASSERT_EQ(study.cases.size(), 1u);
  EXPECT_EQ(study.cases[0].label, "496 MPa, 30 µm, 1 mm");
  EXPECT_EQ(study.study.largest_gap, 1e-3);
  EXPECT_TRUE(settings_of<CriticalGapSettings>(study.study).confirm);
}

TEST(ReadStudy, ACopyHasTheSettingsOfItsKindUntilEitherChangesThem) {
  const StudyFile read = study_of(critical_kind + "confirm = false\n");
  Study copy = read.study;
  EXPECT_FALSE(settings_of<CriticalGapSettings>(std::as_const(copy)).confirm);
  settings_of<CriticalGapSettings>(copy).confirm = true;
  EXPECT_TRUE(settings_of<CriticalGapSettings>(copy).confirm);
  EXPECT_FALSE(settings_of<CriticalGapSettings>(read.study).confirm);
  copy.settings.reset();
  EXPECT_TRUE(settings_of<CriticalGapSettings>(std::as_const(copy)).confirm);  // as in the struct
}

TEST(ReadStudy, MakesTheProductOfPressuresAndDefects) {
  const StudyFile study = study_of(critical_kind + vary({{"peak_pressure", "400, 500 MPa"},
                                                         {"crack_radius", "10, 30, 100 um"},
                                                         {"flaw_size", "1, 2 mm"}}));
  ASSERT_EQ(study.cases.size(), 12u);
  EXPECT_EQ(study.cases[0].label, "400 MPa, 10 µm, 1 mm");
  EXPECT_EQ(study.cases[1].label, "400 MPa, 10 µm, 2 mm");
  EXPECT_EQ(study.cases[11].label, "500 MPa, 100 µm, 2 mm");
  EXPECT_EQ(study.cases[11].scene.scene.load.peak, 500e6);
  EXPECT_EQ(study.cases[11].scene.scene.charge().strength.initial_crack_radius, 1e-4);
  EXPECT_EQ(study.cases[11].scene.scene.charge().strength.flaw_size, 2e-3);
}

TEST(ReadStudy, OverridesSceneKeys) {
  const StudyFile study =
      study_of(critical_kind + "[set]\nnumerics.inertial_scaling = 16\n\"gap.exchange_time\" = \"0.5 ms\"\n");
  EXPECT_EQ(study.cases[0].scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(study.cases[0].scene.scene.surface.exchange_time, 5e-4);
  EXPECT_EQ(study.overrides.size(), 2u);
}

// Applied one after the other, one of each pair would take the other back.
TEST(ReadStudy, OverridesAreOfOneMindInWhicheverOrderTheyAreWritten) {
  const std::string friction = "charge.face_friction = 0\n", switched = "charge.crack_friction = true\n";
  for (const std::string& both : {friction + switched, switched + friction}) {
    const scene::InputError error = error_of(critical_kind + "[set]\n" + both);
    EXPECT_EQ(error.key, "set.charge.crack_friction") << error.message();
    EXPECT_NE(error.found.find("face_friction = 0"), std::string::npos) << error.message();
  }
  const std::string shape = "load.shape = \"bell\"\n", width = "load.width = \"2.5 ms\"\n";
  for (const std::string& both : {shape + width, width + shape})
    EXPECT_EQ(study_of(critical_kind + "[set]\n" + both).cases[0].scene.scene.load.width, 2.5e-3) << both;
}

TEST(ReadStudy, FaultsNameFileLineKeyFoundAndAllowed) {
  expect_error("gaps = \"0, 0.01, 0.01 cm\"", "gaps", "twice", "once");
  expect_error("gaps = []", "gaps", "empty");
  expect_error("gaps = \"\"", "gaps", "");
  expect_error("gaps = \"-0.01 cm\"", "gaps", "-0.01");
  expect_error("gaps = \"nan cm\"", "gaps", "nan");
  expect_error("gaps = [0.01]", "gaps", "without a unit");
  expect_error("gaps = \"1 MPa\"", "gaps", "MPa");
  expect_error("tolerance = \"0 cm\"", "tolerance", "0 cm");
  expect_error("numerical_uncertainty = { value = \"-2 K\", because = \"for a test\" }",
               "numerical_uncertainty.value", "-2");
  expect_error("confirm = \"yes\"", "confirm", "yes");
  expect_error("meshes = \"1 mm\"", "meshes", "kind \"calibration\"", "critical-gap");
  expect_error("early_time = \"1 s\"", "early_time", "1 s", "within the load's duration");
  expect_error("reference_line.slope = 2702.1", "reference_line.slope", "without an intercept");
  expect_error("set = 3", "set", "3", "[set]");
  expect_error("set = { numerics.cell_sise = \"1 mm\" }", "set.numerics.cell_sise", "unknown key");
  expect_error("set = { numerics.cell_size = \"1 K\" }", "set.numerics.cell_size", "1 K");
  expect_error("reference = [{ gap = \"0 cm\" }, { gap = \"0 cm\" }]", "reference.gap", "twice");
  expect_error("reference = [{ maximum_temperature = \"400 K\" }]", "reference.gap", "missing");
  expect_error("reference = [{ gap = \"0 cm\", temperature = \"400 K\" }]", "reference.temperature",
               "unknown");
}

// People write the keys of a scene as they stand there.
TEST(ReadStudy, AKeyOfScenesIsToldHowAStudySetsIt) {
  for (const char* text : {"[load]\npeak = \"450 MPa\"\n", "load.peak = \"450 MPa\"\n"})
    EXPECT_EQ(error_of(critical_kind + text).suggestion,
              "set = { load.peak = ... } above the first [table], where it belongs");
}

// Issue 30, point 12: an uncertainty that a study states by hand says where it comes from, as accept does.
TEST(ReadStudy, AnUncertaintyThatIsStatedByHandNeedsItsSourceInWords) {
  for (const std::string key :
       {"numerical_uncertainty", "fit_uncertainty", "input_uncertainty", "model_form_uncertainty"}) {
    const scene::InputError bare = error_of(critical_kind + key + " = \"2 K\"\n");
    EXPECT_EQ(bare.key, key);
    EXPECT_EQ(bare.line, 3);
    EXPECT_EQ(bare.suggestion, "{ value = \"2 K\", because = \"...\" }");
    expect_error(key + " = 2", key, "2 without a source", "in words");
    expect_error(key + " = {}", key, "without a source", "in words");
    expect_error(key + " = { value = \"2 K\" }", key + ".value", "without a source", key + " = {");
    expect_error(key + " = { because = \"for a test\" }", key + ".because", "without a value", key + " = {");
    expect_error(key + " = { value = \"2 K\", because = \"x\" }", key + ".because", "\"x\"", "in words");
    expect_error(key + " = { value = \"2 K\", becuase = \"for a test\" }", key + ".becuase", "unknown key");
  }
}

TEST(ReadStudy, AStatedUncertaintyIsKeptWithItsSource) {
  const StudyFile study = study_of(
      critical_kind + "numerical_uncertainty = { value = \"2 K\", because = \"two meshes of it\" }\n");
  ASSERT_EQ(study.study.stated.size(), 1u);
  EXPECT_EQ(study.study.stated[0].key, "numerical_uncertainty");
  EXPECT_EQ(study.study.stated[0].value, 2.0);
  EXPECT_EQ(study.study.stated[0].because, "two meshes of it");
  EXPECT_EQ(study.study.numerical_uncertainty, 2.0);
}

TEST(ReadStudy, AnUnknownKindNamesTheKindsThereAre) {
  const scene::InputError error = error_of("kind = \"critical gap\"\nscene = \"scene_155mm.toml\"\n");
  EXPECT_EQ(error.line, 1);
  EXPECT_EQ(error.key, "kind");
  EXPECT_NE(error.allowed.find("critical-gap"), std::string::npos) << error.message();
  EXPECT_NE(error.allowed.find("calibration"), std::string::npos) << error.message();
}

TEST(ReadStudy, AMissingSceneIsNamedWhereItIsAskedFor) {
  const scene::InputError error = error_of("kind = \"critical-gap\"\nscene = \"scene_155m.toml\"\n");
  EXPECT_EQ(error.line, 2);
  EXPECT_EQ(error.key, "scene");
  EXPECT_NE(error.suggestion.find("scene_155mm.toml"), std::string::npos) << error.message();
}

TEST(ReadStudy, AMissingFileIsAnError) {
  const auto study = read_study(studies_folder / "critical_gap_155.toml");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().suggestion.find("critical_gap_155mm.toml"), std::string::npos);
}

TEST(ReadStudy, ACalibrationNeedsItsRows) {
  const std::string start = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
  EXPECT_EQ(error_of(start).key, "reference");
  const std::string zero = "{ gap = \"0 cm\", maximum_temperature = \"416.1 K\", calibrated = true }";
  const std::string wide = "{ gap = \"0.02 cm\", maximum_temperature = \"467.7 K\", calibrated = true }";
  const scene::InputError error = error_of(start + "reference = [" + zero + ", " + wide + "]\n");
  EXPECT_NE(error.found.find("no row that ignites"), std::string::npos) << error.message();
  EXPECT_EQ(error.line, 3);
}

// Constants fitted under 550 MPa to the rows of a launch of 496 MPa made 0.005 cm SAFE, of which those of 496
// MPa show that it may ignite without a gap; fitted to them on a charge of 70 cm they made 0.025 cm SAFE, of
// which those of the shell that the rows are of allow 0.01 cm at the most.
TEST(ReadStudy, ACalibrationFitsNothingToRowsOfAnotherLaunch) {
  const auto found = [](const std::string& scene, const std::string& head, const std::string& set) {
    const auto study = parse_here("kind = \"calibration\"\nscene = \"" + scene +
                                  "\"\nreferences = \"table8.toml\"\n" + head + "[set]\n" + set);
    EXPECT_TRUE(study || study.error().file.ends_with("table8.toml")) << study.error().message();
    return study ? std::string() : study.error().found;
  };
  const std::string own = "scene_155mm.toml", fitted = "load_fitted = true\n";
  const std::tuple<std::string, std::string, std::string, std::string> launches[] = {
      {"scene_203mm.toml", fitted, "load.peak = \"496 MPa\"", "calibration.shell = 4 bodies, 74 cm long"},
      {own, fitted, "load.peak = \"550 MPa\"", "load.peak = 496 MPa, and 550 MPa"},
      {own, fitted, "initial_temperature = \"310 K\"", "initial_temperature = 300 K, and 310 K"},
      {own, fitted, "charge.density = \"1.6 g/cm3\"", "charge.density = 1717 kg/m3, and 1600 kg/m3"},
      {own, fitted, "load.muzzle_exit = \"16 ms\"", "load.muzzle_exit = 18 ms, and 16 ms"},
      {own, "", "load.width = \"4 ms\"", "load.width = 2.92"}};
  for (const auto& [scene, head, set, difference] : launches)
    EXPECT_NE(found(scene, head, set).find(difference), std::string::npos)
        << set << ": " << found(scene, head, set);
  // A model of the launch, its mesh, and what is fitted.
  for (const std::string set : {"interface.wall.friction = 0.1", "friction.closure = \"inelastic\"",
                                "numerics.cell_size = \"2.5 mm\"", "load.width = \"4 ms\""})
    EXPECT_EQ(found(own, fitted, set), "");
}

TEST(ReadStudy, ACalibrationNeedsTheLaunchOfItsRows) {
  std::string rows = "reference = [";
  for (const char* row : {"gap = \"0 cm\", maximum_temperature = \"416 K\", calibrated = true",
                          "gap = \"0.02 cm\", maximum_temperature = \"468 K\", calibrated = true",
                          "gap = \"0.04 cm\", ignition_time = \"17 ms\""})
    rows += fmt::format("\n{{ {}, scene = \"scene_155mm.toml\" }},", row);
  const std::string start = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
  study_of(start + rows + "]\n");
  // That of the last one alone says where T1 is.
  const std::string without = rows.substr(0, rows.rfind(", scene")) + " }]\n";
  const scene::InputError error = error_of(start + without);
  EXPECT_EQ(error.found, "a row without scene") << error.message();
}

// A message that names what is allowed must not give an example that is not.
TEST(ReadStudy, TheExampleOfANumberWithoutUnitIsOneThatTheKeyAllows) {
  int checked = 0;
  for (const scene::DocumentedKey& each : kinds::describe_study_keys()) {
    const scene::KeyDescription& key = each.description;
    if (key.kind != scene::KeyKind::number || !scene::units_of(key.dimension).empty()) continue;
    const auto value = scene::parse_quantity(scene::example_of(key), key.dimension);
    ASSERT_TRUE(value) << key.name;
    EXPECT_TRUE(key.limits.contain(*value)) << key.name << ": " << scene::example_of(key);
    ++checked;
  }
  EXPECT_GT(checked, 5);
}

}  // namespace

#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "study/read_error.hpp"
#include "study/synthetic_launch.hpp"

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// A study with one more line must fail there.
void expect_error(const std::string& line, const std::string& key, const std::string& found = "") {
  expect_error_in(critical_kind + line + "\n", {3, key, found});
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
  ASSERT_EQ(calibration->cases.size(), 1u);
  EXPECT_EQ(calibration->cases[0].cell_size(), 1.25e-3);
  for (const char* model : {"calibrate_table8_coarse", "bonded_base", "bonded_base_coarse", "wall_friction",
                            "wall_friction_coarse"}) {
    const auto other = read_study(studies_folder / "models" / (std::string(model) + ".toml"));
    EXPECT_TRUE(other) << (other ? "" : other.error().message());
  }
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
  const std::string shape = "load.shape = \"bell\"\n", width = "load.width = \"3.1 ms\"\n";
  for (const std::string& both : {shape + width, width + shape})
    EXPECT_EQ(study_of(critical_kind + "[set]\n" + both).cases[0].scene.scene.load.width, 3.1e-3) << both;
}

TEST(ReadStudy, FaultsNameFileLineAndKey) {
  expect_error("gaps = \"0, 0.01, 0.01 cm\"", "gaps");
  expect_error("gaps = []", "gaps");
  expect_error("gaps = \"-0.01 cm\"", "gaps", "-0.01");
  expect_error("gaps = \"nan cm\"", "gaps", "nan");
  expect_error("gaps = [0.01]", "gaps");
  expect_error("gaps = \"1 MPa\"", "gaps", "MPa");
  expect_error("tolerance = \"0 cm\"", "tolerance", "0 cm");
  expect_error("confirm = \"yes\"", "confirm", "yes");
  expect_error("meshes = \"1 mm\"", "meshes");
  expect_error("early_time = \"1 s\"", "early_time", "1 s");
  expect_error("reference_line.slope = 2702.1", "reference_line.slope");
  expect_error("models = \"bonded\"", "models", "bonded");
  expect_error("set = 3", "set", "3");
  expect_error("set = { numerics.cell_sise = \"1 mm\" }", "set.numerics.cell_sise");
  expect_error("set = { numerics.cell_size = \"1 K\" }", "set.numerics.cell_size", "1 K");
  expect_error("reference = [{ gap = \"0 cm\" }, { gap = \"0 cm\" }]", "reference.gap");
}

// Issue 30, point 12: an uncertainty that a study states by hand says where it comes from, as accept does.
TEST(ReadStudy, AnUncertaintyThatIsStatedByHandNeedsItsSourceInWords) {
  for (const std::string key : {"numerical_uncertainty", "fit_uncertainty", "input_uncertainty"}) {
    const scene::InputError bare = error_in(critical_kind + key + " = \"2 K\"\n");
    EXPECT_EQ(bare.key, key);
    EXPECT_EQ(bare.line, 3);
    expect_error(key + " = 2", key);
    expect_error(key + " = { value = \"2 K\" }", key + ".value");
    expect_error(key + " = { value = \"2 K\", because = \"x\" }", key + ".because", "\"x\"");
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
  const scene::InputError error = error_in("kind = \"critical gap\"\nscene = \"scene_155mm.toml\"\n");
  EXPECT_EQ(error.line, 1);
  EXPECT_EQ(error.key, "kind");
  EXPECT_NE(error.allowed.find("critical-gap"), std::string::npos) << error.message();
  EXPECT_NE(error.allowed.find("calibration"), std::string::npos) << error.message();
}

TEST(ReadStudy, AMissingSceneIsNamedWhereItIsAskedFor) {
  const scene::InputError error = error_in("kind = \"critical-gap\"\nscene = \"scene_155m.toml\"\n");
  EXPECT_EQ(error.line, 2);
  EXPECT_EQ(error.key, "scene");
  EXPECT_NE(error.suggestion.find("scene_155mm.toml"), std::string::npos) << error.message();
}

TEST(ReadStudy, ACalibrationNeedsItsRows) {
  const std::string start = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
  EXPECT_EQ(error_in(start).key, "reference");
  const std::string zero = "{ gap = \"0 cm\", maximum_temperature = \"416.1 K\" }";
  const std::string wide = "{ gap = \"0.02 cm\", maximum_temperature = \"467.7 K\" }";
  const scene::InputError error = error_in(start + "reference = [" + zero + ", " + wide + "]\n");
  EXPECT_EQ(error.line, 3);
}

// Constants fitted under 550 MPa to the rows of a launch of 496 MPa made 0.005 cm SAFE, of which those of 496
// MPa show that it may ignite without a gap; fitted to them on a charge of 70 cm they made 0.025 cm SAFE, of
// which those of the shell that the rows are of allow 0.01 cm at the most.
TEST(ReadStudy, ACalibrationFitsNothingToRowsOfAnotherLaunch) {
  const auto found = [](const std::string& scene, const std::string& set) {
    const auto study = parse_here("kind = \"calibration\"\nscene = \"" + scene +
                                  "\"\nreferences = \"table8.toml\"\n[set]\n" + set);
    EXPECT_TRUE(study || study.error().file.ends_with("table8.toml")) << study.error().message();
    return study ? std::string() : study.error().found;
  };
  const std::string own = "scene_155mm.toml";
  const std::tuple<std::string, std::string, std::string> launches[] = {
      {"scene_203mm.toml", "load.peak = \"496 MPa\"", "calibration.shell"},
      {own, "load.peak = \"550 MPa\"", "load.peak"},
      {own, "initial_temperature = \"310 K\"", "initial_temperature"},
      {own, "charge.density = \"1.6 g/cm3\"", "charge.density"},
      {own, "load.muzzle_exit = \"16 ms\"", "load.muzzle_exit"}};
  for (const auto& [scene, set, difference] : launches)
    EXPECT_NE(found(scene, set).find(difference), std::string::npos) << set << ": " << found(scene, set);
  // A model of the launch, its mesh, and what constants hold.
  for (const std::string set :
       {"interface.wall.friction = 0.1", "friction.closure = \"none\"", "numerics.cell_size = \"2.5 mm\"",
        "load.width = \"4 ms\"", "steel.yield_stress = \"700 MPa\""})
    EXPECT_EQ(found(own, set), "");
}

TEST(ReadStudy, ACalibrationNeedsTheLaunchOfItsRows) {
  std::string rows = "reference = [";
  for (const char* row :
       {"gap = \"0 cm\", maximum_temperature = \"416 K\"",
        "gap = \"0.02 cm\", maximum_temperature = \"468 K\"", "gap = \"0.04 cm\", ignition_time = \"17 ms\""})
    rows += fmt::format("\n{{ {}, scene = \"scene_155mm.toml\" }},", row);
  const std::string start = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
  study_of(start + rows + "]\n");
  // That of the last one alone says where T1 is.
  const std::string without = rows.substr(0, rows.rfind(", scene")) + " }]\n";
  const scene::InputError error = error_in(start + without);
  EXPECT_EQ(error.key, "reference") << error.message();
}

}  // namespace

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
  EXPECT_EQ(critical->study.largest_gap, 1e-2);
  EXPECT_EQ(critical->study.spreads.peak_pressure, 0.04);
  EXPECT_EQ(critical->study.models.size(), 2u);
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
      study_of(critical_kind + "[set]\nnumerics.inertial_scaling = 16\n\"charge.flaw_size\" = \"0.8 mm\"\n");
  EXPECT_EQ(study.cases[0].scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(study.cases[0].scene.scene.charge().strength.flaw_size, 8e-4);
  EXPECT_EQ(study.overrides.size(), 2u);
}

// A constants file is the one place of what was fitted or chosen.
TEST(ReadStudy, AConstantThatAStudyStatesIsRefusedWhereVerdictsAreGiven) {
  for (const char* set : {"friction.localisation = 500", "gap.exchange_time = \"0.5 ms\"",
                          "kinetics.ignition_temperature = \"530 K\"", "load.width = \"3 ms\"",
                          "station.width = \"10 mm\"", "interface.wall.friction = 0.1"}) {
    const auto study = parse_here(critical_kind + "[set]\n" + set + "\n");
    ASSERT_FALSE(study) << set;
    EXPECT_EQ(study.error().line, 4) << set;
  }
  EXPECT_TRUE(parse_here(critical_kind + "[set]\nsteel.yield_stress = \"792 MPa\"\n"));
}

TEST(ReadStudy, FaultsNameFileLineAndKey) {
  expect_error("gaps = \"0, 0.01, 0.01 cm\"", "gaps");
  expect_error("gaps = []", "gaps");
  expect_error("gaps = \"-0.01 cm\"", "gaps", "-0.01");
  expect_error("gaps = \"nan cm\"", "gaps", "nan");
  expect_error("gaps = [0.01]", "gaps");
  expect_error("gaps = \"1 MPa\"", "gaps", "MPa");
  expect_error("largest_gap = \"2 cm\"", "largest_gap", "2 cm");
  expect_error("uncertainty.peak_pressure = \"30 %\"", "uncertainty.peak_pressure", "30 %");
  expect_error("accept.shell-yield = \"a reason in words\"", "accept.shell-yield");
  expect_error("accept.energy = \"a reason in words\"", "accept.energy");
  expect_error("accept.shell-yields = \"...\"", "accept.shell-yields", "...");
  expect_error("accept.extrapolation.explosive = \"a reason in words\"", "accept.extrapolation.explosive");
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

TEST(ReadStudy, StatedNumericsNeedAGroundInWords) {
  expect_error("numerics = { value = \"2 K\" }", "numerics.value");
  expect_error("numerics = { because = \"two meshes of it\" }", "numerics.because");
  expect_error("numerics = { value = \"2 K\", because = \"x\" }", "numerics.because", "\"x\"");
  const StudyFile study =
      study_of(critical_kind + "numerics = { value = \"2 K\", because = \"two meshes of it\" }\n");
  EXPECT_EQ(study.study.numerics.error, 2.0);
  EXPECT_EQ(study.study.numerics.because, "two meshes of it");
}

TEST(ReadStudy, ReasonsAreKeptByTheNamesOfWhatTheyAccept) {
  const StudyFile study = study_of(critical_kind +
                                   "[accept]\nshell-yields = \"the wall is tested to yield\"\n"
                                   "[accept.extrapolation]\ncalibre = \"a shell of one family\"\n");
  EXPECT_EQ(study.study.accepted_warnings.at("shell-yields"), "the wall is tested to yield");
  EXPECT_EQ(study.study.accepted_extrapolation.at("calibre"), "a shell of one family");
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
      {"scene_203mm.toml", "load.peak = \"496 MPa\"", "load.muzzle_exit"},
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

// The command model-form on calibrations and sweeps made by hand.
#include "launchsafe/study/model_form.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

class ModelFormProgram : public Program {
 protected:
  /// The folder of a model with its critical gaps (m) at 450, 500 and 550 MPa.
  void model(const std::string& name, std::vector<study::GapOrBound> gaps, double change = 0.5) {
    auto shipped = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
    ASSERT_TRUE(shipped);
    // Models of one launch, each another.
    if (name != "own") shipped->scene.surface.station_width = 1e-3 * static_cast<double>(5 + name.size());
    study::CalibrationRecord calibration;
    calibration.title = name;
    calibration.model_version = run::model_version;
    calibration.calibration.scene = shipped->scene;
    calibration.ignition_lowest = 518;
    calibration.ignition_highest = 521;
    calibration.held_out_misfit = 5;
    calibration.stations = {change, change};
    for (const char* part : {"calibration", "sweep"})
      std::filesystem::create_directories(folder() / name / part);
    write(name + "/calibration/calibration.json", study::to_json_text(calibration));
    write(name + "/sweep/critical_gaps.json",
          study::to_json_text(study::CriticalGapCurve{"the model " + name,
                                                      run::model_version,
                                                      shipped->scene,
                                                      {450e6, 500e6, 550e6},
                                                      std::move(gaps),
                                                      3e-3}));
  }
};

TEST_F(ModelFormProgram, ComparesModelsAndWritesTheRecord) {
  model("own", {5e-4, 4e-4, 3e-4});
  model("early", {5e-4, 3.5e-4, 1e-4});
  model("rough", {1e-4, 1e-4, 1e-4}, 9.0);
  const Outcome outcome = run({"model-form", "own", "early", "rough", "-o", "form", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = nlohmann::json::parse(outcome.out)["model_form"];
  ASSERT_EQ(rows.size(), 4u) << outcome.out;
  const auto record = study::parse_model_form(read("form/model_form.json"), "model_form.json");
  ASSERT_TRUE(record) << record.error().message();
  ASSERT_EQ(record->alternatives.size(), 2u);
  EXPECT_TRUE(record->alternatives[0].not_counted.empty());
  EXPECT_FALSE(record->alternatives[1].not_counted.empty());
  const std::string page = read("form/report.md");
  EXPECT_NE(page.find("towards ignition at 500, 550 MPa"), std::string::npos) << page;
  EXPECT_EQ(run({"model-form", "own", "early", "rough", "-o", "form"}).code, 0) << "again";
}

TEST_F(ModelFormProgram, RefusesEditedAndMissingFiles) {
  model("own", {5e-4, 4e-4, 3e-4});
  model("early", {5e-4, 3.5e-4, 1e-4});
  EXPECT_EQ(run({"model-form", "own", "nowhere", "-o", "form"}).code, 2);
  EXPECT_EQ(run({"model-form", "own", "-o", "form"}).code, 2);
  EXPECT_EQ(run({"model-form", "own", "own", "-o", "form"}).code, 2);
  const std::string curve = read("early/sweep/critical_gaps.json");
  write("early/sweep/critical_gaps.json", with(curve, "0.00035", "0.00045"));
  const Outcome edited = run({"model-form", "own", "early", "-o", "form"});
  EXPECT_EQ(edited.code, 2);
  EXPECT_TRUE(edited.says("digest")) << edited.err;
  EXPECT_FALSE(exists("form/model_form.json"));
}

TEST_F(ModelFormProgram, KeepsFilesOfSomebodyElse) {
  model("own", {5e-4, 4e-4, 3e-4});
  model("early", {5e-4, 3.5e-4, 1e-4});
  std::filesystem::create_directories(folder() / "form");
  write("form/report.md", "mine\n");
  EXPECT_EQ(run({"model-form", "own", "early", "-o", "form"}).code, 2);
  EXPECT_EQ(read("form/report.md"), "mine\n");
}

}  // namespace
}  // namespace launchsafe::app

// Accuracy records made by one study and used, or not, by the next.
#include "launchsafe/run/case_result.hpp"
#include "program.hpp"

#include <vector>

namespace launchsafe::app {
namespace {

const std::string early = "early_time = \"0.03 ms\"\n";
const std::string meshes = early + "reference_cell_sizes = \"1.25, 2.5, 5 mm\"\n";

class AccuracyRecordProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", tiny_scene);
  }
  /// The record of an accuracy study with some more keys, in its folder `name`.
  std::string record(const std::string& name, const std::string& keys) {
    write(name + ".toml", "kind = \"accuracy\"\nscene = \"shell.toml\"\n" + meshes + keys);
    const Outcome outcome = run({"study", name + ".toml", "-o", name, "--quiet"});
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << outcome.err;
    return read(name + "/accuracy.json");
  }
  Outcome use(const std::string& keys, const std::vector<std::string>& more = {}) {
    write("gaps.toml",
          "kind = \"critical-gap\"\nscene = \"shell.toml\"\nconfirm = false\ninput_uncertainty = { value = "
          "\"2 K\", because = \"for a test\" }\nmodel_form_uncertainty = { value = \"1 K\", because = \"for "
          "a test\" }\n" +
              early + keys);
    std::vector<std::string> arguments{"study", "gaps.toml", "-o", "used", "--update"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

const std::string scaled = "[set]\nnumerics.inertial_scaling = 1.2\n";

TEST_F(AccuracyRecordProgram, HelpsWithTheSettingsThatItVaried) {
  ASSERT_FALSE(record("accuracy", "[[settings]]\nnumerics.inertial_scaling = [1.2]\n").empty());
  const std::string key = "accuracy = \"accuracy/accuracy.json\"\n";
  for (const std::string& set : {std::string{}, scaled}) {
    const Outcome own = use(key + set);
    EXPECT_TRUE(own.code == 0 || own.code == 4) << own.err;
    EXPECT_NE(read("used/report.md").find("from the accuracy record"), std::string::npos) << set;
  }
  use(key + "[set]\nnumerics.inertial_scaling = 1.1\n");
  EXPECT_NE(read("used/report.md").find("it does not have these settings"), std::string::npos);
  use(key + "[set]\nstation.depth = \"0.8 cm\"\n");  // issue 31, point 6
  EXPECT_NE(read("used/report.md").find("another shell or model (station.depth)"), std::string::npos);
  use(key + "[[vary]]\nkey = \"peak_pressure\"\nvalues = \"100 MPa\"\n");
  EXPECT_NE(read("used/report.md").find("more than 1.25 times that"), std::string::npos);
  const Outcome chosen = use(key, {"--tolerance", "500 K"});
  EXPECT_TRUE(chosen.says("setting: ")) << chosen.err;
}

TEST_F(AccuracyRecordProgram, SaysNothingOfAScalingThatAllItsRunsShare) {
  ASSERT_FALSE(record("accuracy", scaled).empty());
  EXPECT_NE(read("accuracy/report.md").find("all reference meshes have numerics.inertial_scaling = 1.2"),
            std::string::npos);
  use("accuracy = \"accuracy/accuracy.json\"\n" + scaled);
  EXPECT_NE(read("used/report.md").find("does not help: all its reference meshes have"), std::string::npos);
  const Outcome chosen = use("accuracy = \"accuracy/accuracy.json\"\n", {"--tolerance", "500 K"});
  EXPECT_EQ(chosen.code, 2);
}

TEST_F(AccuracyRecordProgram, IsRefusedOnceItWasEdited) {
  const std::string made = record("accuracy", "");
  struct Edit {
    std::string from, to;
    std::vector<std::string> says;
  };
  const std::vector<Edit> edits{
      {"accuracy record 3", "accuracy record 2", {"format", "anew"}},
      {"\"model_version\": " + std::to_string(run::model_version),
       "\"model_version\": 4294967297",
       {"model_version", "4294967297"}},
      {"load.peak = \\\"5", "load.peak = \\\"9", {"digest", "edited"}},
      {"\"temperature_bound_K\": ", "\"temperature_bound_K\": 0.0, \"x\": ", {"settings.0.x"}},
      {"\"temperature_bound_K\": ", "\"temperature_bound_K\": 0.0, \"temperature_bound_K\": ", {"twice"}},
      {"\"frame\":", "\"load.peak\": 1000000.0, \"frame\":", {"settings.0.setting.load.peak"}},
      {"{", "", {"no JSON"}}};
  for (const Edit& edit : edits) {
    write("edited.json", with(made, edit.from, edit.to));
    const Outcome outcome = use("accuracy = \"edited.json\"\n", {"--tolerance", "500 K"});
    EXPECT_EQ(outcome.code, 2) << edit.to;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.says("edited.json")) << outcome.err;
    for (const std::string& part : edit.says)
      EXPECT_TRUE(outcome.says(part)) << part << " in " << outcome.err;
  }
  EXPECT_FALSE(exists("used"));
}

}  // namespace
}  // namespace launchsafe::app

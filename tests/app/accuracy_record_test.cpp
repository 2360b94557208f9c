// Accuracy records made by one study and used, or not, by the next.
#include "program.hpp"

#include <nlohmann/json.hpp>

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
          "\"2 K\", because = \"for a test\" }\n" +
              early + keys);
    std::vector<std::string> arguments{"study", "gaps.toml", "-o", "used", "--update"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(AccuracyRecordProgram, HelpsWithTheSettingsThatItVaried) {
  ASSERT_FALSE(record("accuracy", "[[settings]]\nnumerics.inertial_scaling = [1.2]\n").empty());
  const std::string key = "accuracy = \"accuracy/accuracy.json\"\n";
  const auto has_uncertainty = [&](const std::string& more) {
    use(key + more);
    return nlohmann::json::parse(read("used/study.json"))["cases"][0]["recorded_uncertainty_K"].is_number();
  };
  EXPECT_TRUE(has_uncertainty(""));
  EXPECT_TRUE(has_uncertainty("[set]\nnumerics.inertial_scaling = 1.2\n"));
  EXPECT_FALSE(has_uncertainty("[set]\nnumerics.inertial_scaling = 1.1\n"));
  EXPECT_FALSE(has_uncertainty("[set]\nstation.depth = \"0.8 cm\"\n"));  // issue 31, point 6
  // More than 1.25 times the pressure of the record.
  EXPECT_FALSE(has_uncertainty("[[vary]]\nkey = \"peak_pressure\"\nvalues = \"100 MPa\"\n"));
  const Outcome chosen = use(key, {"--tolerance", "500 K"});
  EXPECT_TRUE(chosen.code == 0 || chosen.code == 4) << chosen.err;
}

}  // namespace
}  // namespace launchsafe::app

// A case that fails is its row: the others are not affected, and what would fail again is not tried again.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class FailingCase : public StoredStudy {
 protected:
  /// Keys that vary, and their values in TOML.
  void write_study(const std::vector<std::pair<std::string, std::string>>& varied) const {
    std::string text;
    for (const auto& [key, values] : varied)
      text += "[[vary]]\nkey = \"" + key + "\"\nvalues = " + values + "\n";
    write("study.toml",
          "kind = \"critical-gap\"\nconfirm = false\ngaps = \"0, 0.01 cm\"\nlargest_gap = \"1 cm\"\nscene = "
          "\"shell.toml\"\naccept = "
          "[{ key = \"numerics.energy_drift_limit\", "
          "value = \"1e-6\", because = \"the base is loaded by a shock\" }]\nmodel_form_uncertainty = { "
          "value = \"1 K\", "
          "because = \"for a test\" }\nearly_time = "
          "\"0.03 ms\"\ninput_uncertainty = { value = \"2 K\", because = \"for a test\" }\n" +
              text);
  }
  /// The study's cases, each with its verdicts, by what is printed as JSON.
  nlohmann::json cases_of(const Outcome& outcome) const {
    const auto object = nlohmann::json::parse(outcome.out);
    nlohmann::json cases = object["cases"];
    const std::size_t gaps = object["verdicts"].size() / cases.size();
    for (std::size_t i = 0; i < object["verdicts"].size(); ++i)
      cases[i / gaps]["verdicts"].push_back(object["verdicts"][i]);
    return cases;
  }
};

TEST_F(FailingCase, ADriftOfEnergyIsItsRowAndIsNotComputedAgain) {
  write_study({{"peak_pressure", "\"250, 260 MPa\""}, {"numerics.energy_drift_limit", "[1e-10, 0.5]"}});
  const Outcome first = run({"study", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(first.code, 3);
  EXPECT_TRUE(first.says("peak_pressure 250 MPa, numerics.energy_drift_limit 1e-10: energy drift: "))
      << first.err;
  const auto cases = cases_of(first);
  ASSERT_EQ(cases.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string text = cases[i].dump();
    EXPECT_EQ(text.find("energy drift: ") != std::string::npos, i % 2 == 0) << text;
    EXPECT_EQ(text.find("\"SAFE\"") == std::string::npos, i % 2 == 0) << text;
    EXPECT_EQ(text.find("\"INDETERMINATE\"") != std::string::npos, i % 2 == 0) << text;
  }
  const Outcome again = run({"study", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(again.code, 3);
  EXPECT_TRUE(again.says("re-used 4 mechanical runs, ran 0")) << again.err;
  EXPECT_TRUE(again.says("energy drift: ")) << again.err;
  EXPECT_EQ(cases_of(again), cases);
}

TEST_F(FailingCase, ARunawayIsGivenUpAndTriedAgainWithMoreTimeOnly) {
  // Half of the cases in a time that is enough for each, then the others in one that is enough for none.
  const auto shard = [this](const std::string& part, const std::string& output, const std::string& limit) {
    return run({"study", "study.toml", "-o", output, "--time-limit", limit, "--shard", part}).code;
  };
  const std::string enough = "1h", none = "1e-9s";
  write_study({{"load.duration", "\"0.15, 0.151, 0.152, 0.153, 0.154, 0.155, 0.156, 0.157 ms\""}});
  EXPECT_EQ(shard("1/2", "out", enough), 0);
  const Outcome first = run({"study", "study.toml", "-o", "out", "--time-limit", none});
  EXPECT_EQ(first.code, 3);
  EXPECT_TRUE(first.says(": timed out")) << first.err;
  EXPECT_EQ(done_cases("out").size(), 4u);
  const Outcome again = run({"study", "study.toml", "-o", "out", "--time-limit", none});
  EXPECT_EQ(again.code, 3);
  EXPECT_TRUE(again.says("ran 0")) << again.err;
  EXPECT_TRUE(again.says(": timed out")) << again.err;
  // A shard that gave a case up has a row for it too.
  EXPECT_EQ(shard("1/2", "shard-1", enough), 0);
  EXPECT_EQ(shard("2/2", "shard-2", none), 3);
  EXPECT_EQ(run({"merge", "study.toml", "-o", "merged", "shard-1", "shard-2"}).code, 3);
  expect_same_results("out", "merged");
  const Outcome longer = run({"study", "study.toml", "-o", "out", "--time-limit", enough});
  EXPECT_TRUE(longer.says("re-used 4 mechanical runs, ran 4 ")) << longer.err;
  EXPECT_EQ(done_cases("out").size(), 8u);
}

TEST_F(FailingCase, TwentyAreNamedAndTheRestCounted) {
  std::string pressures = "50";
  for (int i = 51; i < 75; ++i) pressures += ", " + std::to_string(i);
  write_study({{"peak_pressure", "\"" + pressures + " MPa\""}});
  const Outcome outcome = run({"study", "study.toml", "-o", "out", "--memory", "1B", "--quiet"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.lines_of_error(), 21) << outcome.err;
  EXPECT_TRUE(outcome.says("and 5 more cases failed")) << outcome.err;
}

TEST_F(FailingCase, AFormerWordIsNotedAndComputesTheSame) {
  write_study({{"peak_pressure", "\"50 MPa\""}});
  write("study.toml", read("study.toml") + "[set]\nfriction.closure = \"literal\"\n");
  const Outcome former = run({"study", "study.toml", "-o", "out"});
  EXPECT_TRUE(former.says("study.toml:14: friction.closure: \"literal\" is now called \"total strain rate\""))
      << former.err;
  write("study.toml", [&] {
    std::string text = read("study.toml");
    return text.replace(text.find("literal"), 7, "total strain rate");
  }());
  const Outcome present = run({"study", "study.toml", "-o", "out", "--update"});
  EXPECT_FALSE(present.says("is now called")) << present.err;
  EXPECT_TRUE(present.says("re-used 1 mechanical run, ran 0")) << present.err;
}

}  // namespace
}  // namespace launchsafe::app

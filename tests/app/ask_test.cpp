// launchsafe ask: predictions from the fit of a study, which are no verdicts.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

/// 46 launches of milliseconds.
const std::string fitted_study = R"(kind = "sensitivity"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0.01 cm"
method = "polynomial-chaos"
design = "scrambled-sobol"
samples = 16
held_out = 30
resamples = 100

[[vary]]
key = "peak_pressure"
distribution = "uniform"
range = "250 to 280 MPa"

[[vary]]
key = "initial_temperature"
distribution = "uniform"
range = "290 to 310 K"
)";

class Ask : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    write("fitted.toml", fitted_study);
    const Outcome outcome = run({"study", "fitted.toml", "-o", "fit", "-q"});
    ASSERT_NE(outcome.code, 2) << outcome.err;
    ASSERT_TRUE(exists("fit/surrogate.json")) << outcome.err;
  }
};

// The computation of the same launch is the judge.
TEST_F(Ask, PredictsTheLaunchThatAStudyComputes) {
  const Outcome outcome =
      run({"ask", "fit", "--set", "peak_pressure=262 MPa", "--set", "initial_temperature=304 K", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  write("same.toml",
        "initial_temperature = \"304 K\"\n" + with(read("shell.toml"), "\"250 MPa\"", "\"262 MPa\""));
  const Outcome computed = run({"run", "same.toml", "--json", "-q"});
  ASSERT_EQ(computed.code, 0) << computed.err;
  const auto gaps = nlohmann::json::parse(computed.out)["gaps"];
  const auto predicted = nlohmann::json::parse(outcome.out)["launches"][0];
  EXPECT_GT(predicted["temperature_max_error_K"], 0.0);
  EXPECT_NEAR(predicted["temperature_max_K"].get<double>(),
              gaps[1]["maximum"]["temperature_max_K"].get<double>(),
              predicted["temperature_max_error_K"].get<double>());
}

TEST_F(Ask, NeverSaysSafeAndSaysThatNothingWasComputed) {
  EXPECT_EQ(run({"ask", "fit", "--gap", "0"}).code, 2);
  const Outcome outcome = run({"ask", "fit"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("SAFE\n"), std::string::npos);
  EXPECT_EQ(outcome.out.find(": SAFE"), std::string::npos);
  EXPECT_NE(outcome.out.find("only a launch that was computed can be SAFE"), std::string::npos)
      << outcome.out;
}

TEST_F(Ask, ListsMakeARowOfEveryCombinationThatSaysWhatTheLaunchAloneSays) {
  const std::vector<std::string> command{
      "ask", "fit", "--set", "peak_pressure=255, 262, 275 MPa", "--set", "initial_temperature=304, 309 K"};
  auto for_programs = command;
  for_programs.insert(for_programs.end(), {"--json", "-q"});
  const Outcome outcome = run(for_programs);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = nlohmann::json::parse(outcome.out)["launches"];
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[2]["peak_pressure_MPa"], 262.0);
  EXPECT_EQ(rows[2]["initial_temperature_K"], 304.0);
  const Outcome alone = run(
      {"ask", "fit", "--set", "peak_pressure=262 MPa", "--set", "initial_temperature=304 K", "--json", "-q"});
  EXPECT_EQ(rows[2]["temperature_max_K"],
            nlohmann::json::parse(alone.out)["launches"][0]["temperature_max_K"]);
  auto as_csv = command;
  as_csv.push_back("--csv");
  const Outcome csv = run(as_csv);
  EXPECT_TRUE(csv.out.starts_with("peak_pressure_MPa,initial_temperature_K,temperature_max_K,")) << csv.out;
  EXPECT_NE(run(command).out.find("only a launch that was computed can be SAFE"), std::string::npos);
  EXPECT_EQ(run({"ask", "fit", "--csv", "--gap", "0.1 mm"}).code, 2);
  EXPECT_NE(run({"ask", "fit", "--set", "peak_pressure=255, 262 MPa", "--gap", "0.1 mm"})
                .err.find("--gap: found 2 launches; allowed: one launch"),
            std::string::npos);
}

// What lies within is answered as it is alone; nothing but that it is refused is said of what lies outside.
TEST_F(Ask, AListIsAnsweredWhereItMayBeAndSaysWhereNot) {
  const std::string set = "peak_pressure=262, 281 MPa";
  const Outcome outcome = run({"ask", "fit", "--set", set, "--json", "-q"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = nlohmann::json::parse(outcome.out)["launches"];
  ASSERT_EQ(rows.size(), 2u);
  const Outcome alone = run({"ask", "fit", "--set", "peak_pressure=262 MPa", "--json", "-q"});
  EXPECT_EQ(rows[0]["temperature_max_K"],
            nlohmann::json::parse(alone.out)["launches"][0]["temperature_max_K"]);
  EXPECT_EQ(rows[0]["reason"], "");
  EXPECT_TRUE(rows[1]["temperature_max_K"].is_null());
  const std::string refused =
      "load.peak: found 281 MPa; allowed: 250 MPa to 280 MPa, where launches were computed";
  EXPECT_EQ(rows[1]["reason"], refused);
  for (const char* form : {"--csv", "-q"})
    EXPECT_NE(run({"ask", "fit", "--set", set, form}).out.find(refused), std::string::npos) << form;
  const Outcome none = run({"ask", "fit", "--set", "peak_pressure=281, 290 MPa"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.out, "");
  EXPECT_NE(none.err.find(refused), std::string::npos) << none.err;
}

// All critical gaps of the fit are bounds, and what is asked of a gap has no answer.
TEST_F(Ask, AGapIsRefusedWithTheReasonWhereNoCriticalGapIsPredicted) {
  const std::string reason =
      "46 of 46 critical gaps are bounds, not numbers (the first without a number: no ignition up to 0.1 cm";
  const Outcome of_gap = run({"ask", "fit", "--gap", "0.05 mm"});
  EXPECT_EQ(of_gap.code, 2);
  EXPECT_EQ(of_gap.out, "");
  EXPECT_NE(of_gap.err.find(reason), std::string::npos) << of_gap.err;
  const Outcome of_temperature = run({"ask", "fit"});
  EXPECT_EQ(of_temperature.code, 0) << of_temperature.err;
  EXPECT_NE(of_temperature.out.find("critical gap: not predicted, " + reason), std::string::npos)
      << of_temperature.out;
}

// Below and above all critical gaps; draws that are not covered may do either, and so may the interval.
TEST_F(Ask, TellsOfAGapAndOfTheDrawsOverWhatIsNotSet) {
  write("igniting.toml", with(fitted_study, "[[vary]]", R"(accept = [
  { key = "kinetics.ignition_temperature", value = "350 K", because = "the charge ignites in so brief a launch" },
  { key = "gap.exchange_time", value = "20 us", because = "the launch is as much faster" },
]
set = { kinetics.ignition_temperature = "350 K", gap.exchange_time = "20 us" }

[[vary]])"));
  ASSERT_NE(run({"study", "igniting.toml", "-o", "igniting", "-q"}).code, 2);
  const auto told = [&](const char* gap, const char* word) {
    const Outcome outcome = run({"ask", "igniting", "--gap", gap, "--json", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto facts = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(facts["gap"], word);
    return facts["ignitions"];
  };
  const auto small = told("0.001 mm", "predicted: no ignition");
  EXPECT_GT(small["uncovered"], 0);
  EXPECT_EQ(small["at_least"], 0);
  EXPECT_EQ(small["at_most"], small["uncovered"]);
  const auto large = told("0.9 mm", "predicted: ignition");
  EXPECT_EQ(large["at_least"].get<int>(), large["draws"].get<int>() - large["uncovered"].get<int>());
  EXPECT_EQ(large["at_most"], large["draws"]);
  EXPECT_EQ(run({"ask", "igniting", "--gap", "0.9 mm"}).out.find(": SAFE"), std::string::npos);
}

TEST_F(Ask, RefusesWhatWasNotComputed) {
  const auto fault_of = [&](const std::string& given) {
    const Outcome outcome = run({"ask", "fit", "--set", given});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_NE(fault_of("load.peak=281 MPa").find("250 MPa to 280 MPa, where launches were computed"),
            std::string::npos);
  EXPECT_NE(fault_of("load.peek=260 MPa").find("did you mean load.peak?"), std::string::npos);
  EXPECT_NE(fault_of("peak=260 MPa").find("did you mean load.peak?"), std::string::npos);
  EXPECT_NE(fault_of("crack_radius=30 um").find("which the study does not vary"), std::string::npos);
  EXPECT_NE(fault_of("load.peak=260").find("without a unit"), std::string::npos);
  EXPECT_NE(fault_of("load.peak").find("no ="), std::string::npos);
  EXPECT_NE(run({"ask", "fit", "--set", "load.peak=260 MPa", "--set", "peak_pressure=261 MPa"})
                .err.find("a second time"),
            std::string::npos);
  EXPECT_NE(run({"ask", "."}).err.find("no such file"), std::string::npos);
  EXPECT_EQ(run({"ask", "fit", "--set", " load.peak = 260 MPa"}).code, 0);
  EXPECT_EQ(run({"ask", "fit", "--gap", "10 m"}).code, 2);
  // A corner of the ranges, at 10 and 8 tenths of them.
  const Outcome corner =
      run({"ask", "fit", "--set", "load.peak=280 MPa", "--set", "initial_temperature=308 K"});
  EXPECT_EQ(corner.code, 2);
  EXPECT_NE(corner.err.find("most of all by load.peak;"), std::string::npos) << corner.err;
}

// Beyond all that a normal input was drawn at its probability is 0 or 1, which has no score.
TEST_F(Ask, RefusesWhatLiesBeyondANormalInput) {
  const Outcome outcome =
      run({"ask", LAUNCHSAFE_SOURCE_DIR "/reports/sensitivity", "--set", "load.peak=460 MPa"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("load.peak: found 460 MPa; allowed: 472.786 MPa to 525.504 MPa"),
            std::string::npos)
      << outcome.err;
}

TEST_F(Ask, RefusesAnEditedFit) {
  std::string text = read("fit/surrogate.json");
  const std::size_t place = text.find("\"coefficient\": ");
  ASSERT_NE(place, std::string::npos);
  write("fit/surrogate.json", text.replace(place, 15, "\"coefficient\": 1"));
  const Outcome outcome = run({"ask", "fit"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("was edited"), std::string::npos) << outcome.err;
}

/// 9 launches of milliseconds; the exchange time is no matter of the mechanics.
const std::string fitted_sweep = R"(kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01 cm"
surrogate = true
input_uncertainty = { value = "2 K", because = "for a test" }
model_form_uncertainty = { value = "1 K", because = "for a test" }
accept = [ { key = "gap.exchange_time", value = "20 to 40 us", because = "the launch is as much faster" } ]

[[vary]]
key = "peak_pressure"
range = "250 to 282 MPa"
count = 9

[[vary]]
key = "gap.exchange_time"
range = "20 to 40 us"
count = 8
)";

// The case of the sweep with those values is the judge. Ranges of a sweep are no distributions: nothing is
// drawn from them. The sweep was finished before somebody asked for its fit.
TEST_F(StoredStudy, AFinishedSweepIsFittedWithoutALaunchAndAskedBetweenItsCases) {
  write("sweep.toml", with(fitted_sweep, "surrogate = true\n", ""));
  ASSERT_NE(run({"study", "sweep.toml", "-o", "sweep", "-q"}).code, 2);
  EXPECT_FALSE(exists("sweep/surrogate.json"));
  write("sweep.toml", fitted_sweep);
  const Outcome study = run({"study", "sweep.toml", "-o", "sweep", "--update"});
  ASSERT_NE(study.code, 2) << study.err;
  EXPECT_NE(study.err.find("re-used 9 mechanical runs, ran 0"), std::string::npos) << study.err;
  ASSERT_TRUE(exists("sweep/surrogate.json")) << study.err;
  const auto report = nlohmann::json::parse(read("sweep/study.json"));
  ASSERT_EQ(report["surrogate"].size(), 3u);
  EXPECT_EQ(report["surrogate"][0]["held_out"], 30);
  const Outcome outcome = run({"ask", "sweep", "--set", "gap.exchange_time=33 us", "--json", "-q"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("ignitions"), std::string::npos) << outcome.out;
  const Outcome at_case = run(
      {"ask", "sweep", "--set", "peak_pressure=258 MPa", "--set", "gap.exchange_time=40 us", "--json", "-q"});
  ASSERT_EQ(at_case.code, 0) << at_case.err;
  const auto predicted = nlohmann::json::parse(at_case.out)["launches"][0];
  const auto verdicts = report["verdicts"];
  const auto found = std::find_if(verdicts.begin(), verdicts.end(), [](const auto& row) {
    return row["gap_cm"] == 0.0 && row["peak_pressure_MPa"] == 258.0 && row["gap_exchange_time_us"] == 40.0;
  });
  ASSERT_NE(found, verdicts.end()) << verdicts[0];
  EXPECT_NEAR(predicted["temperature_max_0cm_K"].get<double>(), (*found)["temperature_max_K"].get<double>(),
              predicted["temperature_max_0cm_error_K"].get<double>());
  EXPECT_EQ(run({"ask", "sweep", "--set", "peak_pressure=283 MPa"}).code, 2);
  EXPECT_EQ(run({"ask", "sweep", "--set", "crack_radius=30 um"}).code, 2);
  const std::string page = read("sweep/ask.html");
  EXPECT_EQ(page.find("SAFE"), std::string::npos);
  EXPECT_NE(page.find("predicted: no ignition"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::app

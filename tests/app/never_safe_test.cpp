// Mistaken inputs, one change each to a study that is SAFE: none of them may stay SAFE. The control comes
// first.
#include "program.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::app {
namespace {

/// A small shell under the load of a gun, on cells so coarse that its launch takes a tenth of a second.
const std::string sound_scene = R"(title = "a small shell"
accept = [{ key = "calibration", because = "this is a test of the program" }]

[load]
peak = "496 MPa"

[gap]
thickness = "0, 0.01 cm"

[numerics]
cell_size = "5 mm"
)" + testing::small_shell + testing::small_shell_base +
                                testing::small_shell_point;

const std::string sound_study = R"(kind = "critical-gap"
scene = "shell.toml"
largest_gap = "0.02 cm"
confirm = false
numerical_uncertainty = "5 K"
fit_uncertainty = "3 K"
input_uncertainty = "5 K"
)";

/// A pulse as a gun makes it, in ms and MPa.
const std::string sound_curve =
    "time_ms,pressure_MPa\n0,0.1\n3,5\n5,60\n7,240\n9,430\n11,496\n13,430\n15,270\n17,120\n18,70\n";

struct Edit {
  std::string file, from, to;
};

/// One mistake, and a word of the reason that verdicts give for it; `refused` where nothing is computed.
struct Mistake {
  std::string name;
  std::vector<Edit> edits;
  std::string says;
  bool refused = false;
};

/// The scene with a measured curve, and a change of either.
std::vector<Edit> with_curve(const std::string& curve, const std::string& load = "") {
  return {{"shell.toml", "peak = \"496 MPa\"", "curve = \"pressure.csv\"\n" + load},
          {"pressure.csv", "", curve}};
}

std::vector<Edit> in_scene(std::string from, std::string to) {
  return {{"shell.toml", std::move(from), std::move(to)}};
}
std::vector<Edit> in_load(const std::string& line) { return in_scene("[load]\n", "[load]\n" + line + "\n"); }
std::vector<Edit> in_study(std::string from, std::string to) {
  return {{"study.toml", std::move(from), std::move(to)}};
}

class NeverSafe : public Program, public ::testing::WithParamInterface<Mistake> {
 protected:
  void write_sound() const {
    write("shell.toml", sound_scene);
    write("study.toml", sound_study);
    write("pressure.csv", sound_curve);
  }
  void apply(const std::vector<Edit>& edits) const {
    for (const Edit& edit : edits)
      write(edit.file, edit.from.empty() ? edit.to : with(read(edit.file), edit.from, edit.to));
  }
  int verdicts(const std::string& verdict) const {
    const std::string table = read("out/verdicts.csv"), wanted = "," + verdict + ",";
    int count = 0;
    for (std::size_t at = table.find(wanted); at != std::string::npos; at = table.find(wanted, at + 1))
      ++count;
    return count;
  }
};

TEST_F(NeverSafe, TheUnchangedStudyIsSafe) {
  write_sound();
  const Outcome outcome = run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(verdicts("SAFE"), 2) << outcome.out;
}

TEST_F(NeverSafe, AMeasuredCurveThatIsSimulatedWholeIsSafe) {
  write_sound();
  apply(with_curve(sound_curve));
  const Outcome outcome = run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(verdicts("SAFE"), 2) << outcome.out;
}

TEST_P(NeverSafe, Mistaken) {
  const Mistake& mistake = GetParam();
  write_sound();
  apply(mistake.edits);
  const Outcome outcome = run({"study", "study.toml", "-o", "out"});
  if (mistake.refused) {
    EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
    EXPECT_TRUE(outcome.says(mistake.says)) << outcome.err;
    EXPECT_FALSE(exists("out"));
    return;
  }
  EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
  EXPECT_EQ(verdicts("SAFE"), 0) << outcome.out;
  EXPECT_EQ(verdicts("INDETERMINATE"), 2) << outcome.out;
  EXPECT_NE(read("out/verdicts.csv").find(mistake.says), std::string::npos) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(
    LaunchNotSimulated, NeverSafe,
    ::testing::Values(
        Mistake{"QuietBeforeThePulse", with_curve("time_ms,pressure_MPa\n0,0\n20,0\n24,60\n30,496\n36,70\n"),
                "not covered"},
        Mistake{"CutBeforeThePeak", with_curve("time_ms,pressure_MPa\n0,0.1\n5,60\n9,200\n18,480\n"),
                "cut off"},
        Mistake{"ACurveThatGoesOn", with_curve(sound_curve + "25,40\n"), "after the end of the simulation"},
        Mistake{"ASecondHumpAfterTheEnd", with_curve(sound_curve + "25,480\n30,20\n"), "after the end"},
        Mistake{"DelayedAndRescaled",
                with_curve("time_ms,pressure_MPa\n0,0\n20,0\n24,60\n30,300\n36,70\n",
                           "peak = \"496 MPa\"\nrescale_to_peak = true\n"),
                "not covered"},
        Mistake{"ThePeakAfterTheEnd", in_load("peak_time = \"40 ms\""), "not covered"},
        Mistake{"ShorterThanTheRise", in_load("duration = \"8 ms\""), "not covered"},
        Mistake{"EndsAtThePeak", in_load("peak_time = \"18 ms\""), "cut off"},
        Mistake{"BeginsUnderLoad", with_curve("time_ms,pressure_MPa\n0,150\n5,300\n11,496\n18,70\n"),
                "begins with"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(CalibrationElsewhere, NeverSafe,
                         ::testing::Values(Mistake{
                             "AnotherShell",
                             in_scene("accept = [{ key = \"calibration\", because = \"this is a test of the "
                                      "program\" }]\n",
                                      ""),
                             "another shell"}),
                         [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(UncertaintyUnstated, NeverSafe,
                         ::testing::Values(
                             // T1 a hundred kelvin above the skin: a margin that stated uncertainties leave,
                             // and assumed ones do not.
                             Mistake{"OfTheMesh",
                                     {{"study.toml", "numerical_uncertainty = \"5 K\"\n", ""},
                                      {"shell.toml", "[gap]",
                                       "[kinetics]\nignition_temperature = \"385 K\"\n\n[gap]"}},
                                     "within the uncertainty"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace launchsafe::app

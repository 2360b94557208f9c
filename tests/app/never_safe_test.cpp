// Mistaken inputs, one change each to a study that is SAFE: none of them may stay SAFE. They are examples, by
// the program, of what validity_warnings_test.cpp, the two plausibility_test.cpp and
// calibration_domain_test.cpp list. The control comes first; what it ran is there when its user makes a
// mistake and runs it again.
#include "program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::app {
namespace {

/// The shipped scene on few cells with so much inertia that its launch takes a tenth of a second.
std::string sound_scene() {
  std::string text = shipped("scene_155mm.toml");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"cell_size = \"1.25 mm\"", "cell_size = \"2.5 mm\""},
           {"growth_x = 1.3 ", "growth_x = 1.5 "},
           {"[load]\n",
            "[load]\nshape = \"bell\"\npeak_time = \"11.49 ms\"\nwidth = \"3.03 ms\"\nsteepness = 1.44\n"},
           {"time_step_factor", "inertial_scaling = 16\ntime_step_factor"},
           {"\"0, 0.01, 0.02, 0.03, 0.039, 0.04 cm\"", "\"0, 0.005 cm\"\nskin_thickness = \"0.1 mm\""}})
    text = with(text, from, to);
  // Constants as they are, to be mistaken.
  return text +
         "[kinetics]\nburnt_temperature = \"784 K\"\n[station]\nwidth = \"5 mm\"\ndepth = \"5 mm\"\n"
         "[friction]\nclosure = \"total strain rate\"\n";
}

const std::string sound_study = R"(kind = "critical-gap"
scene = "shell.toml"
confirm = false
numerical_uncertainty = { value = "5 K", because = "for a test" }
fit_uncertainty = { value = "3 K", because = "for a test" }
input_uncertainty = { value = "5 K", because = "for a test" }
)";

/// A pulse as a gun makes it, in ms and MPa.
const std::string sound_curve =
    // Points beside the peak show that nothing was missed between coarse ones.
    "time_ms,pressure_MPa\n0,0\n3,5\n5,40\n7,200\n9,400\n10.9,491.2\n11,496\n11.1,491.7\n13,410\n15,250\n16,"
    "170\n17,105\n18,60\n20,16\n23,2\n";

struct Edit {
  std::string file, from, to;
};

/// One mistake, and a word of the reason that verdicts give for it.
struct Mistake {
  std::string name;
  std::vector<Edit> edits;
  std::string says;
};

/// The scene with a measured curve.
std::vector<Edit> with_curve(const std::string& curve) {
  return {{"shell.toml", "peak = \"496 MPa\"", "curve = \"pressure.csv\"\n"}, {"pressure.csv", "", curve}};
}

/// A record that ends with a line of the sound curve, of a barrel of which nothing is said.
std::vector<Edit> truncated(const std::string& last) {
  std::vector<Edit> edits = with_curve(sound_curve.substr(0, sound_curve.find(last) + last.size()));
  edits.push_back({"shell.toml", "muzzle_exit = \"18 ms\"", ""});
  return edits;
}

std::vector<Edit> in_scene(std::string from, std::string to) {
  return {{"shell.toml", std::move(from), std::move(to)}};
}

std::vector<Edit> in_study(std::string from, std::string to) {
  return {{"study.toml", std::move(from), std::move(to)}};
}

std::string entry(const std::string& key, const std::string& value) {
  return "accept = [{ key = \"" + key + "\", value = \"" + value + "\", because = \"it is meant so\" }]\n";
}

/// An edit of the scene beside an acceptance.
std::vector<Edit> accepted(const std::string& key, const std::string& value, std::string from,
                           std::string to) {
  return {{"shell.toml", std::move(from), std::move(to)},
          {"shell.toml", "title =", entry(key, value) + "title ="}};
}

class NeverSafe : public Program, public ::testing::WithParamInterface<Mistake> {
 protected:
  void write_edited(const std::vector<Edit>& edits) const {
    write("shell.toml", sound_scene());
    write("study.toml", sound_study);
    write("pressure.csv", sound_curve);
    for (const Edit& edit : edits)
      write(edit.file, edit.from.empty() ? edit.to : with(read(edit.file), edit.from, edit.to));
  }
  /// Runs the edited study in the folder of the sound one, which ran once for all cases.
  Outcome run_edited(const std::vector<Edit>& edits) {
    static const testing::SharedFolder shared;
    const std::filesystem::path sound = shared.path / "out", out = folder() / "out";
    if (!std::filesystem::exists(sound)) {
      write_edited({});
      EXPECT_EQ(run({"study", "study.toml", "-o", sound.string()}).code, 0);
    }
    std::filesystem::remove_all(out);
    std::filesystem::copy(sound, out, std::filesystem::copy_options::recursive);
    write_edited(edits);
    return run({"study", "study.toml", "-o", "out", "--update"});
  }
  int verdicts(const std::string& verdict) const {
    const std::string table = read("out/verdicts.csv"), wanted = "," + verdict + ",";
    int count = 0;
    for (std::size_t at = table.find(wanted); at != std::string::npos; at = table.find(wanted, at + 1))
      ++count;
    return count;
  }
};

void expect_both_safe(const Outcome& outcome, int safe) {
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(safe, 2) << outcome.out;
}

TEST_F(NeverSafe, TheUnchangedStudyIsSafe) {
  const Outcome outcome = run_edited({});
  expect_both_safe(outcome, verdicts("SAFE"));
}

TEST_F(NeverSafe, AMeasuredCurveThatIsSimulatedWholeIsSafe) {
  const Outcome outcome = run_edited(with_curve(sound_curve));
  expect_both_safe(outcome, verdicts("SAFE"));
}

TEST_F(NeverSafe, ALoadThatTheRangeTableContradictsIsRefused) {
  const Outcome outcome =
      run_edited(in_scene("peak = \"496 MPa\"", "peak = \"248 MPa\"\nexpected_velocity = \"796 m/s\""));
  EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  EXPECT_TRUE(outcome.says("load.expected_velocity: found 796 m/s")) << outcome.err;
  EXPECT_TRUE(outcome.says("drives the projectile to 398")) << outcome.err;
}

/// The scene with a charge that decomposes a hundred times faster.
std::vector<Edit> with_hot_mix() {
  return {{"shell.toml", "material = \"charge\"", "material = \"hot-mix.toml\""},
          {"hot-mix.toml", "", with(shipped("materials/comp-b.toml"), "21700 K", "15000 K")}};
}

TEST_F(NeverSafe, AMaterialReactsByItsOwnKineticsWhichEveryPageHas) {
  run_edited(with_hot_mix());
  EXPECT_EQ(verdicts("SAFE"), 0);
  EXPECT_GT(verdicts("UNSAFE"), 0);
  using nlohmann::json;
  const json kinetics = json::parse(read("out/study.json"))["kinetics"];
  EXPECT_EQ(kinetics["activation_temperature_K"], 15000.0);
  EXPECT_EQ(kinetics["frequency_per_s"], 2.01e18);
  EXPECT_EQ(kinetics["heat_of_reaction_J_per_kg"], 5.82e6);
  EXPECT_EQ(kinetics["from"], "material \"hot-mix.toml\" (hot-mix.toml:1)");
  for (const char* command : {"explain", "run"})
    EXPECT_EQ(json::parse(run({command, "shell.toml", "--json"}).out)["kinetics"], kinetics) << command;
  EXPECT_EQ(json::parse(run({"explain", "study.toml", "--json"}).out)["kinetics"], kinetics);
  EXPECT_EQ(run({"report", "out", "-o", "page"}).code, 0);
  const std::string told = kinetics["text"];
  for (const std::string& page :
       {read("out/report.md"), read("page/report.md"), run({"explain", "shell.toml"}).out,
        run({"explain", "study.toml"}).out, run({"run", "shell.toml"}).out})
    EXPECT_NE(page.find(told), std::string::npos) << page;
}

TEST_F(NeverSafe, OtherKineticsBesideThoseOfAMaterialAreRefusedWithBothPlaces) {
  std::vector<Edit> edits = with_hot_mix();
  edits.push_back({"shell.toml", "[kinetics]\n", "[kinetics]\nactivation_temperature = \"21700 K\"\n"});
  const Outcome outcome = run_edited(edits);
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_TRUE(outcome.says("kinetics.activation_temperature: found")) << outcome.err;
  EXPECT_TRUE(outcome.says("shell.toml:")) << outcome.err;
  EXPECT_TRUE(outcome.says("hot-mix.toml:")) << outcome.err;
}

TEST_F(NeverSafe, AChargeThatNothingHoldsAtItsFrontIsRefused) {
  const Outcome outcome = run_edited(
      {{"shell.toml",
        "  { name = \"nose\",   material = \"steel\",  x = \"0 to 11.8 cm\",    r = \"0 to 7.75 cm\" },\n",
        ""}});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_TRUE(outcome.says("body.charge.x")) << outcome.err;
}

TEST_F(NeverSafe, TheAcceptanceOfAllAtOnceIsRefusedWithTheNewForm) {
  const Outcome outcome = run_edited(in_scene(
      "title =", "accept = [{ key = \"calibration\", because = \"everything is much alike\" }]\ntitle ="));
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_TRUE(outcome.says("accept = [{ key = \"calibration.shell\", value = ")) << outcome.err;
}

/// What nobody accepts makes nothing safe, and undoes no ignition.
TEST_F(NeverSafe, AGapThatIgnitesIsUnsafeWhereAnAcceptanceIsMissing) {
  run_edited({{"shell.toml", "width = \"5 mm\"", "width = \"7 mm\""},
              {"study.toml", "confirm = false", "confirm = false\ngaps = \"0, 0.09 cm\""}});
  EXPECT_EQ(verdicts("SAFE"), 0);
  EXPECT_EQ(verdicts("INDETERMINATE"), 1);
  EXPECT_EQ(verdicts("UNSAFE"), 1);
  EXPECT_NE(read("out/study.json").find("indeterminate (indicative: 0.0"), std::string::npos);
}

TEST_P(NeverSafe, Mistaken) {
  const Mistake& mistake = GetParam();
  const Outcome outcome = run_edited(mistake.edits);
  EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
  EXPECT_EQ(verdicts("SAFE"), 0) << outcome.out;
  EXPECT_EQ(verdicts("INDETERMINATE"), 2) << outcome.out;
  EXPECT_NE(read("out/verdicts.csv").find(mistake.says), std::string::npos) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(
    LaunchNotSimulated, NeverSafe,
    ::testing::Values(
        Mistake{"CutShortBefore15", in_scene("[load]", "[load]\nduration = \"14.7 ms\""), "cut short"},
        Mistake{"CutShortAt15", in_scene("[load]", "[load]\nduration = \"15 ms\""), "cut short"},
        Mistake{"TruncatedAt15", truncated("15,250\n"), "not over"},
        Mistake{"TruncatedAt17", truncated("17,105\n"), "not over"},
        Mistake{"TruncatedAt16", truncated("16,170\n"), "not over"},
        Mistake{"LeavesAt15", in_scene("\"18 ms\"", "\"15 ms\""), "load.exit_pressure"},
        Mistake{"LeavesWithinTenCalibresAccepted",
                {{"shell.toml", "title =",
                  "accept = [{ key = \"load.exit_calibres\", value = \"6 to 8\", because = \"a barrel of "
                  "one metre\" }, { key = "
                  "\"load.exit_pressure\", value = \"0.9 to 1\", because = \"a barrel of one metre\" "
                  "}]\ntitle ="},
                 {"shell.toml", "inertial_scaling = 16", "selective_inertia = 1"},
                 {"shell.toml", "\"18 ms\"", "\"12 ms\""}},
                "calibres of travel shows nothing"},
        Mistake{"LeavesAtHalfThePeak", in_scene("\"18 ms\"", "\"14 ms\""), "load.exit_pressure"}),
    [](const auto& test) { return test.param.name; });

/// Values that a scene may have and no launch has; what nothing can have is refused: plausibility_test.cpp.
INSTANTIATE_TEST_SUITE_P(
    Implausible, NeverSafe,
    ::testing::Values(
        Mistake{"MegapascalsLabelledKilopascal", with_curve(with(sound_curve, "MPa", "kPa")),
                "load.measured_peak"},
        // 496 MPa in another unit, and half of it: speeds of 80, 55, 116, 81 and 398 m/s.
        Mistake{"TenTimesTooSmall", in_scene("496 MPa", "49.6 MPa"), "load.launch_speed"},
        Mistake{"BarTypedAsPsi", in_scene("496 MPa", "4960 psi"), "load.launch_speed"},
        Mistake{"KsiTypedAsMegapascal", in_scene("496 MPa", "72 MPa"), "load.launch_speed"},
        Mistake{"KilogramsForceTypedAsMegapascal", in_scene("496 MPa", "50.6 MPa"), "load.launch_speed"},
        Mistake{"SwappedDigits", in_scene("496 MPa", "946 MPa"), "load.launch_speed"},
        Mistake{"NoLoad", with_curve("time_ms,pressure_MPa\n0,0\n9,0\n18,0\n"), "load.measured_peak"},
        Mistake{"LateIgnition", in_scene("[kinetics]\n", "[kinetics]\nignition_temperature = \"700 K\"\n"),
                "kinetics.ignition_temperature"},
        Mistake{"AnExactMesh",
                in_study("numerical_uncertainty = { value = \"5 K\"",
                         "numerical_uncertainty = { value = \"0 K\""),
                "numerical_uncertainty"}),
    [](const auto& test) { return test.param.name; });

/// The base of the sound scene drawn otherwise.
std::vector<Edit> drawn(const std::string& base, const std::string& more = "") {
  const std::string shipped = "x = \"67.8 to 74 cm\",   r = \"0 to 7.75 cm\" },\n";
  return {{"shell.toml", shipped, base + " },\n" + more}};
}

/// Drawings that would leave the charge unpushed: bodies behind a gap, and one that is in nobody's hands.
TEST_F(NeverSafe, GapsInTheDrawingAreRefused) {
  struct Drawing {
    std::string base, more, says;
  };
  const std::string ring =
      R"(  { name = "ring", material = "steel", x = "67.8 to 74 cm", r = "3.1 to 7.75 cm" },)";
  const std::string tail =
      R"(  { name = "tail", material = "steel", x = "71 to 74 cm", r = "0 to 7.75 cm" },)";
  for (const Drawing& each : {Drawing{R"(x = "67.84 to 74 cm", r = "0 to 7.75 cm")", "", "gap.thickness"},
                              {R"(x = "68.8 to 74 cm", r = "0 to 7.75 cm")", "", "gap.thickness"},
                              {R"(x = "67.8000001 to 74 cm", r = "0 to 7.75 cm")", "", "body.base.x"},
                              {R"(x = "67.8 to 74 cm", r = "0 to 3 cm")", ring, "gap.thickness"},
                              {R"(x = "67.8 to 70 cm", r = "0 to 7.75 cm")", tail, "body.tail.x"}}) {
    write_edited(drawn(each.base, each.more));
    const Outcome outcome = run({"study", "study.toml", "-o", "drawn"});
    EXPECT_EQ(outcome.code, 2) << each.base;
    EXPECT_TRUE(outcome.says(each.says)) << outcome.err;
  }
  write_edited(in_scene("x = \"11.8 to 67.8 cm\", r = \"6.5 to 7.75 cm\"",
                        "x = \"11.8 to 60 cm\", r = \"6.5 to 7.75 cm\""));
  EXPECT_TRUE(run({"study", "study.toml", "-o", "drawn"}).says("load.obturation"));
}

/// T max at 0.005 cm. A boom of 10 cm adds 1.5 % of mass, and so takes as much from the setback pressure;
/// heat goes with its power of 3.6 where the wall yields, so that 5 % of the rise of 140 K are lost, and
/// where the boom alone was pushed nearly all of it.
TEST_F(NeverSafe, ABoomTakesNothingFromTheLoadButItsMass) {
  const auto hottest = [this] {
    const std::string table = read("out/verdicts.csv");
    const std::string row = table.substr(table.find("\n0.005,"));
    return std::stod(row.substr(row.find(",1,") + 3));
  };
  run_edited({});
  const double without = hottest();
  const Outcome outcome =
      run_edited(drawn(R"(x = "67.8 to 74 cm", r = "0 to 7.75 cm")",
                       R"(  { name = "boom", material = "steel", x = "74 to 84 cm", r = "0 to 2 cm" },)"));
  EXPECT_LT(hottest(), without) << outcome.err;
  EXPECT_GT(hottest(), without - 8.0);
  EXPECT_NE(run({"explain", "shell.toml"}).out.find("100 % of pi R^2 p, up to x = 74 cm"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    CalibratedElsewhere, NeverSafe,
    ::testing::Values(
        Mistake{"AnotherShell",
                in_scene("x = \"0 to 11.8 cm\",    r = \"0 to 7.75 cm\"",
                         "x = \"1 to 11.8 cm\",    r = \"0 to 7.75 cm\""),
                "calibration.shell = 4 bodies"},
        Mistake{"AnotherShellThanTheAcceptedOne",
                accepted("calibration.shell", "4 bodies, 73 cm long, 15.5 cm in diameter, 00000000",
                         "x = \"0 to 11.8 cm\",    r = \"0 to 7.75 cm\"",
                         "x = \"1 to 11.8 cm\",    r = \"0 to 7.75 cm\""),
                "(accepted is 4 bodies"},
        Mistake{"WiderStationsUnderAnAcceptanceOfOthers",
                accepted("station.width", "6 mm", "width = \"5 mm\"", "width = \"7 mm\""),
                "station.width = 0.7 cm (accepted is 6 mm)"},
        Mistake{"WiderStationsUnderAnAcceptanceOfTheirDepth",
                accepted("station.depth", "7 mm", "width = \"5 mm\"", "width = \"7 mm\""),
                "station.width = 0.7 cm"},
        Mistake{"StationsOfOneCell", in_scene("cell_size = \"2.5 mm\"", "cell_size = \"3 mm\""),
                "two are needed"},
        Mistake{"DeepStationsThatAreAccepted",
                accepted("station.depth", "56 cm", "depth = \"5 mm\"", "depth = \"56 cm\""),
                "only averages or removes heat"},
        Mistake{"NoFrictionHeatThatIsAccepted",
                accepted("friction.closure", "none", "closure = \"total strain rate\"", "closure = \"none\""),
                "only averages or removes heat"},
        Mistake{"AThickSkinThatIsAccepted",
                accepted("gap.skin_thickness", "1 mm", "skin_thickness = \"0.1 mm\"",
                         "skin_thickness = \"1 mm\""),
                "only averages or removes heat"},
        Mistake{"LittleFrictionHeatThatIsAccepted",
                accepted("friction.localisation", "250", "[friction]\n", "[friction]\nlocalisation = 250\n"),
                "only averages or removes heat"},
        Mistake{"LittleSlidingFrictionThatIsAccepted",
                accepted("charge.sliding_friction", "0.035", "[charge]\n",
                         "[charge]\nsliding_friction = 0.035\n"),
                "only averages or removes heat"},
        Mistake{"ASecondSteel",
                {{"shell.toml", "{ name = \"base\",   material = \"steel\"",
                  "{ name = \"base\",   material = \"hard\""},
                 {"shell.toml", "[load]",
                  "[material.hard]\n" + with(shipped("materials/shell-steel.toml"), "792 MPa", "1.5 GPa") +
                      "[load]"}},
                "material.hard.yield_stress = 1.5 GPa"},
        Mistake{"ASlidingChargeOfTheStudyUnderAnAcceptanceOfAnother",
                {{"shell.toml", "title =", entry("calibration.interfaces", "bonded for good") + "title ="},
                 {"study.toml", "confirm = false",
                  "confirm = false\nset = { interface = { wall = { condition = \"sliding\", friction = 0.1 } "
                  "} }"}},
                "wall sliding, friction 0.1"},
        Mistake{"AnotherFrictionThanTheAcceptedOne",
                {{"shell.toml", "title =",
                  entry("calibration.interfaces", "nose sliding, friction 0; wall sliding, friction 0.1") +
                      "title ="},
                 {"study.toml", "confirm = false",
                  "confirm = false\nset = { interface = { wall = { friction = 0.2 } } }"}},
                "wall sliding, friction 0.2"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace launchsafe::app

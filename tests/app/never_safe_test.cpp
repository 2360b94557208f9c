// Mistaken inputs, one change each to a study that is SAFE: each is refused, or leaves no gap SAFE.
#include "computed_rows.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

using study::CaseRow, study::GapRow, study::ReasonCode, study::Verdict;

/// The shipped scene on few cells with so much inertia that its launch takes a tenth of a second. Nothing
/// says which velocity is expected.
std::string sound_scene() {
  std::string text = shipped("scene_155mm.toml");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"cell_size = \"1.25 mm\"", "cell_size = \"2.5 mm\""},
           {"growth_x = 1.3 ", "growth_x = 1.5 "},
           {"time_step_factor", "inertial_scaling = 16\ntime_step_factor"},
           {"expected_velocity", "# expected_velocity"}})
    text = with(text, from, to);
  return text;
}

/// One launch of its own for each case.
const std::string sound_study = R"(kind = "critical-gap"
scene = "shell.toml"
constants = "155mm_coarse"
gaps = "0, 0.005 cm"
numerics = { value = "5 K", because = "for a test" }
uncertainty.peak_pressure = "0 %"
)";

/// A pulse as a gun makes it, in ms and MPa.
const std::string sound_curve =
    // Points beside the peak show that nothing was missed between coarse ones.
    "time_ms,pressure_MPa\n0,0\n3,5\n5,40\n7,200\n9,400\n10.9,491.2\n11,496\n11.1,491.7\n13,410\n15,250\n16,"
    "170\n17,105\n18,60\n20,16\n23,2\n";

struct Edit {
  std::string file, from, to;
};
using Edits = std::vector<Edit>;

Edits in_scene(std::string from, std::string to) { return {{"shell.toml", std::move(from), std::move(to)}}; }
Edits in_study(std::string to) { return {{"study.toml", "gaps = ", to + "\ngaps = "}}; }
Edits with_peak(const std::string& peak) { return in_scene("496 MPa", peak); }
/// The scene with a measured curve.
Edits with_curve(const std::string& curve) {
  return {{"shell.toml", "peak = \"496 MPa\"", "curve = \"pressure.csv\"\n"}, {"pressure.csv", "", curve}};
}
/// A record that ends with a line of the sound curve, of a barrel of which nothing is said.
Edits truncated(const std::string& last) {
  Edits edits = with_curve(sound_curve.substr(0, sound_curve.find(last) + last.size()));
  edits.push_back({"shell.toml", "muzzle_exit = \"18 ms\"", ""});
  return edits;
}
/// The base of the sound scene drawn otherwise.
Edits drawn(const std::string& base, const std::string& more = "") {
  return in_scene("x = \"67.8 to 74 cm\",   r = \"0 to 7.75 cm\" },\n", base + " },\n" + more);
}
/// The scene with a charge that decomposes a hundred times faster.
Edits with_hot_mix() {
  return {{"shell.toml", "material = \"charge\"", "material = \"hot-mix.toml\""},
          {"hot-mix.toml", "", with(shipped("materials/comp-b.toml"), "21700 K", "15000 K")}};
}

class NeverSafe : public Program {
 protected:
  void write_edited(const Edits& edits) const {
    write("shell.toml", sound_scene());
    write("study.toml", sound_study);
    write("pressure.csv", sound_curve);
    for (const Edit& edit : edits)
      write(edit.file, edit.from.empty() ? edit.to : with(read(edit.file), edit.from, edit.to));
  }
  scene::Expected<std::vector<CaseRow>> computed(const Edits& edits) const {
    write_edited(edits);
    return computed_rows(read("study.toml"), folder());
  }
  CaseRow row_of(const Edits& edits) const {
    const auto rows = computed(edits);
    EXPECT_TRUE(rows) << rows.error().message();
    return rows ? rows->at(0) : CaseRow{};
  }
  void expect_refused(const Edits& edits, const std::string& key) const {
    write_edited(edits);
    const auto study = kinds::parse_study(read("study.toml"), folder() / "study.toml");
    ASSERT_FALSE(study) << key;
    EXPECT_EQ(study.error().key, key) << study.error().message();
  }
  /// The launch is computed, and nothing of it is SAFE for a reason of that name.
  void expect_open(const Edits& edits, const std::string& name) const {
    const CaseRow row = row_of(edits);
    EXPECT_TRUE(row.completed()) << name << row.failure;
    std::string names;
    for (const auto* remarks : {&row.warnings, &row.extrapolated})
      for (const study::Remark& each : *remarks)
        if (each.is_open()) names += each.name + ' ';
    EXPECT_NE(names.find(name), std::string::npos) << names;
    for (const GapRow& gap : row.gaps)
      EXPECT_NE(gap.judgement.verdict, Verdict::safe) << name << ' ' << gap.gap;
  }
};

void expect_all_safe(const CaseRow& row) {
  ASSERT_EQ(row.gaps.size(), 2u);
  for (const GapRow& gap : row.gaps) EXPECT_EQ(gap.judgement.verdict, Verdict::safe) << reason_text(row, gap);
}

TEST_F(NeverSafe, TheUnchangedStudyIsSafe) { expect_all_safe(row_of({})); }

TEST_F(NeverSafe, AMeasuredCurveThatIsSimulatedWholeIsSafe) {
  expect_all_safe(row_of(with_curve(sound_curve)));
}

TEST_F(NeverSafe, ALaunchThatIsNotSimulatedWholeIsOpen) {
  for (const char* duration : {"14.7 ms", "15 ms"})
    expect_open(in_scene("[load]", fmt::format("[load]\nduration = \"{}\"", duration)), "load");
  for (const char* last : {"15,250\n", "16,170\n", "17,105\n"}) expect_open(truncated(last), "load");
  expect_open(in_scene("\"18 ms\"", "\"12 ms\""), "short-travel");
}

/// 496 MPa in another unit, with swapped digits, and a curve in kPa for MPa: no gun launches so.
TEST_F(NeverSafe, APressureInAnotherUnitIsOpen) {
  for (const char* peak : {"49.6 MPa", "4960 psi", "72 MPa", "50.6 MPa"})
    expect_open(with_peak(peak), "low-velocity");
  expect_open(with_peak("946 MPa"), "high-velocity");
  expect_open(with_curve(with(sound_curve, "MPa", "kPa")), "low-velocity");
}

TEST_F(NeverSafe, ALoadThatTheRangeTableContradictsIsRefused) {
  expect_refused(with_peak("248 MPa\"\nexpected_velocity = \"796 m/s"), "load.expected_velocity");
  expect_refused(with_peak("426 MPa\"\nexpected_velocity = \"760 m/s"), "load.expected_velocity");
}

TEST_F(NeverSafe, AnotherShellIsOpen) {
  expect_open(in_scene("[charge]\n", "[charge]\nsliding_friction = 0.035\n"), "explosive");
  expect_open(with_hot_mix(), "explosive");
  expect_refused(in_scene("{ name = \"base\",   material = \"steel\"",
                          "{ name = \"base\",   material = \"shell-steel\""),
                 "body.base.material");
  expect_open(in_scene("cell_size = \"2.5 mm\"", "cell_size = \"3 mm\""), "cells");
}

/// What is accepted is accepted by its name, and neither the explosive nor a fault of the computation is.
TEST_F(NeverSafe, AnAcceptanceOfAnythingElseIsRefused) {
  expect_refused(in_study("accept.extrapolation.explosive = \"it is much alike\""),
                 "accept.extrapolation.explosive");
  expect_refused(in_study("accept.cells = \"they are fine enough\""), "accept.cells");
  expect_refused(in_study("accept.short-travel = \"ok\""), "accept.short-travel");
  Edits edits = in_scene("\"18 ms\"", "\"12 ms\"");
  edits.push_back(in_study("accept.low-velocity = \"a short barrel\"").front());
  expect_open(edits, "short-travel");
}

/// Where verdicts are given, the constants stand in their file alone.
TEST_F(NeverSafe, AConstantInASceneOrStudyIsRefused) {
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"kinetics.ignition_temperature", "\"700 K\""},
                                                        {"station.width", "\"7 mm\""},
                                                        {"station.depth", "\"6 mm\""},
                                                        {"friction.closure", "\"none\""},
                                                        {"friction.localisation", "250"},
                                                        {"gap.skin_thickness", "\"1 mm\""},
                                                        {"interface.wall.condition", "\"bonded\""}}) {
    if (key != "gap.skin_thickness")  // the scene has a table of that name
      expect_refused(in_scene("title =", key + " = " + value + "\ntitle ="), key);
    if (key != "station.depth") expect_refused(in_study("set." + key + " = " + value), key);
  }
  Edits exact{{"study.toml", "value = \"5 K\"", "value = \"0 K\""}};
  expect_refused(exact, "numerics.value");
}

TEST_F(NeverSafe, AGapThatIgnitesIsUnsafeWhereAnAcceptanceIsMissing) {
  Edits edits = with_peak("575 MPa");  // the wall yields over more than a third of the charge
  edits.push_back({"study.toml", "0, 0.005 cm", "0.09 cm"});
  const CaseRow row = row_of(edits);
  ASSERT_EQ(row.gaps.size(), 1u);
  EXPECT_EQ(study::names_text(row.warnings), "shell-yields");
  EXPECT_EQ(row.gaps[0].judgement.code, ReasonCode::ignites);
}

/// Drawings that would leave the charge unpushed or unheld: bodies behind a gap, in nobody's hands, or
/// absent.
TEST_F(NeverSafe, GapsInTheDrawingAreRefused) {
  const std::string ring =
      R"(  { name = "ring", material = "steel", x = "67.8 to 74 cm", r = "3.1 to 7.75 cm" },)";
  const std::string tail =
      R"(  { name = "tail", material = "steel", x = "71 to 74 cm", r = "0 to 7.75 cm" },)";
  expect_refused(drawn(R"(x = "67.84 to 74 cm", r = "0 to 7.75 cm")"), "gap.thickness");
  expect_refused(drawn(R"(x = "68.8 to 74 cm", r = "0 to 7.75 cm")"), "gap.thickness");
  expect_refused(drawn(R"(x = "67.8000001 to 74 cm", r = "0 to 7.75 cm")"), "body.base.x");
  expect_refused(drawn(R"(x = "67.8 to 74 cm", r = "0 to 3 cm")", ring), "gap.thickness");
  expect_refused(drawn(R"(x = "67.8 to 70 cm", r = "0 to 7.75 cm")", tail), "body.tail.x");
  expect_refused(in_scene("x = \"11.8 to 67.8 cm\", r = \"6.5 to 7.75 cm\"",
                          "x = \"11.8 to 60 cm\", r = \"6.5 to 7.75 cm\""),
                 "load.obturation");
  expect_refused(
      in_scene(
          "  { name = \"nose\",   material = \"steel\",  x = \"0 to 11.8 cm\",    r = \"0 to 7.75 cm\" },\n",
          ""),
      "body.charge.x");
}

/// T max at 0.005 cm. A boom of 10 cm adds 1.5 % of mass, and so takes as much from the setback pressure;
/// heat goes with its power of 3.6 where the wall yields, so that 5 % of the rise of 140 K are lost, and
/// where the boom alone was pushed nearly all of it.
TEST_F(NeverSafe, ABoomTakesNothingFromTheLoadButItsMass) {
  const double without = row_of({}).gaps.at(1).maximum.temperature;
  const double hottest =
      row_of(drawn(R"(x = "67.8 to 74 cm", r = "0 to 7.75 cm")",
                   R"(  { name = "boom", material = "steel", x = "74 to 84 cm", r = "0 to 2 cm" },)"))
          .gaps.at(1)
          .maximum.temperature;
  EXPECT_LT(hottest, without);
  EXPECT_GT(hottest, without - 8.0);
}

TEST_F(NeverSafe, AMaterialReactsByItsOwnKineticsWhichEveryPageHas) {
  using nlohmann::json;
  write_edited(with_hot_mix());
  ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
  const json kinetics = json::parse(read("out/study.json"))["kinetics"];
  EXPECT_EQ(kinetics["activation_temperature_K"], 15000.0);
  EXPECT_EQ(kinetics["frequency_per_s"], 2.01e18);
  EXPECT_EQ(kinetics["from"], "material \"hot-mix.toml\" (hot-mix.toml:1)");
  for (const char* command : {"explain", "run"})
    EXPECT_EQ(json::parse(run({command, "shell.toml", "--json"}).out)["kinetics"], kinetics) << command;
  EXPECT_EQ(json::parse(run({"explain", "study.toml", "--json"}).out)["kinetics"], kinetics);
}

TEST_F(NeverSafe, OtherKineticsBesideThoseOfAMaterialAreRefusedWithBothPlaces) {
  Edits edits = with_hot_mix();
  edits.push_back({"shell.toml", "title =", "kinetics.activation_temperature = \"21700 K\"\ntitle ="});
  write_edited(edits);
  const auto refused = kinds::parse_study(read("study.toml"), folder() / "study.toml");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().key, "kinetics.activation_temperature");
  const std::string message = refused.error().message();
  EXPECT_NE(message.find("shell.toml:"), std::string::npos) << message;
  EXPECT_NE(message.find("hot-mix.toml:"), std::string::npos) << message;
}

}  // namespace
}  // namespace launchsafe::app

// Calibrations on firings of a made-up shell: its truth is known, so that what verdicts make of them can be
// held against it.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "study/synthetic_launch.hpp"

#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

std::string firing(const std::string& outcome, int rounds, const std::string& gap,
                   const std::string& more = {}) {
  return fmt::format("[[firing]]\nname = \"{} of {}\"\noutcome = \"{}\"\nrounds = {}\ngap = \"{}\"\n{}\n",
                     rounds, gap, outcome, rounds, gap, more);
}

const std::string firing_text = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
const std::string published_constants = "calibration = \"../reports/calibrate_table8/calibration.json\"\n";

/// The synthetic launch heats by 116 K without a gap, and ignites above 0.4 mm with the calibrated constants.
FiringResult fire(const std::string& firings, const std::string& head = {}) {
  const StudyFile study = study_of(firing_text + published_constants + head + firings);
  return run_firings(study, synthetic_options());
}

std::string refusal(const std::string& text, const std::string& head = published_constants) {
  const auto study = parse_here(firing_text + head + text);
  return study ? std::string{} : study.error().message();
}

TEST(Firings, GiveConstantsAndTheLaunchesThatWereFired) {
  const FiringResult result =
      fire(firing("no ignition", 20, "0.2 mm") + firing("no ignition", 60, "0.3 to 0.4 mm"));
  ASSERT_TRUE(result.record) << answer(result);
  const auto& firings = *result.record->calibration.firings;
  ASSERT_EQ(firings.firings.size(), 2u);
  // Of a gap between two lengths the smaller counts.
  EXPECT_DOUBLE_EQ(firings.firings[1].gap, 0.3e-3);
  EXPECT_DOUBLE_EQ(firings.firings[1].most_gap, 0.4e-3);
  EXPECT_DOUBLE_EQ(result.record->calibration.evidence.largest_gap, 0.3e-3);
  EXPECT_DOUBLE_EQ(firings.firings[0].pressure, 496e6);  // the scene's
  EXPECT_EQ(result.conditions.size(), 1u);
  // 0 of 60 rounds: at most 1 - 0.05^(1/60) (Clopper and Pearson).
  EXPECT_NEAR(result.rows[1].shown.upper, 1.0 - std::pow(0.05, 1.0 / 60.0), 1e-9);
  EXPECT_NE(answer(result).find("a bound, not a fit"), std::string::npos) << answer(result);
}

TEST(Firings, MoreRoundsWithoutIgnitionLeaveALowerProbability) {
  const FiringResult few = fire(firing("no ignition", 2, "0.4 mm")),
                     many = fire(firing("no ignition", 50, "0.4 mm"));
  EXPECT_LT(many.rows[0].predicted.value, few.rows[0].predicted.value);
  EXPECT_LT(many.rows[0].predicted.upper, few.rows[0].predicted.upper);
}

TEST(Firings, ThatContradictEachOtherGiveNoRecord) {
  const FiringResult result = fire(firing("ignition", 1, "0 mm") + firing("no ignition", 1000, "0.8 mm"));
  EXPECT_FALSE(result.record);
  EXPECT_NE(answer(result).find("would hardly have ended so"), std::string::npos) << answer(result);
}

// Neither friction nor air heats.
TEST(Firings, ThatNoHeatDecidesNameThePriorThatIsTooWide) {
  const FiringResult result =
      fire(firing("no ignition", 5, "0 mm") + "[set]\nfriction.closure = \"none\"\n",
           "accept = [{ key = \"friction.closure\", value = \"none\", because = \"nothing is to heat\" }]\n");
  EXPECT_FALSE(result.record);
  for (const char* named : {"prior.localisation", "\"5 of 0 mm\""})
    EXPECT_NE(answer(result).find(named), std::string::npos) << answer(result);
}

// With the doubled prior the ignition temperature may lie 240 K lower, below that of a hot charge.
TEST(Firings, TakeTheWidestPriorThatIsAllowed) {
  const FiringResult result =
      fire(firing("no ignition", 5, "0.2 mm", "temperature = \"340 K\"\n"),
           "prior.localisation = 4\nprior.exchange_time = 4\nprior.ignition_temperature = \"40 K\"\n");
  EXPECT_TRUE(result.record) << answer(result);
}

TEST(Firings, NameTheRoundThatTellsMost) {
  const FiringResult result = fire(firing("no ignition", 5, "0.4 mm"), "next_gaps = \"0.4, 0.8, 4 mm\"\n");
  ASSERT_EQ(result.next.size(), 3u);
  for (std::size_t i = 1; i < result.next.size(); ++i)
    EXPECT_LE(result.next[i].information, result.next[i - 1].information);
  // A round whose outcome is all but certain tells next to nothing.
  EXPECT_DOUBLE_EQ(result.next.back().gap, 4e-3);
}

TEST(Firings, RefuseWhatTheyCannotRestOn) {
  EXPECT_NE(refusal("[[firing]]\noutcome = \"no ignition\"\n").find("firing.gap"), std::string::npos);
  EXPECT_NE(refusal(firing("perhaps", 1, "0.1 mm")).find("firing.outcome"), std::string::npos);
  EXPECT_NE(refusal(firing("no ignition", 0, "0.1 mm")).find("firing.rounds"), std::string::npos);
  EXPECT_NE(
      refusal("prior.localisation = 1.1\n" + firing("no ignition", 1, "0.1 mm")).find("prior.localisation"),
      std::string::npos);
  EXPECT_NE(refusal("references = \"table8.toml\"\n" + firing("no ignition", 1, "0.1 mm"))
                .find("beside [[firing]]"),
            std::string::npos);
  EXPECT_NE(refusal("references = \"table8.toml\"\nnext_gaps = \"0.1 mm\"\n", "").find("without [[firing]]"),
            std::string::npos);
}

// About constants at a guess a prior would be believed that nothing has shown: 59 quiet rounds whose prior
// has a tenth of the published heat would make thick gaps SAFE.
TEST(Firings, StartFromPublishedConstantsAlone) {
  const std::string rounds = firing("no ignition", 59, "0.3 mm");
  EXPECT_NE(refusal(rounds, "").find("[[firing]] without calibration"), std::string::npos);
  for (const char* constant : {"friction.localisation = 60", "gap.exchange_time = \"3 ms\"",
                               "kinetics.ignition_temperature = \"700 K\""})
    EXPECT_NE(refusal(rounds + "[set]\n" + constant + "\n").find("a calibration beside [set]"),
              std::string::npos)
        << constant;
}

TEST(Firings, RefuseRoundsThatWouldCountTwice) {
  const std::string rounds = firing("no ignition", 30, "0.3 mm");
  EXPECT_NE(refusal(rounds + rounds).find("the same firing a second time"), std::string::npos);
  EXPECT_EQ(refusal(rounds + firing("no ignition", 31, "0.3 mm")), "");
}

// Rounds of 496 MPa and 300 K, read under a [set] of 540 MPa and 340 K, raised the lower bound of the
// critical gap from 0.0156 to 0.0212 cm.
TEST(Firings, AreOfNoPressureOrTemperatureThatOnlySetStates) {
  const std::string both = "pressure = \"540 MPa\"\ntemperature = \"340 K\"\n";
  for (const auto& [set, fault] :
       {std::pair{"load.peak = \"540 MPa\"",
                  "firing.pressure: found nothing, and load.peak is of [set] or a default"},
        {"initial_temperature = \"340 K\"", "firing.temperature: found nothing"}}) {
    const std::string table = std::string("[set]\n") + set + "\n";
    EXPECT_NE(refusal(firing("no ignition", 100, "0.6 mm") + table).find(fault), std::string::npos) << set;
    EXPECT_EQ(refusal(firing("no ignition", 100, "0.6 mm", both) + table), "") << set;
  }
}

/// A study of the made-up shell on the record of its firings.
class StudyOnFirings : public FolderWithScene {
 protected:
  void record(const std::string& firings, const std::string& head = {}) {
    const FiringResult result = fire(firings, head);
    ASSERT_TRUE(result.record) << answer(result);
    write(to_json_text(*result.record));
  }
  void write(const std::string& text) { std::ofstream(folder_ / "calibration.json") << text; }

  scene::Expected<StudyFile> read(const std::string& more) const {
    return kinds::parse_study(critical_kind + "calibration = \"calibration.json\"\n" + statements_ + more,
                              folder_ / "study.toml");
  }
  /// Verdicts by the gaps of the study.
  std::vector<GapVerdict> verdicts(const std::string& more = {}) const {
    auto study = read(more);
    EXPECT_TRUE(study) << (study ? "" : study.error().message());
    if (!study) return {};
    study->study.in_detail = false;
    study->confirmations_per_case = 0;
    return run_critical_gap(*study, synthetic_options()).answers.front().verdicts;
  }

  const std::string statements_ =
      "input_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
      "model_form_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
      "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
      "gaps = \"0, 0.1, 0.3, 0.5 mm\"\nlargest_gap = \"1 cm\"\n";
};

int count_safe(const std::vector<GapVerdict>& rows) {
  return static_cast<int>(std::ranges::count_if(
      rows, [](const GapVerdict& row) { return row.judgement.verdict == Verdict::safe; }));
}

TEST_F(StudyOnFirings, IsSafeForThinGapsAfterManyRoundsWithThickOnes) {
  record(firing("no ignition", 60, "0.6 mm") + firing("ignition", 5, "2.5 mm"));
  const auto rows = verdicts();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].judgement.verdict, Verdict::safe) << reason_text(rows[0]);
}

TEST_F(StudyOnFirings, IsNeverSafeAfterFewRounds) {
  for (const int rounds : {1, 5, 58}) {
    record(firing("no ignition", rounds, "0.6 mm") +
           firing("no ignition", 100'000, "0.6 mm", "pressure = \"400 MPa\"\n"));
    EXPECT_EQ(count_safe(verdicts()), 0) << rounds;
  }
}

TEST_F(StudyOnFirings, WorseDefectsCannotBeAccepted) {
  record(firing("no ignition", 1000, "0.6 mm"));
  const auto rows = verdicts(
      "accept = [{ key = \"charge.crack_radius\", value = \"45 um\", because = \"it is hardly more\" }]\n"
      "[set]\ncharge.crack_radius = \"45 um\"\n");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(count_safe(rows), 0);
  EXPECT_EQ(rows[0].judgement.code, ReasonCode::beyond_firings) << reason_text(rows[0]);
}

TEST_F(StudyOnFirings, IsNotSafeBeyondTheGapsThatDidNotIgnite) {
  record(firing("no ignition", 1000, "0.2 mm") + firing("ignition", 50, "2.5 mm"));
  const auto rows = verdicts();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].judgement.verdict, Verdict::safe) << reason_text(rows[0]);
  EXPECT_EQ(rows[2].judgement.verdict, Verdict::indeterminate) << reason_text(rows[2]);
  EXPECT_EQ(rows[2].judgement.code, ReasonCode::beyond_firings) << reason_text(rows[2]);
}

// Where one of three rounds did not ignite, that is no evidence of safety.
TEST_F(StudyOnFirings, IsNotSafeWhereOthersOfTheSameRoundsIgnited) {
  record(firing("no ignition", 1000, "0.2 mm") + firing("ignition", 2, "0.5 mm") +
         firing("no ignition", 10, "0.5 mm"));
  const auto rows = verdicts();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2].judgement.code, ReasonCode::beyond_firings) << reason_text(rows[2]);
}

// Rounds that ignited are no evidence of safety, however many.
TEST_F(StudyOnFirings, IsNotSafeWhereOnlyIgnitionsWereFired) {
  record(firing("ignition", 20, "2.5 mm"));
  EXPECT_EQ(count_safe(verdicts()), 0);
}

TEST_F(StudyOnFirings, HoldsForNoHotterChargeAndNoHigherPressure) {
  record(firing("no ignition", 1000, "0.6 mm") +
         firing("no ignition", 1000, "0.6 mm", "temperature = \"290 K\"\n"));
  EXPECT_GT(count_safe(verdicts()), 0);
  const auto colder = verdicts("[set]\ninitial_temperature = \"295 K\"\n");
  EXPECT_GT(count_safe(colder), 0) << reason_text(colder.front());
  for (const char* set :
       {"initial_temperature = \"305 K\"", "load.peak = \"497 MPa\"", "load.peak = \"495 MPa\"",
        "load.width = \"3 ms\"", "charge.crack_radius = \"31 um\""}) {
    ASSERT_TRUE(read(std::string("[set]\n") + set + "\n")) << set;
    EXPECT_EQ(count_safe(verdicts(std::string("[set]\n") + set + "\n")), 0) << set;
  }
}

// What is accepted may be milder than what was fired, never worse.
TEST_F(StudyOnFirings, AcceptingAHigherPressureMakesNothingSafe) {
  record(firing("no ignition", 1000, "0.6 mm"));
  const std::string accepted =
      "accept = [{ key = \"load.peak\", value = \"497 MPa\", because = \"it is hardly more\" }]\n"
      "[set]\nload.peak = \"497 MPa\"\n";
  const auto rows = verdicts(accepted);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(count_safe(rows), 0);
  EXPECT_EQ(rows[0].judgement.code, ReasonCode::beyond_firings) << reason_text(rows[0]);
}

TEST_F(StudyOnFirings, OtherAirThanThatOfTheChargeCannotBeAccepted) {
  record(firing("no ignition", 1000, "0.6 mm"));
  const auto rows = verdicts(
      "accept = [{ key = \"gap.air_density\", value = \"1.3 kg/m3\", because = \"it is hardly more\" }]\n"
      "[set]\ngap.air_density = \"1.3 kg/m3\"\n");
  EXPECT_EQ(count_safe(rows), 0);
}

TEST_F(StudyOnFirings, IsRefusedWhereNoVerdictCarriesItsPosterior) {
  record(firing("no ignition", 60, "0.2 mm"));
  const auto study = kinds::parse_study(
      "kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\ncalibration = \"calibration.json\"\nsamples = "
      "8\n" +
          std::string("vary = [{ key = \"initial_temperature\", distribution = \"uniform\", range = \"290 to "
                      "310 K\" }]\n"),
      folder_ / "sensitivity.toml");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("a calibration on firings"), std::string::npos)
      << study.error().message();
}

TEST_F(StudyOnFirings, StartFromNoConstantsThatAreNotPlausible) {
  std::ifstream file(studies_folder / "../reports/calibrate_table8/calibration.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CalibrationRecord guessed = parse_either_calibration(text, "calibration.json").value();
  guessed.calibration.scene.surface.exchange_time = 3e-3;
  write(to_json_text(guessed));
  const auto study = kinds::parse_study(
      firing_text + "calibration = \"calibration.json\"\n" + firing("no ignition", 59, "0.3 mm"),
      folder_ / "firings.toml");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("gap.exchange_time = 3 ms is not plausible"), std::string::npos)
      << study.error().message();
}

TEST_F(StudyOnFirings, AreOfNoPressureThatIsTheDefaultOfAScene) {
  std::ifstream file(studies_folder / "scene_155mm.toml");
  std::string scene{std::istreambuf_iterator<char>(file), {}};
  const std::string peak = "\npeak = \"496 MPa\"";
  ASSERT_NE(scene.find(peak), std::string::npos);
  std::ofstream(folder_ / "scene_155mm.toml") << scene.erase(scene.find(peak), peak.size());
  std::filesystem::copy(studies_folder / "../reports/calibrate_table8/calibration.json", folder_,
                        std::filesystem::copy_options::overwrite_existing);
  const auto study = kinds::parse_study(
      firing_text + "calibration = \"calibration.json\"\n" + firing("no ignition", 59, "0.3 mm"),
      folder_ / "firings.toml");
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().key, "firing.pressure") << study.error().message();
}

TEST_F(StudyOnFirings, SaysThatInventedFiringsAreADemonstration) {
  record(firing("no ignition", 1000, "0.6 mm"), "demonstration = true\n");
  EXPECT_NE(reason_text(verdicts().front()).find("a demonstration"), std::string::npos);
}

TEST_F(StudyOnFirings, RefusesAnEditedRecord) {
  const FiringResult result = fire(firing("no ignition", 5, "0.2 mm"));
  ASSERT_TRUE(result.record);
  std::string text = to_json_text(*result.record);
  const std::size_t place = text.find("\"rounds\": 5");
  ASSERT_NE(place, std::string::npos);
  text.replace(place, 11, "\"rounds\": 500");
  write(text);
  const auto study = read("");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("digest"), std::string::npos) << study.error().message();
}

// Records of format 1 may have started from constants at a guess, with which thick gaps were SAFE.
TEST_F(StudyOnFirings, RefusesARecordOfAnEarlierFormat) {
  const FiringResult result = fire(firing("no ignition", 60, "0.6 mm"));
  ASSERT_TRUE(result.record);
  std::string text = to_json_text(*result.record);
  const std::string format = "launchsafe firing record 2";
  ASSERT_NE(text.find(format), std::string::npos);
  text.replace(text.find(format), format.size(), "launchsafe firing record 1");
  write(text);
  const auto study = read("");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("launchsafe firing record 1"), std::string::npos)
      << study.error().message();
}

TEST_F(StudyOnFirings, RefusesFiringsThatStartFromFirings) {
  record(firing("no ignition", 5, "0.2 mm"));
  const auto study = kinds::parse_study(
      firing_text + "calibration = \"calibration.json\"\n" + firing("no ignition", 5, "0.2 mm"),
      folder_ / "again.toml");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("a calibration on firings"), std::string::npos)
      << study.error().message();
}

// A record that is read says what the one that was written said.
TEST(FiringRecord, IsReadAsItWasWritten) {
  const FiringResult result = fire(firing("no ignition", 5, "0.2 mm"));
  ASSERT_TRUE(result.record);
  const std::string text = to_json_text(*result.record);
  const auto read = parse_either_calibration(text, "calibration.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_json_text(*read), text);
  EXPECT_TRUE(read->calibration.firings);
  EXPECT_FALSE(parse_calibration_record(text, "calibration.json"));
}

}  // namespace

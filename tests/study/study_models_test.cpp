// Launches under other constants than a study's own, on a launch in closed form.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "study/synthetic_launch.hpp"

#include <cmath>
#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// Steepness of the load by the constants `hot`, whose launch heats more by friction.
constexpr double hot_steepness = 1.4;

run::MechanicsResult launch_by_steepness(const scene::Scene& scene, const run::RunOptions&) {
  return synthetic_mechanics(scene, scene.load.steepness == hot_steepness ? 130.0 : 116.1);
}

/// That launch, which breaks off, or throws, under the constants `hot`.
run::MechanicsResult broken_launch(const scene::Scene& scene, const run::RunOptions& options, bool throws) {
  run::MechanicsResult result = launch_by_steepness(scene, options);
  if (scene.load.steepness != hot_steepness) return result;
  if (throws) throw std::runtime_error("energy drift");
  result.status = run::RunStatus::energy_drift;
  return result;
}

const GapShare* share_of_models(const CriticalGap& critical) {
  const auto found = std::ranges::find(critical.shares, ShareKind::model_form, &GapShare::kind);
  return found == critical.shares.end() ? nullptr : &*found;
}

/// The critical gap that a search found, accepted or not.
GapOrBound found_in(const CriticalGap& critical) {
  return std::isnan(critical.indicative) ? gap_or_bound(critical) : critical.indicative;
}

class StudyModels : public FolderWithScene {
 protected:
  void SetUp() override {
    FolderWithScene::SetUp();
    std::filesystem::remove_all(folder_ / "results");
    write("hot", "load.steepness", hot_steepness);
    write("late", "kinetics.ignition_temperature", 540.0);
  }

  /// The shipped constants with another value, as a file of that name.
  void write(const std::string& name, const std::string& key, double value) const {
    scene::Constants constants = *scene::shipped_constants().front();
    constants.values[key] = value;
    std::ofstream(folder_ / (name + ".toml")) << scene::to_toml(constants);
  }

  scene::Expected<StudyFile> parsed(const std::string& keys) const {
    const std::string text = critical_text +
                             "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
                             "confirm = false\ngaps = \"0.01 cm\"\n" +
                             keys;
    return parse_study(text, folder_ / "study.toml");
  }
  StudyFile study(const std::string& keys) const {
    const auto study = parsed(keys);
    EXPECT_TRUE(study) << (study ? "" : study.error().message());
    return study ? *study : StudyFile{};
  }

  CriticalGapResult run(const StudyFile& study, store::CaseStore* store = nullptr) const {
    StudyOptions options = synthetic_options();
    options.runners.mechanics = launch_by_steepness;
    options.store = store;
    return run_critical_gap(study, options);
  }
};

TEST_F(StudyModels, MoveTheCriticalGapToTheSmallestAndTheLargestOfAll) {
  const CaseAnswer alone = run(study("")).answers.at(0);
  const CaseAnswer answer = run(study("models = \"hot.toml, late.toml\"\n")).answers.at(0);
  ASSERT_EQ(answer.critical.kind, CriticalGapKind::value) << text_of(answer.critical.reason);
  ASSERT_EQ(answer.models.size(), 2u);
  const ModelGap &hot = answer.models[0], &late = answer.models[1];
  EXPECT_EQ(hot.name, "hot");
  EXPECT_EQ(late.name, "late");
  EXPECT_LT(hot.critical_gap, answer.critical.lower - 1e-5);
  EXPECT_GT(late.critical_gap, answer.critical.upper + 1e-5);
  const GapShare* share = share_of_models(answer.critical);
  ASSERT_NE(share, nullptr);
  EXPECT_EQ(share->raised, hot.critical_gap);
  EXPECT_EQ(share->lowered, late.critical_gap);
  EXPECT_NEAR(alone.critical.bounds.at_least - answer.critical.bounds.at_least,
              answer.critical.lower - hot.critical_gap, 1e-9);
  EXPECT_NEAR(answer.critical.bounds.at_most - alone.critical.bounds.at_most,
              late.critical_gap - answer.critical.upper, 1e-9);
  EXPECT_GT(answer.verdicts.at(0).uncertainty.model_form, 1.0);
}

TEST_F(StudyModels, AreNoCauseWhereTheStudyNamesNone) {
  const CriticalGapResult result = run(study(""));
  EXPECT_TRUE(result.answers.at(0).models.empty());
  EXPECT_EQ(share_of_models(result.answers.at(0).critical), nullptr);
  EXPECT_EQ(result.answers.at(0).verdicts.at(0).uncertainty.model_form, 0.0);
}

TEST_F(StudyModels, AreSearchedWithTheirOwnSkin) {
  const CaseAnswer answer = run(study("models = \"late.toml\"\n")).answers.at(0);
  const CaseAnswer stated = run(study("[set]\nkinetics.ignition_temperature = \"540 K\"\n")).answers.at(0);
  EXPECT_NEAR(answer.models.at(0).critical_gap, found_in(stated.critical), 2e-6);
}

/// The case's own launch is sound, but nothing says how small its critical gap may be.
TEST_F(StudyModels, OneThatFailsLeavesNoBoundAndIsNamed) {
  for (const bool in_detail : {true, false})
    for (const bool throws : {true, false}) {
      StudyFile file = study("models = \"hot.toml, late.toml\"\n");
      file.study.in_detail = in_detail;
      StudyOptions options = synthetic_options();
      options.runners.mechanics = [throws](const scene::Scene& scene, const run::RunOptions& of_run) {
        return broken_launch(scene, of_run, throws);
      };
      const CaseAnswer answer = run_critical_gap(file, options).answers.at(0);
      EXPECT_TRUE(answer.completed());
      EXPECT_EQ(answer.critical.kind, CriticalGapKind::value);
      EXPECT_TRUE(std::isnan(answer.critical.bounds.at_least));
      EXPECT_TRUE(std::isnan(answer.critical.bounds.at_most));
      EXPECT_TRUE(std::isfinite(answer.models.at(1).critical_gap));
      const GapVerdict& row = answer.verdicts.at(0);
      EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
      EXPECT_NE(reason_text(row).find("constants hot failed"), std::string::npos) << reason_text(row);
      EXPECT_NE(reason_text(row).find("energy drift"), std::string::npos) << reason_text(row);
    }
}

TEST_F(StudyModels, CasesThatShareTheirMechanicsShareTheirModels) {
  const StudyFile file = study("models = \"hot.toml\"\n" + vary({{"gap.exchange_time", "0.28, 0.3 ms"}}));
  const std::vector<CaseRuns> runs = case_runs(file, 1);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].members.size(), 2u);
  ASSERT_EQ(runs[0].runs.size(), 2u);
  EXPECT_EQ(runs[0].runs[0].model, "");
  EXPECT_EQ(runs[0].runs[1].model, "hot");
  EXPECT_EQ(runs[0].runs[1].make().scene.load.steepness, hot_steepness);
}

/// The launch is the same under both, and stored; the answer is another one.
TEST_F(StudyModels, OfOtherValuesAreAnotherAnswer) {
  auto store = store::CaseStore::open(folder_ / "results");
  ASSERT_TRUE(store);
  const auto answered = [&] {
    StudyFile file = study("models = \"late.toml\"\n");
    file.study.in_detail = false;
    return run(file, store->get());
  };
  const GapOrBound first = answered().answers.at(0).models.at(0).critical_gap;
  const CriticalGapResult again = answered();
  EXPECT_EQ(again.timing.runs, 0u);
  EXPECT_EQ(again.answers.at(0).models.at(0).critical_gap, first);
  write("late", "kinetics.ignition_temperature", 545.0);
  const CriticalGapResult later = answered();
  EXPECT_EQ(later.timing.runs, 0u);
  EXPECT_GT(later.answers.at(0).models.at(0).critical_gap, first);
}

TEST_F(StudyModels, FaultsNameTheKey) {
  for (const std::string names : {"bonded", "none", "hot.toml, hot.toml", "absent.toml"}) {
    const auto refused = parsed("models = \"" + names + "\"\n");
    ASSERT_FALSE(refused) << names;
    EXPECT_EQ(refused.error().key, "models") << refused.error().message();
  }
}

}  // namespace

// Launches under other constants than a study's own, on a launch in closed form.
#include "study/synthetic_launch.hpp"

#include <cmath>
#include <fstream>

namespace {

using namespace launchsafe;
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

const CauseShare* share_of_models(const CaseRow& row) {
  const auto found = std::ranges::find(row.causes, Cause::models, &CauseShare::cause);
  return found == row.causes.end() ? nullptr : &*found;
}

class StudyModels : public FolderWithScene {
 protected:
  void SetUp() override {
    FolderWithScene::SetUp();
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
    return kinds::parse_study(critical_text + "gaps = \"0.01 cm\"\n" + keys, folder_ / "study.toml");
  }
  StudyFile study(const std::string& keys) const {
    const auto study = parsed(keys);
    EXPECT_TRUE(study) << (study ? "" : study.error().message());
    return study ? *study : StudyFile{};
  }

  CaseRow row_of(const std::string& keys, bool breaks_off = false, bool throws = false) const {
    StudyOptions options = synthetic_options();
    options.runners.mechanics = [=](const scene::Scene& scene, const run::RunOptions& of_run) {
      return breaks_off ? broken_launch(scene, of_run, throws) : launch_by_steepness(scene, of_run);
    };
    return rows_of(study(keys), options).at(0);
  }
};

TEST_F(StudyModels, MoveTheBoundsToTheSmallestAndTheLargestOfAll) {
  const CaseRow alone = row_of("");
  const CaseRow row = row_of("models = \"hot.toml, late.toml\"\n");
  ASSERT_EQ(row.critical.kind, CriticalGapKind::value);
  EXPECT_EQ(row.critical.value, alone.critical.value);
  EXPECT_EQ(of_each(row.models, &ModelGap::name), (std::vector<std::string>{"hot", "late"}));
  const double shorter = row.critical.value - row.models[0].critical_gap,
               longer = row.models[1].critical_gap - row.critical.value;
  EXPECT_GT(shorter, 1e-5);
  EXPECT_GT(longer, 1e-5);
  const CauseShare* share = share_of_models(row);
  ASSERT_NE(share, nullptr);
  EXPECT_EQ(share->shorter, shorter);
  EXPECT_EQ(share->longer, longer);
  EXPECT_GT(row.bounds.at_least, 0.0);
  EXPECT_NEAR(alone.bounds.at_least - row.bounds.at_least, shorter, 1e-9);
  EXPECT_NEAR(row.bounds.at_most - alone.bounds.at_most, longer, 1e-9);
}

TEST_F(StudyModels, AreNoCauseWhereTheStudyNamesNone) {
  const CaseRow row = row_of("");
  EXPECT_TRUE(row.models.empty());
  EXPECT_EQ(share_of_models(row), nullptr);
}

/// The critical gap of a model is that of a study that has it for its constants.
TEST_F(StudyModels, AreSearchedWithTheirOwnSkin) {
  const CaseRow other = row_of("models = \"late.toml\"\n"), own = row_of("constants = \"late.toml\"\n");
  EXPECT_NEAR(other.models.at(0).critical_gap, own.critical.value, gap_accuracy);
}

/// The case's own launch is sound, but nothing says how small its critical gap may be.
TEST_F(StudyModels, OneThatFailsLeavesNoBoundAndIsNamed) {
  for (const bool throws : {true, false}) {
    const CaseRow row = row_of("models = \"hot.toml, late.toml\"\n", true, throws);
    EXPECT_TRUE(row.completed());
    EXPECT_EQ(row.critical.kind, CriticalGapKind::value);
    EXPECT_TRUE(std::isnan(row.bounds.at_least) && std::isnan(row.bounds.at_most));
    EXPECT_TRUE(std::isnan(row.models.at(0).critical_gap));
    EXPECT_TRUE(std::isfinite(row.models.at(1).critical_gap));
    EXPECT_EQ(row.gaps.at(0).judgement.code, ReasonCode::failed);
    EXPECT_NE(row.incomplete.find("hot"), std::string::npos) << row.incomplete;
    EXPECT_NE(row.incomplete.find("energy drift"), std::string::npos) << row.incomplete;
  }
}

TEST_F(StudyModels, CasesThatShareTheirMechanicsShareTheirModels) {
  const StudyFile file =
      study("models = \"hot.toml\"\n" + vary({{"kinetics.heat_of_reaction", "5.8, 5.9 MJ/kg"}}));
  const std::vector<CaseRuns> cases = case_runs(file, 1);
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].members.size(), 2u);
  EXPECT_EQ(of_each(cases[0].runs, &PlannedRun::part), (std::vector{Part::own, Part::model}));
  EXPECT_EQ(cases[0].runs[1].name, "hot");
  EXPECT_EQ(cases[0].runs[1].make().scene.load.steepness, hot_steepness);
}

TEST_F(StudyModels, FaultsNameTheKey) {
  for (const std::string names : {"bonded", "none", "hot.toml, hot.toml", "absent.toml"}) {
    const auto refused = parsed("models = \"" + names + "\"\n");
    ASSERT_FALSE(refused) << names;
    EXPECT_EQ(refused.error().key, "models") << refused.error().message();
  }
}

}  // namespace

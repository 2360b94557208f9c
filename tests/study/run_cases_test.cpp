#include "launchsafe/study/run_cases.hpp"

#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

const std::string two_cases = critical_text + vary({{"peak_pressure", "450, 496 MPa"}});

/// What became of every run of a study's cases: label and outcome.
std::map<std::string, RunOutcome> outcomes_of(const StudyFile& study, const StudyOptions& options) {
  std::map<std::string, RunOutcome> outcomes;
  std::mutex mutex;
  ProgressTracker tracker({});
  Timing timing;
  const std::vector<CaseRuns> cases = case_runs(study, options.shard.count);
  run_cases(cases, options, tracker, timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
    const std::lock_guard lock(mutex);
    for (std::size_t j = 0; j < runs.size(); ++j) {
      const bool is_new = outcomes.emplace(cases[i].runs[j].make().label, runs[j].outcome).second;
      EXPECT_TRUE(is_new) << "judged twice: " << cases[i].runs[j].make().label;
    }
  });
  return outcomes;
}

std::size_t count(const std::map<std::string, RunOutcome>& outcomes, RunOutcome outcome) {
  std::size_t found = 0;
  for (const auto& [label, each] : outcomes) found += each == outcome ? 1 : 0;
  return found;
}

TEST(RunCases, EveryCaseIsJudgedOnce) {
  const auto outcomes = outcomes_of(lean_study_of(two_cases), synthetic_options());
  EXPECT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(count(outcomes, RunOutcome::ran), 2u);
}

/// Driven from the list of keys: whatever a study varies, cases that share a run have equal mechanics, and
/// those that do not have other ones.
TEST(RunCases, CasesShareARunWhereTheirMechanicsAreEqualAndNowhereElse) {
  std::size_t tried = 0, shared = 0;
  // Without constants, of which a study that gives verdicts varies none.
  const std::string text = critical_text + "constants = \"none\"\ngaps = \"0.1 mm\"\n";
  const scene::Scene own = study_of(text).scene.scene;
  for (const auto& key : scene::scene_keys()) {
    if (key.kind != scene::KeyKind::number || key.name == "load.peak") continue;
    const double usual = std::get<double>(key.get(own));
    const double other = key.dimension == scene::Dimension::count ? 1.0 : 0.01 * usual;
    auto study =
        parse_here(text + vary({{key.name, fmt::format("[\"{}\", \"{}\"]", scene::format_value(key, usual),
                                                       scene::format_value(key, usual + other))},
                                {"peak_pressure", "450, 496 MPa"}}));
    if (!study) continue;  // no other value of it stands beside the rest of the scene
    study->study.in_detail = false;
    ++tried;
    std::set<std::string> hashes;
    for (const CaseRuns& each : case_runs(*study, 1)) {
      shared += each.members.size() - 1;
      const auto hash_of = [&](std::size_t member) {
        return mechanics_run(study->cases[member].scene.scene, {}).hash;
      };
      const std::string hash = hash_of(each.members.front());
      EXPECT_TRUE(hashes.insert(hash).second) << key.name << ": the same run twice";
      for (const std::size_t member : each.members) EXPECT_EQ(hash_of(member), hash) << key.name;
    }
  }
  EXPECT_GE(tried, 40u);
  EXPECT_GE(shared, 20u);
}

TEST(RunCases, LaunchesThatBoundsRestOnBelongToTheirCase) {
  const StudyFile study = lean_study_of(critical_kind + vary({{"peak_pressure", "450, 496 MPa"}}));
  const std::vector<CaseRuns> cases = case_runs(study, 1);
  ASSERT_EQ(cases.size(), 2u);
  for (const CaseRuns& each : cases) {
    EXPECT_EQ(of_each(each.runs, &PlannedRun::part), (std::vector{Part::own, Part::raised, Part::companion}));
    const scene::Scene own = each.runs[0].make().scene;
    EXPECT_NEAR(each.runs[1].make().scene.load.peak, 1.04 * own.load.peak, 1.0);
    const scene::Numerics coarse = each.runs[2].make().scene.numerics;
    EXPECT_EQ(coarse.cell_size, 2.0 * own.numerics.cell_size);
    EXPECT_EQ(coarse.largest_cell, own.numerics.largest_cell);  // it is the larger one
  }
}

TEST(RunCases, OtherCellsThanThoseOfTheConstantsAreLaunchedOnTheseToo) {
  const StudyFile study = lean_study_of(critical_kind + "[set]\nnumerics.cell_size = \"1 mm\"\n");
  const std::vector<CaseRuns> cases = case_runs(study, 1);
  EXPECT_EQ(of_each(cases.at(0).runs, &PlannedRun::part),
            (std::vector{Part::own, Part::raised, Part::companion, Part::cells_of_constants}));
  EXPECT_EQ(cases[0].runs[3].make().scene.numerics.cell_size, 1.25e-3);
}

TEST(RunCases, StatedNumericsAndASpreadOfZeroTakeNoLaunch) {
  const StudyFile study = lean_study_of(critical_text);
  EXPECT_EQ(case_runs(study, 1).at(0).runs.size(), 1u);
}

TEST(RunCases, ACaseOfAnotherShardIsNotRun) {
  StudyOptions options = synthetic_options();
  options.shard = {1, 2};
  const auto outcomes = outcomes_of(lean_study_of(two_cases), options);
  EXPECT_EQ(count(outcomes, RunOutcome::ran), 1u);
  EXPECT_EQ(count(outcomes, RunOutcome::other_shard), 1u);
}

TEST(RunCases, ARunThatIsTooLargeIsRefusedAndTheOthersRun) {
  StudyOptions options = synthetic_options();
  options.memory_limit = 1.0;  // byte
  EXPECT_EQ(count(outcomes_of(lean_study_of(two_cases), options), RunOutcome::refused), 2u);
}

TEST(RunCases, ARunThatThrowsIsFailedAlone) {
  StudyOptions options = synthetic_options();
  const auto run = options.runners.mechanics;
  options.runners.mechanics = [run](const scene::Scene& scene, const run::RunOptions& of_run) {
    if (scene.load.peak < 460e6) throw std::runtime_error("no memory");
    return run(scene, of_run);
  };
  const auto outcomes = outcomes_of(lean_study_of(two_cases), options);
  EXPECT_EQ(count(outcomes, RunOutcome::failed), 1u);
  EXPECT_EQ(count(outcomes, RunOutcome::ran), 1u);
}

TEST(RunCases, AStudyThatIsStoppedLeavesItsRunsInterrupted) {
  std::atomic<bool> stop{true};
  StudyOptions options = synthetic_options();
  options.stop = &stop;
  EXPECT_EQ(count(outcomes_of(lean_study_of(two_cases), options), RunOutcome::interrupted), 2u);
}

// After Ctrl-C `status` said one case more than was kept.
TEST(RunCases, ACaseThatWasInterruptedBeforeItWasJudgedIsNotDone) {
  std::size_t done = 0, calls = 0;
  ProgressTracker tracker([&](const Progress& progress) {
    done = progress.cases_done;
    ++calls;
  });
  Timing timing;
  const StudyFile study = lean_study_of(two_cases);
  run_cases(
      case_runs(study, 1), synthetic_options(), tracker, timing,
      [](std::size_t, std::vector<FinishedRun>& runs) { runs.front().outcome = RunOutcome::interrupted; });
  EXPECT_GT(calls, 0u);
  EXPECT_EQ(done, 0u);
}

/// What judging throws, with or without a word, is the failure of its case, told to the judge itself.
TEST(RunCases, AJudgeThatThrowsIsCalledOnceMoreWithTheReason) {
  const StudyFile study = lean_study_of(two_cases);
  const std::vector<CaseRuns> cases = case_runs(study, 1);
  for (const std::string why : {"not a number", ""}) {
    std::atomic<int> thrown{0}, failed{0};
    ProgressTracker tracker({});
    Timing timing;
    run_cases(cases, synthetic_options(), tracker, timing, [&](std::size_t, std::vector<FinishedRun>& runs) {
      if (runs.front().has_result()) {
        ++thrown;
        throw std::runtime_error(why);
      }
      EXPECT_EQ(runs.front().outcome, RunOutcome::failed);
      EXPECT_NE(runs.front().failure.find(why), std::string::npos);
      ++failed;
    });
    EXPECT_EQ(thrown, 2);
    EXPECT_EQ(failed, 2);
  }
}

TEST(RunCases, ASecondRunIsNotBegunOnceTheFirstBrokeOff) {
  StudyOptions options = synthetic_options();
  options.jobs = 1;
  std::atomic<int> begun{0};
  options.runners.mechanics = [&begun](const scene::Scene&, const run::RunOptions&) {
    ++begun;
    run::MechanicsResult broken;
    broken.status = run::RunStatus::energy_drift;
    return broken;
  };
  outcomes_of(lean_study_of(critical_kind), options);
  EXPECT_EQ(begun, 1);
}

}  // namespace

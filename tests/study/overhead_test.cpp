// What a study costs besides simulating (opt-in: ctest -L slow).
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/study/sweep.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds of processor time of this thread that a function takes.
template <class Function>
double cost_of(Function function) {
  const double start = thread_seconds();
  function();
  return thread_seconds() - start;
}

/// A sweep of `pressures` times `radii` mechanical runs.
std::string large_sweep(int pressures, int radii) {
  std::string peaks, sizes;
  for (int i = 0; i < pressures; ++i) peaks += fmt::format("{}{}", i > 0 ? ", " : "", 300 + 2 * i);
  for (int i = 0; i < radii; ++i) sizes += fmt::format("{}{}", i > 0 ? ", " : "", 10 + i);
  return fmt::format(
      "kind = \"sweep\"\nscene = \"scene_155mm.toml\"\n[axes]\ngap = \"0, 0.02 cm\"\n"
      "peak_pressure = \"{} MPa\"\ncrack_radius = \"{} um\"\n{}",
      peaks, sizes, synthetic_constants);
}

class StudyOverheadSlow : public launchsafe::testing::TemporaryFolder {
 protected:
  std::unique_ptr<store::CaseStore> open_store() {
    auto store = store::CaseStore::open(folder() / "results", {"", run::model_version, {}});
    EXPECT_TRUE(store);
    return std::move(*store);
  }
};

// The number: under 1 % of the wall time with 1000 cases of 0.1 s. A case is a trace like that of the
// shipped scene; drawing its answer is simulation too, and is measured by itself.
TEST_F(StudyOverheadSlow, IsUnderOnePercentWithAThousandCasesOfATenthOfASecond) {
  constexpr double seconds_a_case = 0.1;
  constexpr int jobs = 2;
  const StudyFile study = study_of(large_sweep(40, 25));
  const run::MechanicsResult like_shipped = run::run_mechanics([] {
    scene::Scene scene = scene::read_scene(studies_folder / "scene_155mm.toml").value().scene;
    scene.numerics.cell_size = 20e-3;
    scene.numerics.inertial_scaling = 400.0;
    return scene;
  }());
  StudyOptions options;
  options.jobs = jobs;
  options.runners = synthetic_runners();
  options.runners.mechanics = [&](const scene::Scene&, const run::RunOptions&) {
    const double start = thread_seconds();
    run::MechanicsResult result = like_shipped;
    while (thread_seconds() - start < seconds_a_case) {
    }
    return result;
  };
  constexpr int repeats = 20;
  const double answering = cost_of([&] {
                             for (int i = 0; i < repeats; ++i)
                               answer_of(study.study, study.cases.front(), like_shipped);
                           }) /
                           repeats;
  const auto store = open_store();
  options.store = store.get();
  const auto start = std::chrono::steady_clock::now();
  const SweepResult result = run_sweep(study, options);
  EXPECT_FALSE(store->flush());
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(result.timing.runs, 1000u);
  const double ideal = 1000.0 * (seconds_a_case + answering) / jobs;
  fmt::print("wall {:.2f} s, ideal {:.2f} s (0.1 s and {:.1f} ms a case): overhead {:.2f} %\n", wall, ideal,
             1e3 * answering, 100.0 * (wall / ideal - 1.0));
  EXPECT_LT(wall, 1.01 * ideal);
}

TEST_F(StudyOverheadSlow, AFinishedStudyOfTenThousandCasesIsResumedInUnderTwoSeconds) {
  const std::string text = large_sweep(100, 100);
  StudyOptions options;
  options.jobs = 2;
  options.runners = synthetic_runners();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = synthetic_mechanics(scene);
    for (int i = 0; i < 4; ++i) result.trace = trace::thinned(result.trace);
    return result;
  };
  std::vector<CaseAnswer> fresh;
  {
    const auto store = open_store();
    options.store = store.get();
    fresh = run_sweep(study_of(text), options).answers;
    ASSERT_FALSE(store->flush());
  }
  const auto start = std::chrono::steady_clock::now();
  const StudyFile study = study_of(text);
  const auto store = open_store();
  options.store = store.get();
  const SweepResult result = run_sweep(study, options);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("10 000 finished cases: {:.2f} s\n", wall);
  EXPECT_EQ(result.timing.runs, 0u);
  EXPECT_EQ(result.timing.reused, 10000u);
  ASSERT_EQ(result.answers.size(), fresh.size());
  for (std::size_t i = 0; i < fresh.size(); i += 97)
    EXPECT_EQ(to_json_line(result.answers[i]), to_json_line(fresh[i])) << i;
  EXPECT_LT(wall, 2.0);
}

}  // namespace

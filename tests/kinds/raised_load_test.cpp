// Sweeps over the peak pressure whose raised loads are interpolated between neighbouring cases. The launch is
// one whose friction heats with the cube of the peak pressure, so that the interpolation has an error.
#include "launchsafe/study/run_cases.hpp"
#include "made_sweeps.hpp"

namespace launchsafe::study {
namespace {

const std::string interpolated = "raised_load = \"interpolated\"\n";

/// A sweep that states no uncertainty of its inputs.
std::string sweep_text(const std::string& peaks, const std::string& first = interpolated) {
  return first + critical_kind + "largest_gap = \"0.2 cm\"\nconfirm = false\ngaps = \"0, 0.02 cm\"\n" +
         "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
         "fit_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
         "model_form_uncertainty = { value = \"1 K\", because = \"for a test\" }\n"
         "accept = [{ key = \"calibration.interfaces\", value = \"base sliding, friction 0; nose sliding, "
         "friction 0; wall sliding, friction 0\", because = \"a synthetic launch\" }]\n" +
         vary({{"peak_pressure", peaks}, {"crack_radius", "10, 100 um"}}) + synthetic_constants;
}

run::MechanicsResult launch_under(const scene::Scene& scene) {
  return synthetic_mechanics(scene, 100.0 * std::pow(scene.load.peak / 496e6, 3.0));
}

StudyOptions options_of(std::function<run::MechanicsResult(const scene::Scene&)> launch) {
  StudyOptions options = synthetic_options();
  options.runners.mechanics = [launch](const scene::Scene& scene, const run::RunOptions&) {
    return launch(scene);
  };
  return options;
}

StudyOptions counted(std::atomic<int>& launches) {
  return options_of([&launches](const scene::Scene& scene) {
    ++launches;
    return launch_under(scene);
  });
}

TEST(RaisedLoad, IsBetweenTheCaseAndTheNextPressureBesideTheOneBefore) {
  const StudyFile study = lean_study_of(sweep_text("400, 430, 450, 460, 600 MPa"));
  ASSERT_EQ(study.cases.size(), 10u);
  // 430 is 7.5 % above 400. The third of the first case lies above both.
  const auto first = neighbouring_loads(study, 1);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->above, 3u);
  EXPECT_EQ(first->beside, 5u);
  EXPECT_EQ(first->own_peak, 400e6);
  const auto second = neighbouring_loads(study, 2);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->above, 4u);
  EXPECT_EQ(second->beside, 0u);
  EXPECT_EQ(second->beside_peak, 400e6);
  EXPECT_FALSE(neighbouring_loads(study, 4)) << "460 is too near, and 600 too far";
  EXPECT_FALSE(neighbouring_loads(study, 8));
  EXPECT_FALSE(neighbouring_loads(lean_study_of(sweep_text("400, 430, 450 MPa", "")), 0));
}

TEST(RaisedLoad, OfACaseWithASceneOfItsOwnIsLaunched) {
  StudyFile study = lean_study_of(sweep_text("400, 430, 460 MPa"));
  change_case(study, 2, [](StudyCase& changed) { changed.scene.scene.initial_temperature += 1.0; });
  EXPECT_FALSE(neighbouring_loads(study, 0)) << "its neighbour differs in more than the pressure";
  EXPECT_FALSE(neighbouring_loads(study, 2));
  EXPECT_TRUE(neighbouring_loads(study, 1));
}

/// Each case is launched once, and those of the highest pressure once more. No bound is further from ignition
/// than with launches of their own, and none is nearer by more than a twentieth of the critical gap.
TEST(RaisedLoad, InterpolatedCostsNoLaunchAndIsNoLessUncertain) {
  const std::string peaks = "400, 420, 440, 462, 485, 509 MPa";
  std::atomic<int> few{0}, many{0};
  const auto between = run_critical_gap(lean_study_of(sweep_text(peaks)), counted(few)).answers;
  const auto launched = run_critical_gap(lean_study_of(sweep_text(peaks, "")), counted(many)).answers;
  EXPECT_EQ(few, 14);
  EXPECT_EQ(many, 24);
  ASSERT_EQ(between.size(), launched.size());
  for (std::size_t i = 0; i < between.size(); ++i) {
    const CriticalGap &one = between[i].critical, &other = launched[i].critical;
    ASSERT_EQ(one.kind, CriticalGapKind::value) << i;
    EXPECT_EQ(one.value, other.value) << i;
    EXPECT_LE(one.bounds.at_least, other.bounds.at_least + 1e-6) << i;
    EXPECT_GE(one.bounds.at_least, other.bounds.at_least - 0.05 * other.value) << i;
    for (std::size_t gap = 0; gap < 2; ++gap)
      EXPECT_GE(between[i].verdicts[gap].uncertainty.input,
                launched[i].verdicts[gap].uncertainty.input - 1e-9)
          << i;
  }
}

TEST(RaisedLoad, InterpolatedIsTheSameWithAnyNumberOfJobsAndInDetail) {
  std::atomic<int> launches{0};
  const StudyFile lean = lean_study_of(sweep_text("450, 475, 500 MPa"));
  StudyFile detailed = lean;
  detailed.study.in_detail = true;
  StudyOptions options = counted(launches);
  const auto one = lines_of(run_critical_gap(lean, options));
  EXPECT_EQ(launches, 8);
  options.jobs = 4;
  EXPECT_EQ(lines_of(run_critical_gap(lean, options)), one);
  EXPECT_EQ(lines_of(run_critical_gap(detailed, options)), one);
}

using StoredRaisedLoad = StoredSweep;

/// What is stored is used again, and not where other pressures stand beside a case.
TEST_F(StoredRaisedLoad, IsThatOfTheSameNeighbours) {
  Counting counting;
  counting.outcome = launch_under;
  const auto answers_over = [&](const std::string& peaks) {
    return run(lean_study_of(sweep_text(peaks)), counting).answers;
  };
  const auto before = answers_over("400, 440, 480 MPa");
  EXPECT_EQ(counting.runs(), 8);
  const auto again = answers_over("400, 440, 480 MPa");
  EXPECT_EQ(counting.runs(), 8);
  EXPECT_EQ(again[2].critical.bounds.at_least, before[2].critical.bounds.at_least);
  const auto other = answers_over("400, 420, 440, 460, 480 MPa");
  EXPECT_EQ(counting.runs(), 12) << "those of the two pressures that are new";
  EXPECT_EQ(other[4].critical.value, before[2].critical.value);
  EXPECT_GT(other[4].critical.bounds.at_least, before[2].critical.bounds.at_least) << "nearer neighbours";
}

TEST(RaisedLoad, OfANeighbourThatBrokeOffIsNotKnown) {
  const StudyOptions options = options_of([](const scene::Scene& scene) {
    run::MechanicsResult result = launch_under(scene);
    if (scene.load.peak == 490e6) result.status = run::RunStatus::energy_drift;
    return result;
  });
  const auto answers =
      run_critical_gap(lean_study_of(sweep_text("400, 430, 460, 490, 520 MPa")), options).answers;
  // 400 and 430 rest on 400, 430 and 460, and 520 on launches of its own.
  for (const std::size_t i : {0u, 2u, 8u}) EXPECT_EQ(answers[i].critical.kind, CriticalGapKind::value) << i;
  for (const std::size_t i : {4u, 6u})
    EXPECT_EQ(answers[i].critical.kind, CriticalGapKind::indeterminate) << i;
  EXPECT_FALSE(answers[4].validity_warnings.empty());
}

TEST(RaisedLoad, OfLaunchesThatEndAtOtherTimesFails) {
  const StudyOptions options = options_of([](const scene::Scene& scene) {
    run::MechanicsResult result = launch_under(scene);
    if (scene.load.peak == 440e6) result.trace = trace::until(result.trace, 9e-3);
    return result;
  });
  const auto answers = run_critical_gap(lean_study_of(sweep_text("400, 440, 480 MPa")), options).answers;
  EXPECT_NE(answers[0].failure.find("end at other times"), std::string::npos) << answers[0].failure;
  EXPECT_EQ(answers[0].critical.kind, CriticalGapKind::indeterminate);
}

TEST(RaisedLoad, InterpolatedWhereThatCannotBeIsAFault) {
  const auto fault = [](const std::string& text) {
    const auto study = parse_here(text);
    return study ? "none" : study.error().message();
  };
  EXPECT_NE(fault(sweep_text("400, 496 MPa")).find("no case with two neighbours"), std::string::npos);
  EXPECT_NE(fault(interpolated + critical_kind).find("at least three peak pressures"), std::string::npos);
  const std::string stated = "input_uncertainty = { value = \"1 K\", because = \"for a test\" }\n";
  EXPECT_NE(fault(stated + sweep_text("400, 420, 440 MPa")).find("one of the two"), std::string::npos);
  const std::string travel = "load.muzzle_travel = \"5.26 m\"\n";
  EXPECT_NE(fault(sweep_text("400, 420, 440 MPa") + travel).find("muzzle_travel"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::study

// The search for the gap that ignites where it closes, on launches that a closed form stands for.
#include "launchsafe/study/closing_gaps.hpp"

#include "launchsafe/scene/selective_inertia.hpp"
#include "synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace launchsafe::study {
namespace {

using scene::GapBase;

struct Launch {
  double gap;  ///< m
  scene::Surface surface;
};

/// K by launch; NaN: it did not end.
using Temperature = std::function<double(const Launch&)>;
constexpr double ignition = 525.0;

StudyFile closing_study() {
  StudyFile study = lean_study_of(critical_text +
                                  "gaps = \"0, 0.02 cm\"\nlargest_gap = \"0.08 cm\"\n"
                                  "tolerance = \"0.001 cm\"\n[set]\ngap.model = \"closing\"\n"
                                  "gap.roughness = \"10 um\"\n"
                                  "interface.base.condition = \"sliding\"\n"
                                  "interface.base.friction = 0\n");
  EXPECT_TRUE(study.cases.front().closing.has_value());
  return study;
}

std::vector<ClosingAnswer> answers_of(const Temperature& temperature) {
  const StudyFile study = closing_study();
  const RunBatch run = [&](std::vector<CaseRun> runs) {
    std::vector<FinishedRun> finished;
    for (const CaseRun& each : runs) {
      FinishedRun& one = finished.emplace_back();
      one.outcome = RunOutcome::ran;
      one.hash = each.hash;
      one.result.mechanics = synthetic_mechanics(each.scene);
      const double kelvin = temperature({*each.skin_gap, each.scene.surface});
      run::GapResult& gap = one.result.gaps.emplace_back();
      gap.gap = *each.skin_gap;
      gap.at_stations.temperature = kelvin;
      if (kelvin >= ignition) gap.skin.ignition = surface::Ignition{};
      if (std::isnan(kelvin)) one.failure = "energy drift";
    }
    return finished;
  };
  return find_closing_gaps(study.study, study.cases.front(), run);
}

TEST(ClosingGaps, TheCaseHasTheReservoirBesideThem) {
  const StudyFile study = closing_study();
  EXPECT_EQ(study.scene.scene.surface.model, scene::GapModel::closing);
  EXPECT_EQ(study.cases.front().scene.scene.surface.model, scene::GapModel::reservoir);
  EXPECT_DOUBLE_EQ(study.cases.front().closing->roughness, 1e-5);
}

TEST(ClosingGaps, BracketsTheSmallestThatIgnites) {
  const auto answers = answers_of([](const Launch& launch) {
    return launch.gap > (launch.surface.base == GapBase::insulated ? 5e-4 : 6.3e-4) ? 600.0 : 400.0;
  });
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0].name, "conducting");
  EXPECT_LE(answers[0].upper - answers[0].lower, 1e-5);
  EXPECT_LE(answers[0].lower, 6.3e-4);
  EXPECT_GT(answers[0].upper, 6.3e-4);
  EXPECT_GT(answers[1].upper, 5e-4);
  EXPECT_LE(answers[1].lower, 5e-4);
}

TEST(ClosingGaps, AWiderGapThatDoesNotIgniteDoesNotHideAThinnerOneThatDoes) {
  const auto answers = answers_of(
      [](const Launch& launch) { return launch.gap > 1.5e-4 && launch.gap < 2.5e-4 ? 600.0 : 400.0; });
  EXPECT_NEAR(answers[0].upper, 1.5e-4, 1e-5);
  EXPECT_FALSE(answers[0].at(8e-4)->ignited);
  EXPECT_TRUE(closing_evidence(answers, 8e-4, ignition).ignited);
  EXPECT_FALSE(closing_evidence(answers, 1e-4, ignition).ignited);
  EXPECT_FALSE(closing_evidence(answers, 8.1e-4, ignition).known);  // it was not computed
}

TEST(ClosingGaps, TheHottestReleaseAndTheSmoothestFacesAreTheCorner) {
  const auto answers = answers_of([](const Launch& launch) {
    EXPECT_TRUE(launch.surface.roughness == 1e-5 || launch.surface.roughness == 1e-6);
    const bool smooth = launch.surface.roughness < 5e-6;
    return 400.0 + (smooth ? 20.0 : 0.0) + 5e3 * launch.surface.release;
  });
  const ClosingPoint* point = answers.back().at(2e-4);
  ASSERT_NE(point, nullptr);
  const StudyFile study = closing_study();
  const double peak_time = scene::PressureHistory(study.scene.scene.load).peak_time();
  EXPECT_NEAR(point->release, peak_time, 1e-3 * peak_time);
  EXPECT_NEAR(point->maximum_temperature, 420.0 + 5e3 * peak_time, 0.1);
  const ClosingEvidence evidence = closing_evidence(answers, 2e-4, ignition);
  EXPECT_TRUE(evidence.known);
  EXPECT_FALSE(evidence.ignited);
  EXPECT_NEAR(evidence.corner_margin, ignition - point->maximum_temperature, 1e-9);
}

TEST(ClosingGaps, TheCornerLetsGoAsFastAsSoundOrFaster) {
  StudyCase input = closing_study().cases.front();
  const double passage = scene::transit_time(input.scene.scene);
  const auto duration = [&](std::optional<double> own, std::size_t bound) {
    input.closing->release_duration = own;
    return closing_bounds(input)[bound].terms.front().release_duration;
  };
  EXPECT_FALSE(duration(std::nullopt, 2).has_value());
  EXPECT_FALSE(duration(2.0 * passage, 2).has_value());
  EXPECT_EQ(duration(2.0 * passage, 0), 2.0 * passage);
  EXPECT_EQ(duration(0.5 * passage, 2), 0.5 * passage);
}

TEST(ClosingGaps, OneReleaseThatIsNotKnownLeavesTheCornerUnknown) {
  const auto answers = answers_of([](const Launch& launch) {
    const bool corner = launch.surface.roughness < 5e-6;
    return corner && launch.surface.release > 5e-3 && launch.surface.release < 9e-3
               ? std::numeric_limits<double>::quiet_NaN()
               : 400.0;
  });
  EXPECT_TRUE(std::isnan(answers.back().upper));
  EXPECT_FALSE(closing_evidence(answers, 2e-4, ignition).known);
  EXPECT_TRUE(std::isinf(answers.front().upper));
}

TEST(ClosingGaps, ALaunchThatSomethingWarnsOfLeavesItsGapUnknown) {
  const StudyFile study = closing_study();
  const RunBatch run = [](const std::vector<CaseRun>& runs) {
    std::vector<FinishedRun> finished(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      finished[i].outcome = RunOutcome::ran;  // of a launch without a history
      finished[i].result.gaps.emplace_back().at_stations.temperature = 400.0;
    }
    return finished;
  };
  const auto answers = find_closing_gaps(study.study, study.cases.front(), run);
  EXPECT_FALSE(closing_evidence(answers, 2e-4, ignition).known);
}

TEST(ClosingGaps, AThinnerGapThatIsNotKnownLeavesAThickerOneUnknown) {
  const auto answers = answers_of([](const Launch& launch) {
    return launch.gap > 0.9e-4 && launch.gap < 1.1e-4 ? std::numeric_limits<double>::quiet_NaN() : 400.0;
  });
  EXPECT_TRUE(closing_evidence(answers, 0.0, ignition).known);
  EXPECT_FALSE(closing_evidence(answers, 2e-4, ignition).known);
}

TEST(ClosingGaps, OfAChargeThatABondHoldsTheCornerIsNotKnown) {
  const StudyFile study = closing_study();
  StudyCase held = study.cases.front();
  for (scene::Interface& faces : held.scene.scene.interfaces)
    if (faces.body == "wall")
      faces = {.body = "wall",
               .condition = scene::Condition::bonded,
               .friction = 0.0,
               .tension_strength = 1e12,
               .shear_strength = 1e12};
  EXPECT_TRUE(closing_bounds(study.cases.front()).back().unknown_for.empty());
  EXPECT_NE(closing_bounds(held).back().unknown_for.find("bonded to \"wall\""), std::string::npos);
  const auto answers = find_closing_gaps(study.study, held, [](const std::vector<CaseRun>& runs) {
    std::vector<FinishedRun> finished(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      finished[i].outcome = RunOutcome::ran;
      finished[i].result.mechanics = synthetic_mechanics(runs[i].scene);
      finished[i].result.gaps.emplace_back().at_stations.temperature = 400.0;
    }
    return finished;
  });
  EXPECT_TRUE(answers.back().at(2e-4) != nullptr);
  EXPECT_FALSE(closing_evidence(answers, 2e-4, ignition).known);
}

TEST(ClosingGaps, WithoutAnswersNothingIsKnown) { EXPECT_FALSE(closing_evidence({}, 0.0, ignition).known); }

TEST(ClosingGaps, AreRefusedInKindsThatDoNotJudgeThem) {
  const auto study =
      parse_here("kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\n" + synthetic_statements +
                 "[set]\ngap.model = \"closing\"\ninterface.base.condition = \"sliding\"\n"
                 "interface.base.friction = 0\n");
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().key, "set.gap.model") << study.error().message();
}

}  // namespace
}  // namespace launchsafe::study

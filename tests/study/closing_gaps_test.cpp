// The search for the gap that ignites where it closes, on launches that a closed form stands for.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"
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

StudyFile closing_study(bool in_detail = true) {
  StudyFile study = lean_study_of(critical_text +
                                  "gaps = \"0, 0.02 cm\"\nlargest_gap = \"0.08 cm\"\n"
                                  "tolerance = \"0.001 cm\"\n[set]\ngap.model = \"closing\"\n"
                                  "gap.roughness = \"10 um\"\n"
                                  "interface.base.condition = \"sliding\"\n"
                                  "interface.base.friction = 0\n");
  EXPECT_TRUE(study.cases.front().closing.has_value());
  study.study.in_detail = in_detail;
  return study;
}

FinishedRun launch_of(const CaseRun& asked, double kelvin) {
  FinishedRun run{.outcome = RunOutcome::ran, .failure = {}, .result = {}, .hash = asked.hash};
  run.result.mechanics = synthetic_mechanics(asked.scene);
  run::GapResult& gap = run.result.gaps.emplace_back();
  gap.gap = *asked.skin_gap;
  gap.at_stations.temperature = kelvin;
  if (kelvin >= ignition) gap.skin.ignition = surface::Ignition{};
  return run;
}

/// What the launches that `finish` makes say of the only case.
template <class Finish>
std::vector<ClosingAnswer> answers_of(const StudyFile& study, Finish finish) {
  return find_closing_gaps(study, {0},
                           [&](const std::vector<PlannedRun>& runs, std::ptrdiff_t, const auto& take) {
                             for (std::size_t i = 0; i < runs.size(); ++i) take(i, finish(runs[i].make()));
                           })
      .front();
}

std::vector<ClosingAnswer> answers_of(const Temperature& temperature, bool in_detail = true) {
  return answers_of(closing_study(in_detail), [&](const CaseRun& asked) {
    const double kelvin = temperature({*asked.skin_gap, asked.scene.surface});
    FinishedRun run = launch_of(asked, kelvin);
    if (std::isnan(kelvin)) run.failure = "energy drift";
    return run;
  });
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
  ASSERT_EQ(answers.size(), 6u);
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
  const StudyFile study = closing_study();
  const double peak_time = scene::PressureHistory(study.scene.scene.load).peak_time();
  const auto answers = answers_of([peak_time](const Launch& launch) {
    EXPECT_TRUE(launch.surface.roughness == 1e-5 || launch.surface.roughness == 1e-6);
    const bool smooth = launch.surface.roughness<5e-6, after_peak = launch.surface.release> peak_time;
    return 400.0 + (smooth ? 20.0 : 0.0) + (after_peak ? 0.0 : 5e3 * launch.surface.release);
  });
  const ClosingPoint* point = answers.back().at(2e-4);
  ASSERT_NE(point, nullptr);
  EXPECT_NEAR(point->release, peak_time, 1e-3 * peak_time);
  EXPECT_NEAR(point->maximum_temperature, 420.0 + 5e3 * peak_time, 0.1);
  // Without a gap faces are nothing, and how the charge was held is what it is.
  ASSERT_NE(answers.back().at(0.0), nullptr);
  EXPECT_NEAR(answers.back().at(0.0)->maximum_temperature, 400.0 + 5e3 * peak_time, 0.1);
  const ClosingEvidence evidence = closing_evidence(answers, 2e-4, ignition);
  EXPECT_TRUE(evidence.known);
  EXPECT_FALSE(evidence.ignited);
  EXPECT_NEAR(evidence.corner_margin, ignition - point->maximum_temperature, 1e-9);
}

TEST(ClosingGaps, WithoutARecordOfThemNoLessIsUncertainThanIsAssumed) {
  const auto answers = answers_of([](const Launch& launch) { return 400.0 + 1e5 * launch.gap; });
  for (const ClosingAnswer& answer : answers) {
    EXPECT_FALSE(answer.at(2e-4)->recorded);
    EXPECT_NEAR(answer.at(2e-4)->at_most, answer.at(2e-4)->maximum_temperature + 60.0, 1e-9);
  }
  EXPECT_NEAR(closing_evidence(answers, 2e-4, ignition).numerical, assumed_numerical_uncertainty, 1e-9);
}

// A quarter of the second difference, twice what a parabola through the three can have between them.
TEST(ClosingGaps, HowHotAnInstantBetweenTwoReleasesMayBeIsUncertain) {
  const double peak_time = scene::PressureHistory(closing_study().scene.scene.load).peak_time();
  const auto answers = answers_of([peak_time](const Launch& launch) {
    return std::abs(launch.surface.release - peak_time) < 1e-3 * peak_time ? 430.0 : 400.0;
  });
  const ClosingPoint* point = answers.back().at(2e-4);
  ASSERT_NE(point, nullptr);
  EXPECT_NEAR(point->at_most, 430.0 + assumed_numerical_uncertainty + 0.25 * (2.0 * 430.0 - 2.0 * 400.0),
              1e-9);
}

TEST(ClosingGaps, WhatIsNotOfTheNumericsGrowsWithTheHeatOfTheCorner) {
  const auto answers =
      answers_of([](const Launch& launch) { return launch.surface.roughness < 5e-6 ? 460.0 : 400.0; });
  scene::Scene scene = closing_study().cases.front().scene.scene;
  GapVerdict row;
  row.gap = 2e-4;
  row.uncertainty.fit = 5.0;
  row.maximum.temperature = scene.initial_temperature + 40.0;
  take_closing_evidence(answers, scene, row);
  const double ratio = (460.0 - scene.initial_temperature) / 40.0;
  EXPECT_NEAR(row.closing_uncertainty(), row.closing.numerical + 5.0 * ratio, 1e-9);
  // A corner that is colder than the reservoir has no less.
  row.maximum.temperature = 500.0;
  take_closing_evidence(answers, scene, row);
  EXPECT_NEAR(row.closing_uncertainty(), row.closing.numerical + 5.0, 1e-9);
}

TEST(ClosingGaps, EachBoundHasTheWorstEndOfOneMoreInterval) {
  const auto answers = answers_of([](const Launch& launch) {
    return 400.0 + (launch.surface.base == GapBase::insulated ? 5.0 : 0.0) +
           (launch.surface.roughness < 5e-6 ? 20.0 : 0.0) +
           (launch.surface.air_flow == scene::AirFlow::common_pressure ? 10.0 : 0.0) +
           (launch.surface.release > 0.0 ? 30.0 : 0.0) - (launch.surface.melts ? 7.0 : 0.0);
  });
  std::vector<std::pair<std::string, double>> found;
  for (const ClosingAnswer& answer : answers)
    found.emplace_back(answer.name, answer.at(2e-4)->maximum_temperature);
  EXPECT_EQ(found, (std::vector<std::pair<std::string, double>>{{"conducting", 400.0},
                                                                {"insulated", 405.0},
                                                                {"melting", 398.0},
                                                                {"smooth", 425.0},
                                                                {"flowing", 435.0},
                                                                {"corner", 465.0}}));
}

TEST(ClosingGaps, AirThatStaysCountsWhereItIsHotterThanAirThatFlows) {
  const auto answers = answers_of([](const Launch& launch) {
    return launch.surface.air_flow == scene::AirFlow::common_pressure ? 400.0 : 430.0;
  });
  EXPECT_EQ(answers.back().name, "corner");
  EXPECT_EQ(answers.back().at(2e-4)->maximum_temperature, 430.0);
}

TEST(ClosingGaps, WhatIgnitesWithAirThatStaysIsNotLaunchedWithAirThatFlows) {
  std::size_t flowing = 0;
  const auto answers = answers_of([&](const Launch& launch) {
    flowing += launch.surface.air_flow == scene::AirFlow::common_pressure;
    return launch.surface.roughness < 5e-6 && launch.gap > 1.5e-4 ? 600.0 : 400.0;
  });
  EXPECT_TRUE(answers.back().at(2e-4)->ignited);
  EXPECT_FALSE(answers.back().at(1e-4)->ignited);
  // The corner's eight instants of release at 0.1 mm and where the bracket was narrowed down to from below.
  const auto below = std::ranges::count_if(
      answers.back().points, [](const ClosingPoint& point) { return point.gap > 0.0 && !point.ignited; });
  EXPECT_EQ(flowing, 8u * static_cast<std::size_t>(below));
}

TEST(ClosingGaps, ABoundThatIsHotterThanTheCornerCountsInItsPlace) {
  const auto answers =
      answers_of([](const Launch& launch) { return launch.surface.roughness < 5e-6 ? 400.0 : 430.0; });
  EXPECT_NEAR(closing_evidence(answers, 2e-4, ignition).corner_margin, ignition - 430.0, 1e-9);
}

TEST(ClosingGaps, NeitherMeltingNorSmoothFacesAloneDecide) {
  // A charge that melts may ignite or not be known: what counts is the charge that does not.
  const auto answers = answers_of([](const Launch& launch) {
    if (launch.gap > 0.0 && launch.surface.melts) return std::nan("");
    return 400.0;
  });
  const ClosingEvidence evidence = closing_evidence(answers, 2e-4, ignition);
  EXPECT_TRUE(evidence.known);
  EXPECT_NEAR(evidence.corner_margin, ignition - 400.0, 1e-9);
  // Nor does a case that says its charge melts have bounds on which it does.
  StudyCase input = closing_study().cases.front();
  input.closing->melts = true;
  for (const ClosingBound& bound : closing_bounds(input))
    for (const ClosingTerms& terms : bound.terms) EXPECT_EQ(terms.surface.melts, bound.name == "melting");
}

std::vector<std::string> kinetics_names(const std::function<void(materials::KineticsParameters&)>& change) {
  scene::Scene scene = closing_study().cases.front().scene.scene;
  change(scene.charge().kinetics);
  std::vector<std::string> names;
  for (const auto& each : kinetics_of(scene)) {
    EXPECT_EQ(each.ignition_temperature, scene.charge().kinetics.ignition_temperature);
    names.push_back(each.name);
  }
  return names;
}

TEST(ClosingGaps, IgniteByWhicheverKineticsComesFirst) {
  using Names = std::vector<std::string>;
  // The calibrated ones heat at least 80 times faster than those whose numbers belong together.
  EXPECT_EQ(kinetics_names([](auto&) {}), Names{"comp-b"});
  // As printed they are outdone: 1.17e25 exp(-27000/T) is below 1.47e23 exp(-21689/T) up to 1212 K.
  EXPECT_EQ(kinetics_names([](auto& own) { own.activation_temperature = 27000.0; }),
            Names{"comp-b-consistent"});
  // At 300 K one is faster, at T1 the other: both count. Their rates are equal where
  // ln(ratio of Q Z) = 4311 K/T, at 400 K.
  EXPECT_EQ(kinetics_names([](auto& own) {
              own.activation_temperature = 26000.0;
              own.frequency = 4.62e16 * std::exp(4311.0 / 400.0) * 3.171472e6 / own.heat_of_reaction;
            }),
            (Names{"comp-b", "comp-b-consistent"}));
}

TEST(ClosingGaps, LaunchesHaveTheKineticsThatCount) {
  StudyFile study = closing_study();
  change_case(study, 0,
              [](StudyCase& input) { input.scene.scene.charge().kinetics.activation_temperature = 27000.0; });
  answers_of(study, [](const CaseRun& asked) {
    EXPECT_NEAR(asked.scene.charge().kinetics.activation_temperature, 21688.76, 0.01);
    return launch_of(asked, 400.0);
  });
}

TEST(ClosingGaps, TheLaunchWithoutAGapIsMadeOnceForEachInstantOfRelease) {
  std::size_t without = 0;
  const auto answers = answers_of(closing_study(), [&](const CaseRun& asked) {
    if (*asked.skin_gap == 0.0) ++without;
    return launch_of(asked, *asked.skin_gap == 0.0 ? 410.0 : 400.0);
  });
  EXPECT_EQ(without, 8u);  // from the start, at six shares of the peak, and after it
  for (const ClosingAnswer& answer : answers) EXPECT_EQ(answer.at(0.0)->maximum_temperature, 410.0);
}

TEST(ClosingGaps, TheCornerLetsGoAsFastAsSoundOrFaster) {
  StudyCase input = closing_study().cases.front();
  const double passage = scene::transit_time(input.scene.scene);
  const auto duration = [&](std::optional<double> own, std::size_t bound) {
    input.closing->release_duration = own;
    return closing_bounds(input)[bound].terms.front().surface.release_duration;
  };
  EXPECT_EQ(closing_bounds(input)[2].name, "melting");
  for (const std::size_t smooth : {std::size_t{3}, std::size_t{4}, std::size_t{5}}) {
    EXPECT_FALSE(duration(std::nullopt, smooth).has_value());
    EXPECT_FALSE(duration(2.0 * passage, smooth).has_value());
    EXPECT_EQ(duration(0.5 * passage, smooth), 0.5 * passage);
  }
  EXPECT_EQ(duration(2.0 * passage, 0), 2.0 * passage);
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

TEST(ClosingGaps, ALaunchThatIgnitesIsToldBesideOnesThatAreNotKnown) {
  const auto answers = answers_of([](const Launch& launch) {
    if (launch.surface.roughness > 5e-6 || launch.gap < 1.5e-4) return 400.0;
    return launch.surface.release < 9e-3 ? std::numeric_limits<double>::quiet_NaN() : 600.0;
  });
  const ClosingPoint& corner = *answers.back().at(2e-4);
  EXPECT_TRUE(corner.ignited);
  EXPECT_EQ(corner.maximum_temperature, 600.0);
  EXPECT_EQ(corner.unknown_for, "");
}

TEST(ClosingGaps, ALaunchThatSomethingWarnsOfLeavesItsGapUnknown) {
  const auto answers = answers_of(closing_study(), [](const CaseRun& asked) {
    FinishedRun run = launch_of(asked, 400.0);
    run.result.mechanics = {};  // of a launch without a history
    return run;
  });
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
  StudyFile study = closing_study();
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
  study.cases.replace(0, held);
  const auto answers = answers_of(study, [](const CaseRun& asked) { return launch_of(asked, 400.0); });
  EXPECT_TRUE(answers.back().at(2e-4) != nullptr);
  EXPECT_FALSE(closing_evidence(answers, 2e-4, ignition).known);
}

TEST(ClosingGaps, OfAGapThatOpensByCoolingTheCornerIsNotKnown) {
  StudyCase input = closing_study().cases.front();
  input.scene.scene.surface.opens_by_cooling = 317.0;
  EXPECT_NE(closing_bounds(input).back().unknown_for.find("cooling"), std::string::npos);
  // Its launches are those of gaps that are stated.
  EXPECT_EQ(skin_run(closing_scene(input), 2e-4, {}).hash,
            skin_run(closing_scene(closing_study().cases.front()), 2e-4, {}).hash);
}

// Those of earlier programs are not used again: their steps were not centred where a face meets another, and
// a charge without a gap was held by nothing.
TEST(ClosingGaps, ALaunchIsStoredAsAKindOfItsOwn) {
  const StudyCase input = closing_study().cases.front();
  EXPECT_NE(identity_of(skin_run(closing_scene(input), 2e-4, {}))
                .input()
                .find(", coupled run where the gap closes\n"),
            std::string::npos);
  EXPECT_NE(identity_of(skin_run(input.scene.scene, 2e-4, {})).input().find(", coupled run\n"),
            std::string::npos);
}

TEST(ClosingGaps, OfManyCasesEndTheScanAtTheFirstThatIgnitesAndHaveNoCorner) {
  const auto answers =
      answers_of([](const Launch& launch) { return launch.gap > 2.5e-4 ? 600.0 : 400.0; }, false);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_NEAR(answers[0].upper, 2.5e-4, 1e-5);
  // 0 and 0.2 mm do not ignite, 0.8 mm does, and six halvings of 0.6 mm come to less than 0.01 mm.
  EXPECT_EQ(answers[0].points.size(), 9u);
  EXPECT_EQ(answers[0].at(1e-4), nullptr);
  const ClosingEvidence below = closing_evidence(answers, 2e-4, ignition),
                        above = closing_evidence(answers, 8e-4, ignition);
  EXPECT_TRUE(below.known);
  EXPECT_FALSE(below.ignited);
  EXPECT_TRUE(std::isnan(below.corner_margin));
  EXPECT_TRUE(above.ignited);
}

TEST(ClosingGaps, OfManyCasesTellUpToWhichGapTheyAreKnown) {
  const auto answers = answers_of(
      [](const Launch& launch) {
        return launch.gap > 2.5e-4 ? std::numeric_limits<double>::quiet_NaN() : 400.0;
      },
      false);
  EXPECT_DOUBLE_EQ(answers[1].lower, 2e-4);
  EXPECT_TRUE(std::isnan(answers[1].upper));
  EXPECT_TRUE(closing_evidence(answers, 2e-4, ignition).known);
  EXPECT_FALSE(closing_evidence(answers, 8e-4, ignition).known);
}

TEST(ClosingGaps, NoMoreLaunchesAreAskedForThanIsSaidBefore) {
  for (const bool in_detail : {true, false}) {
    const StudyFile study = closing_study(in_detail);
    std::size_t launches = 0;
    answers_of(study, [&](const CaseRun& asked) {
      ++launches;
      return launch_of(asked, *asked.skin_gap > 7.99e-4 ? 600.0 : 400.0);
    });
    const std::size_t most = most_closing_launches(study.study, study.cases.front());
    EXPECT_LE(launches, most) << in_detail;
    // Beyond 0.799 mm none with air that flows, on five instants of release.
    EXPECT_GE(launches + 5 * 4, most) << in_detail;
  }
}

TEST(ClosingGaps, WithoutAnswersNothingIsKnown) { EXPECT_FALSE(closing_evidence({}, 0.0, ignition).known); }

TEST(ClosingGaps, AreRefusedInKindsThatDoNotJudgeThem) {
  const auto study = parse_here(
      "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n"
      "[set]\ngap.model = \"closing\"\ninterface.base.condition = \"sliding\"\n"
      "interface.base.friction = 0\n");
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().key, "set.gap.model") << study.error().message();
}

}  // namespace
}  // namespace launchsafe::study

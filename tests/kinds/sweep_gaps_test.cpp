// Sweeps whose gaps close, or open by cooling.
#include "made_sweeps.hpp"

namespace launchsafe::study {
namespace {

using namespace kinds;

/// A sweep of two pressures whose charge may part from its base.
StudyFile parting_sweep_of(const std::string& keys) {
  return sweep_of("0, 0.01, 0.02 cm", {{"peak_pressure", "400, 496 MPa"}}, "0.08 cm",
                  "interface.base.condition = \"sliding\"\ninterface.base.friction = 0\n"
                  "numerics.selective_inertia = 2\n" +
                      keys);
}
const std::string closes = "gap.model = \"closing\"\n";

/// The synthetic launch, in which gaps that `ignites` says do so where they close, and others stay at 420 K.
StudyOptions closing_options(Counting& counting,
                             std::function<bool(const scene::Scene& scene, double gap)> ignites) {
  StudyOptions options = counting.options();
  options.runners.with_skin = [ignites](const scene::Scene& scene, double gap, const run::RunOptions&) {
    run::CaseResult result;
    result.mechanics = synthetic_mechanics(scene);
    run::GapResult& closed = result.gaps.emplace_back();
    closed.gap = gap;
    closed.at_stations.temperature = 420.0;
    if (ignites(scene, gap)) closed.skin.ignition = surface::Ignition{};
    return result;
  };
  return options;
}

std::size_t count_of(const CriticalGapResult& result, Verdict verdict) {
  std::size_t count = 0;
  for (const CaseAnswer& answer : result.answers)
    count += static_cast<std::size_t>(std::ranges::count_if(
        answer.verdicts, [verdict](const GapVerdict& row) { return row.judgement.verdict == verdict; }));
  return count;
}

const std::string cools = "gap.opens_by_cooling = \"317 K\"\n";

TEST(Sweep, IsJudgedAtTheGapThatCoolingOpensInEachCase) {
  Counting counting;
  const StudyFile study = sweep_of("", {{"initial_temperature", "309, 315, 335 K"}}, "0.2 cm", cools);
  const CriticalGapResult result = run_critical_gap(study, counting.options());
  const std::vector<double> gaps{24.024e-6 * 8.0, 24.024e-6 * 2.0, 0.0};  // m
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const CaseAnswer& answer = result.answers[i];
    ASSERT_EQ(answer.verdicts.size(), 1u);
    EXPECT_NEAR(answer.verdicts[0].gap, gaps[i], 1e-12);
    // By 12 K, as the initial temperature is known, and a quarter; charge and shell at 335 K stay in touch.
    const double further = i < 2 ? 1.25 * (gaps[i] + 24.024e-6 * 12.0) - gaps[i] : 0.0;
    const auto share = std::ranges::find(answer.critical.shares, ShareKind::cooling, &GapShare::kind);
    ASSERT_EQ(share != answer.critical.shares.end(), i < 2);
    if (i < 2) {
      EXPECT_NEAR(move_towards_ignition(answer.critical.lower, *share),
                  std::min(further, answer.critical.lower), 2e-6);
    }
  }
  const std::string page = to_markdown(critical_gap_table(result));
  EXPECT_NE(page.find("0.0192"), std::string::npos) << page;
  EXPECT_NE(answer(result).find("each judged at the gap that cooling opens"), std::string::npos);
}

TEST(Sweep, WhatCoolingMayOpenFurtherIsTakenFromWhatIsSafe) {
  // The same gaps, stated, are SAFE.
  Counting counting;
  const auto judged = [&](const std::string& gaps, const std::string& more) {
    const StudyFile study = sweep_of(gaps, {{"initial_temperature", "309 K"}}, "0.2 cm", more);
    return run_critical_gap(study, counting.options()).answers[0].verdicts[0];
  };
  const GapVerdict stated = judged("0.0192192 cm", ""), cooled = judged("", cools);
  EXPECT_EQ(stated.judgement.verdict, Verdict::safe) << reason_text(stated);
  EXPECT_EQ(cooled.maximum.temperature, stated.maximum.temperature);
  EXPECT_EQ(cooled.judgement.verdict, Verdict::indeterminate);
  EXPECT_EQ(cooled.judgement.at_least, 0.0);
  EXPECT_GT(cooled.uncertainty.total(), stated.uncertainty.total());
}

TEST(Sweep, VariesTheTemperatureFromWhichAGapOpens) {
  const StudyFile study = sweep_of("", {{"gap.opens_by_cooling", "305, 310 K"}});
  EXPECT_EQ(study.study.gaps.size(), 1u);
  EXPECT_NEAR(gaps_of(study.study, study.cases[1]).front(), 24.024e-6 * 10.0, 1e-12);
}

TEST(Sweep, OfGapsThatOpenByCoolingIsRefusedWhereItCouldNotFollowThem) {
  const auto key_of = [](const std::string& text) {
    const auto study = parse_here(text + "[set]\n" + cools);
    return study ? std::string() : study.error().key;
  };
  EXPECT_EQ(key_of(critical_text + "gaps = \"0 cm\"\n"), "gaps");
  EXPECT_EQ(key_of("kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\n" + synthetic_statements +
                   "vary = [{ key = \"initial_temperature\", distribution = \"uniform\", range = \"290 to "
                   "310 K\" }]\n"),
            "scene");
  EXPECT_EQ(key_of(critical_text + "surrogate = true\n" + vary({{"peak_pressure", "400, 496 MPa"}})),
            "surrogate");
}

TEST(Sweep, WhileItsGapsCloseItsCasesAreCountedUntilTheyAreFound) {
  Counting counting;
  StudyOptions options = closing_options(counting, [](const auto&, double gap) { return gap > 0.0003; });
  std::vector<Progress> told;
  options.progress = [&](const Progress& progress) {
    if (progress.phase == Phase::closing_gaps) told.push_back(progress);
  };
  run_critical_gap(parting_sweep_of(closes), options);
  ASSERT_FALSE(told.empty());
  for (const Progress& each : told) EXPECT_EQ(each.cases, 2u);
  EXPECT_EQ(told.front().cases_done, 0u);
  EXPECT_EQ(told.back().cases_done, 2u);
  EXPECT_EQ(told.back().cases_failed, 0u);
}

// What has to be done is known from the start, but for what need not be: a share that was reached is not left
// again, and nothing is complete before the last launch. Costs of launches on other terms differ by a
// percent.
TEST(Sweep, ItsProgressCoversTheGapsThatClose) {
  Counting counting;
  StudyOptions options = closing_options(counting, [](const auto&, double gap) { return gap > 0.0003; });
  options.jobs = 1;
  std::vector<Progress> told;
  options.progress = [&](const Progress& progress) { told.push_back(progress); };
  run_critical_gap(parting_sweep_of(closes), options);
  ASSERT_GT(told.size(), 10u);
  EXPECT_EQ(told.front().phase, Phase::launches);
  EXPECT_EQ(told.back().done, told.back().total);
  double reached = 0.0;
  for (const Progress& each : told) {
    EXPECT_GE(each.fraction, reached - 0.01);
    reached = std::max(reached, each.fraction);
  }
  EXPECT_TRUE(std::ranges::is_partitioned(told, [](const Progress& each) { return each.done < each.total; }));
}

// The worst corner of how a gap closes is not computed in a sweep, whatever is stored of the reservoir.
TEST_F(StoredSweep, IsSafeNowhereWhereItsGapsClose) {
  Counting counting;
  EXPECT_GT(count_of(run(parting_sweep_of(""), counting), Verdict::safe), 0u);
  auto store = store::CaseStore::open(folder() / "results");
  ASSERT_TRUE(store);
  StudyOptions options = closing_options(counting, [](const auto&, double) { return false; });
  options.store = store->get();
  const CriticalGapResult result = run_critical_gap(parting_sweep_of(closes), options);
  EXPECT_EQ(counting.runs(), 2);
  EXPECT_EQ(count_of(result, Verdict::safe), 0u);
  EXPECT_EQ(result.answers[0].verdicts[0].judgement.code, ReasonCode::closing_without_corner);
  EXPECT_NE(answer(result).find("0 SAFE"), std::string::npos) << answer(result);
  const std::string page = to_markdown(critical_gap_table(result));
  EXPECT_NE(page.find("closing, base conducts"), std::string::npos) << page;
  EXPECT_NE(page.find("> 0.08 cm"), std::string::npos) << page;
}

TEST(Sweep, IsUnsafeWhereAGapIgnitesThatCloses) {
  Counting counting;
  // Only a base that takes no heat, at the higher pressure.
  const CriticalGapResult result = run_critical_gap(
      parting_sweep_of(closes), closing_options(counting, [](const auto& scene, double gap) {
        return gap > 1.5e-4 && scene.load.peak > 450e6 && scene.surface.base == scene::GapBase::insulated;
      }));
  EXPECT_EQ(count_of(result, Verdict::unsafe), 1u);
  EXPECT_EQ(result.answers[1].verdicts[2].judgement.code, ReasonCode::closing_ignition);
  EXPECT_NEAR(result.answers[1].closing[1].upper, 1.5e-4, 2e-5);
  EXPECT_NE(answer(result).find("the base takes none: ignition in 1 case, from 0.015"), std::string::npos)
      << answer(result);
}

TEST(Sweep, HasNoSurrogateWhereItsGapsClose) {
  const auto study =
      parse_here(critical_text + "surrogate = true\n" + vary({{"peak_pressure", "400, 496 MPa"}}) +
                 "[set]\ninterface.base.condition = \"sliding\"\ninterface.base.friction = 0\n" + closes);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().key, "surrogate") << study.error().message();
}

TEST(Sweep, ForeseesTheLaunchesOfGapsThatClose) {
  const StudyFile study = parting_sweep_of(closes);
  StudyOptions options;
  options.jobs = 1;
  const Forecast forecast = forecast_study(study, options, 1e6);
  // Of two cases: one without a gap, and on two bounds three gaps, and ten halvings of 0.06 cm down to the
  // default of 0.0001 cm.
  EXPECT_EQ(forecast.confirmations, 2u * (1u + 2u * (3u + 10u)));
  EXPECT_GT(forecast.confirmation_time, 10.0 * (forecast.time - forecast.confirmation_time));
}

}  // namespace
}  // namespace launchsafe::study

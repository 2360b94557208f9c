#include "launchsafe/study/case_answer.hpp"

#include "launchsafe/kinds/critical_gap.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

StudyFile six_gaps() {
  return study_of(critical_text + "gaps = \"0, 0.01, 0.02, 0.03, 0.04, 0.05 cm\"\nconfirm = false\n" +
                  "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n" +
                  synthetic_constants);
}

CaseAnswer answer_to(const StudyFile& study) {
  const StudyCase& input = study.cases.front();
  return answer_of(study.study, input, synthetic_mechanics(input.scene.scene));
}

TEST(CaseAnswer, SaysWhatTheCriticalGapStudySays) {
  const StudyFile study = six_gaps();
  const CaseAnswer answer = answer_to(study);
  const CriticalGapResult whole = run_critical_gap(study, synthetic_options());
  const CaseOutcome& outcome = whole.details.front();
  EXPECT_EQ(answer.critical.kind, CriticalGapKind::value);
  EXPECT_EQ(answer.critical.value, outcome.critical.value);
  EXPECT_EQ(answer.critical.bounds.at_least, outcome.critical.bounds.at_least);
  EXPECT_GT(answer.critical.bounds.at_least, 0.0);
  ASSERT_EQ(answer.verdicts.size(), outcome.verdicts.size());
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    EXPECT_EQ(answer.verdicts[i].maximum.temperature, outcome.verdicts[i].maximum.temperature) << i;
    EXPECT_EQ(answer.verdicts[i].judgement.verdict, outcome.verdicts[i].judgement.verdict) << i;
    EXPECT_EQ(reason_text(answer.verdicts[i]), reason_text(outcome.verdicts[i])) << i;
  }
}

// Below ignition the reaction adds less than a kelvin (at 508 K (Q Z/c) exp(-21700/508) is 2 K/ms); above it
// T max is that of the burning skin, while the heated temperature goes on as a smooth function of the gap.
TEST(CaseAnswer, HeatedTemperatureIsTMaxWithoutIgnition) {
  const CaseAnswer answer = answer_to(six_gaps());
  double last = 0, step = 0;
  bool ignited = false;
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    const GapVerdict& row = answer.verdicts[i];
    if (!row.ignition) {
      EXPECT_NEAR(row.heated, row.maximum.temperature, 1.0) << i;
      EXPECT_LE(row.heated, row.maximum.temperature + 1e-6) << i;
    }
    if (i > 1) {
      EXPECT_NEAR(row.heated - last, step, 0.1 * step) << i;
    }
    step = row.heated - last;
    last = row.heated;
    ignited = ignited || row.ignition;
  }
  EXPECT_TRUE(ignited);
}

/// What is read back of an answer that was stored.
std::optional<CaseAnswer> stored(const CaseAnswer& answer) {
  auto database = store::Database::in_memory("answers");
  save_answer(database, "0a", answer);
  return read_answer(database, "0a");
}

TEST(CaseAnswer, ReadsBackExactly) {
  const CaseAnswer answer = answer_to(six_gaps());
  auto read = stored(answer);
  ASSERT_TRUE(read);
  for (const GapVerdict& row : read->verdicts) EXPECT_EQ(row.judgement.code, ReasonCode::not_judged);
  const StudyFile study = six_gaps();
  read = judged(std::move(*read), study.study, study.cases.front());
  EXPECT_EQ(read->critical.value, answer.critical.value);
  EXPECT_EQ(read->critical.kind, answer.critical.kind);
  EXPECT_EQ(read->critical.shares.size(), answer.critical.shares.size());
  EXPECT_EQ(read->critical.bounds.at_least, answer.critical.bounds.at_least);
  EXPECT_EQ(read->critical.bounds.at_most, answer.critical.bounds.at_most);
  EXPECT_EQ(read->run.steps, answer.run.steps);
  ASSERT_EQ(read->verdicts.size(), answer.verdicts.size());
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    const GapVerdict &a = answer.verdicts[i], &b = read->verdicts[i];
    EXPECT_EQ(a.maximum.temperature, b.maximum.temperature);
    EXPECT_EQ(a.maximum.point, b.maximum.point);
    EXPECT_EQ(a.uncertainty.total(), b.uncertainty.total());
    EXPECT_GT(a.air.supplied, a.gap > 0.0 ? 0.0 : -1.0);
    EXPECT_EQ(a.air.taken, b.air.taken);
    EXPECT_EQ(a.heated, b.heated);
    EXPECT_EQ(a.air.supplied, b.air.supplied);
    EXPECT_EQ(a.judgement.verdict, b.judgement.verdict);
    EXPECT_EQ(reason_text(a), reason_text(b));
    ASSERT_EQ(a.ignition.has_value(), b.ignition.has_value());
    if (a.ignition) {
      EXPECT_EQ(a.ignition->time, b.ignition->time);
    }
  }
}

TEST(CaseAnswer, EveryStatusOfARunReadsBack) {
  CaseAnswer answer = answer_to(six_gaps());
  for (int status = 0; status <= static_cast<int>(run::last_status); ++status) {
    answer.run.status = static_cast<run::RunStatus>(status);
    answer.failure = status == 0 ? "" : "the run failed";
    const auto read = stored(answer);
    ASSERT_TRUE(read) << run::to_string(answer.run.status);
    EXPECT_EQ(read->run.status, answer.run.status);
  }
}

TEST(CaseAnswer, NumbersThatAreNotFiniteReadBackAsNotANumber) {
  const StudyFile study = six_gaps();
  const CaseAnswer failed =
      failed_answer(study.study, study.cases.front(), RunOutcome::failed, "out of memory");
  const auto read = stored(failed);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->failure, "out of memory");
  EXPECT_EQ(read->critical.kind, CriticalGapKind::indeterminate);
  EXPECT_TRUE(std::isnan(read->critical.value));
  for (const GapVerdict& row : read->verdicts) EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
  for (const GapVerdict& row : read->verdicts) EXPECT_TRUE(std::isnan(row.heated));
}

TEST(CaseAnswer, CriticalGapsUnderOtherConstantsReadBack) {
  CaseAnswer answer = answer_to(six_gaps());
  answer.models = {{"hot", 3e-4}, {"late", no_ignition}, {"broken", not_a_number, "energy drift"}};
  const auto read = stored(answer);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->models.size(), 3u);
  EXPECT_EQ(read->models[0].name, "hot");
  EXPECT_EQ(read->models[0].critical_gap, 3e-4);
  EXPECT_EQ(read->models[1].critical_gap, no_ignition);
  EXPECT_TRUE(std::isnan(read->models[2].critical_gap));
  EXPECT_EQ(read->models[2].failure, "energy drift");
}

TEST(CaseAnswer, TheLastOneOfAKeyCounts) {
  auto database = store::Database::in_memory("answers");
  CaseAnswer answer = answer_to(six_gaps());
  EXPECT_FALSE(read_answer(database, "0a"));
  save_answer(database, "0a", answer);
  answer.verdicts.pop_back();
  save_answer(database, "0a", answer);
  const auto read = read_answer(database, "0a");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->verdicts.size(), 5u);
  EXPECT_FALSE(read_answer(database, "0b"));
}

}  // namespace

// Answers that somebody edited: what is read back is what was written, or nothing. tests/fuzz/read_store.cpp
// edits at random.
#include "launchsafe/study/case_answer.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const StudyFile& some_study() {
  static const StudyFile study = study_of(
      critical_text + "gaps = \"0, 0.02, 0.04, 0.05 cm\"\nconfirm = false\n" +
      "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n" + synthetic_constants);
  return study;
}

const CaseAnswer& some_answer() {
  static const CaseAnswer answer = [] {
    const StudyCase& input = some_study().cases.front();
    return answer_of(some_study().study, input, synthetic_mechanics(input.scene.scene));
  }();
  return answer;
}

/// What a study would take an answer for that it finds stored; `edit` changes the file before.
std::optional<CaseAnswer> accepted(const CaseAnswer& stored, const std::string& edit = {}) {
  const launchsafe::testing::SharedFolder folder;
  const std::filesystem::path path = folder.path / "study.db";
  {
    auto file = store::Database::open(path);
    save_answer(file, "0a", stored);
    if (!edit.empty()) file.run(edit);
  }
  auto file = store::Database::copy_of(path);
  auto answer = read_answer(file, "0a");
  if (!answer) return std::nullopt;
  return judged(std::move(*answer), some_study().study, some_study().cases.front());
}

// Each is one edit of a sound answer, stored by a program that makes the same checksum.
TEST(StoredAnswer, ThatContradictsItselfIsNone) {
  const std::map<std::string, std::function<void(CaseAnswer&)>> edits{
      {"unknown status", [](auto& a) { a.run.status = static_cast<run::RunStatus>(99); }},
      {"negative status", [](auto& a) { a.run.status = static_cast<run::RunStatus>(-1); }},
      {"failed run without a failure", [](auto& a) { a.run.status = static_cast<run::RunStatus>(2); }},
      {"unknown kind of critical gap", [](auto& a) { a.critical.kind = static_cast<CriticalGapKind>(5); }},
      {"several crossings with one value",
       [](auto& a) { a.critical.kind = CriticalGapKind::several_crossings; }},
      {"critical gap outside its bracket", [](auto& a) { a.critical.value = 0.01; }},
      {"bracket the wrong way round", [](auto& a) { std::swap(a.critical.lower, a.critical.upper); }},
      {"critical gap without its shares", [](auto& a) { a.critical.shares.clear(); }},
      {"negative share", [](auto& a) { a.critical.shares.front().raised = -1e-4; }},
      {"unknown cause of ignition",
       [](auto& a) { a.verdicts[3].ignition->cause = static_cast<surface::IgnitionCause>(2); }},
      {"negative uncertainty", [](auto& a) { a.verdicts[0].uncertainty.numerical = -50; }},
      {"other margin", [](auto& a) { a.verdicts[1].margin = 200; }},
      {"cooler maximum", [](auto& a) { a.verdicts[1].maximum.temperature = 400; }},
      {"maximum colder than the beginning",
       [](auto& a) {
         a.verdicts[1].maximum.temperature = 100;
         a.verdicts[1].margin = 421;
       }},
      {"maximum after the end", [](auto& a) { a.verdicts[1].maximum.time = 1; }},
      {"another gap", [](auto& a) { a.verdicts[1].gap = 1e-4; }},
      {"gaps in another order", [](auto& a) { std::swap(a.verdicts[0], a.verdicts[1]); }},
      {"a gap less", [](auto& a) { a.verdicts.pop_back(); }},
      {"a launch that nobody asked for", [](auto& a) { a.friction_rise = no_ignition; }},
      {"constants as calibrated that are not",
       [](auto& a) {
         a.verdicts[0].as_calibrated = {{"", 1.0, false}};
       }},
      {"negative heat from the air", [](auto& a) { a.verdicts[1].air.taken = -1; }},
      {"heat from the air that is no number",
       [](auto& a) { a.verdicts[1].air.taken = std::numeric_limits<double>::quiet_NaN(); }},
  };
  ASSERT_TRUE(accepted(some_answer()));
  for (const auto& [name, edit] : edits) {
    CaseAnswer answer = some_answer();
    edit(answer);
    EXPECT_FALSE(accepted(answer)) << name;
  }
}

// Somebody, or a fault of the disk, changes a file that was written.
TEST(StoredAnswer, ThatIsNotAsItWasWrittenIsNone) {
  for (const char* edit :
       {"UPDATE stored_case_answers SET answer = substr(answer, 1, length(answer) - 1)",
        "UPDATE stored_case_answers SET answer = CAST(answer || x'00' AS BLOB)",
        "UPDATE stored_case_answers SET answer = CAST(substr(answer, 1, 40) || x'00' || substr(answer, 42) "
        "AS "
        "BLOB)",
        "UPDATE stored_case_answers SET answer = x''", "UPDATE stored_case_answers SET answer = NULL",
        "UPDATE stored_case_answers SET key = '0b'", "UPDATE stored_case_answers SET check_sum = 0",
        "UPDATE stored_case_answers SET check_sum = NULL", "DELETE FROM stored_case_answers",
        "DROP TABLE stored_case_answers"})
    EXPECT_FALSE(accepted(some_answer(), edit)) << edit;
}

TEST(StoredAnswer, AValidityWarningStaysOne) {
  const StudyCase& input = some_study().cases.front();
  run::MechanicsResult mechanics = synthetic_mechanics(input.scene.scene);
  mechanics.monitor.clear();  // a run without a history has a validity warning
  const CaseAnswer answer = answer_of(some_study().study, input, mechanics);
  ASSERT_EQ(answer.verdicts[0].judgement.verdict, Verdict::indeterminate);
  const auto read = accepted(answer);
  ASSERT_TRUE(read);
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    EXPECT_EQ(read->verdicts[i].judgement.verdict, answer.verdicts[i].judgement.verdict) << i;
    EXPECT_EQ(reason_text(read->verdicts[i]), reason_text(answer.verdicts[i])) << i;
  }
}

}  // namespace

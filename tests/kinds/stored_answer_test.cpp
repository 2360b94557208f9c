// Answers that somebody edited: what is read back is what was written, or nothing. tests/fuzz/read_store.cpp
// edits at random.
#include "launchsafe/study/case_answer.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <map>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using Json = nlohmann::json;

const StudyFile& some_study() {
  static const StudyFile study = study_of(
      critical_text + "gaps = \"0, 0.02, 0.04, 0.05 cm\"\nconfirm = false\n" +
      "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n" + synthetic_constants);
  return study;
}

const std::string& some_line() {
  static const std::string line = [] {
    const StudyCase& input = some_study().cases.front();
    return to_json_line(answer_of(some_study().study, input, synthetic_mechanics(input.scene.scene)));
  }();
  return line;
}

/// What a study would take a line for.
std::optional<CaseAnswer> accepted(const std::string& line) {
  auto answer = answer_from_json(line);
  if (answer && !fits(*answer, some_study().study, some_study().cases.front())) return std::nullopt;
  return answer;
}

TEST(StoredAnswer, HoldsNoVerdict) {
  ASSERT_TRUE(accepted(some_line()));
  EXPECT_EQ(some_line().find("verdict\""), std::string::npos);
  EXPECT_EQ(some_line().find("INDETERMINATE"), std::string::npos);
}

// Each is one edit of a sound answer.
TEST(StoredAnswer, ThatContradictsItselfIsNone) {
  const std::map<std::string, std::function<void(Json&)>> edits{
      {"unknown status", [](Json& a) { a["run"]["status"] = 7; }},
      {"negative status", [](Json& a) { a["run"]["status"] = -1; }},
      {"status that is true", [](Json& a) { a["run"]["status"] = false; }},
      {"failed run without a failure", [](Json& a) { a["run"]["status"] = 2; }},
      {"unknown kind of critical gap", [](Json& a) { a["critical"][0] = 5; }},
      {"several crossings with one value", [](Json& a) { a["critical"][0] = 4; }},
      {"kind beyond 32 bits", [](Json& a) { a["critical"][0] = 4294967296; }},
      {"critical gap outside its bracket", [](Json& a) { a["critical"][1] = 0.01; }},
      {"bracket the wrong way round", [](Json& a) { std::swap(a["critical"][2], a["critical"][3]); }},
      {"critical gap surer than its bracket", [](Json& a) { a["critical"][4] = 0; }},
      {"critical gap with a part too few", [](Json& a) { a["critical"].erase(5); }},
      {"unknown cause of ignition", [](Json& a) { a["verdicts"][3]["ignition"][0] = 2; }},
      {"negative uncertainty", [](Json& a) { a["verdicts"][0]["uncertainty"][3] = -50; }},
      {"uncertainty that is a word", [](Json& a) { a["verdicts"][0]["uncertainty"][3] = "1"; }},
      {"uncertainty with a part too few", [](Json& a) { a["verdicts"][0]["uncertainty"].erase(5); }},
      {"uncertainty with a part too many", [](Json& a) { a["verdicts"][0]["uncertainty"].push_back(0); }},
      {"other margin", [](Json& a) { a["verdicts"][1]["margin"] = 200; }},
      {"cooler maximum", [](Json& a) { a["verdicts"][1]["maximum"][0] = 400; }},
      {"maximum colder than the beginning",
       [](Json& a) {
         a["verdicts"][1]["maximum"][0] = 100;
         a["verdicts"][1]["margin"] = 421;
       }},
      {"maximum after the end", [](Json& a) { a["verdicts"][1]["maximum"][1] = 1; }},
      {"peak with a part too few", [](Json& a) { a["verdicts"][1]["early"].erase(2); }},
      {"another gap", [](Json& a) { a["verdicts"][1]["gap"] = 1e-4; }},
      {"gaps in another order", [](Json& a) { std::swap(a["verdicts"][0], a["verdicts"][1]); }},
      {"a gap less", [](Json& a) { a["verdicts"].erase(3); }},
      {"heated temperatures of another number", [](Json& a) { a["heated"].erase(0); }},
      {"an acceptance that nobody gave", [](Json& a) { a["verdicts"][0]["accepted"] = "accepted: all"; }},
      {"nothing that is not accepted", [](Json& a) { a["verdicts"][0].erase("unaccepted"); }},
      {"constants as calibrated that are not",
       [](Json& a) {
         a["verdicts"][0]["as_calibrated"] = {{"", 1.0, false}};
       }},
      {"no validity warnings", [](Json& a) { a["verdicts"][0].erase("doubt"); }},
      {"no energy of the air", [](Json& a) { a["verdicts"][0].erase("air"); }},
      {"energy of the air with a part too few", [](Json& a) { a["verdicts"][1]["air"].erase(3); }},
      {"negative heat from the air", [](Json& a) { a["verdicts"][1]["air"][0] = -1; }},
      {"heat from the air that is no number", [](Json& a) { a["verdicts"][1]["air"][0] = nullptr; }},
      {"compression that supplies less than the air stores", [](Json& a) { a["verdicts"][1]["air"][1] = 1; }},
      {"negative limiters", [](Json& a) { a["run"]["limiters"][0] = -1; }},
  };
  for (const auto& [name, edit] : edits) {
    Json answer = Json::parse(some_line());
    edit(answer);
    EXPECT_FALSE(accepted(answer.dump())) << name;
  }
}

TEST(StoredAnswer, VerdictsThatSomebodyWritesInAreNotRead) {
  Json answer = Json::parse(some_line());
  for (Json& row : answer["verdicts"]) {
    row["verdict"] = 0;
    row["reason"] = "margin 300 K";
  }
  const auto read = accepted(answer.dump());
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json_line(*read), some_line());
  EXPECT_EQ(read->verdicts[3].judgement.verdict, Verdict::unsafe);
}

TEST(StoredAnswer, AValidityWarningStaysOne) {
  const StudyCase& input = some_study().cases.front();
  run::MechanicsResult mechanics = synthetic_mechanics(input.scene.scene);
  mechanics.monitor.clear();  // a run without a history has a validity warning
  const CaseAnswer answer = answer_of(some_study().study, input, mechanics);
  ASSERT_EQ(answer.verdicts[0].judgement.verdict, Verdict::indeterminate);
  const auto read = accepted(to_json_line(answer));
  ASSERT_TRUE(read);
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    EXPECT_EQ(read->verdicts[i].judgement.verdict, answer.verdicts[i].judgement.verdict) << i;
    EXPECT_EQ(read->verdicts[i].judgement.reason, answer.verdicts[i].judgement.reason) << i;
  }
}

}  // namespace

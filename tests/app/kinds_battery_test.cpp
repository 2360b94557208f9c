// What holds for a study of any kind: a kind without a study in stored_study.hpp fails here.
#include "launchsafe/kinds/kind.hpp"
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

using nlohmann::json;

/// Without what was measured while a study ran. The answer of an accuracy study names processor times, and a
/// remark on a setting says whether it is the fastest of its error.
json without_times(const json& value, const std::string& kind) {
  const bool tells_of_times = kind == "accuracy";
  static const std::set<std::string> times{"timing", "updates_per_second", "wall_s", "wall_time_s",
                                           "processor_time_s"};
  json kept = value.is_array() ? json::array() : json::object();
  if (!value.is_structured()) return value;
  for (const auto& [key, part] : value.items()) {
    if (value.is_array()) kept.push_back(without_times(part, kind));
    if (value.is_array() || times.contains(key)) continue;
    if (tells_of_times && (key == "answer" || key == "remark")) continue;
    kept[key] = without_times(part, kind);
  }
  return kept;
}

class EveryKind : public StoredStudy, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    ASSERT_TRUE(study_of_kind.contains(GetParam())) << "no study of kind " << GetParam();
    write("study.toml", study_of_kind.at(GetParam()));
    write("shell.toml", brief_scene());
  }

  Outcome study_into(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{"study", "study.toml", "-o", output, "--jobs", "1"};
    command.insert(command.end(), more.begin(), more.end());
    return run(command);
  }

  /// The study that ran into the folder "alone", once for all cases; its exit code says that every case has
  /// an answer, if perhaps an indeterminate one.
  const Outcome& run_alone() {
    static const testing::SharedFolder shared;
    static std::map<std::string, Outcome> outcomes;
    const std::filesystem::path kept = shared.path / GetParam(), alone = folder() / "alone";
    const auto [outcome, is_new] = outcomes.try_emplace(GetParam());
    if (is_new) outcome->second = study_into("alone", {"--json"});
    const int code = outcome->second.code;
    EXPECT_TRUE(code == 0 || code == 4) << code << outcome->second.err;
    std::filesystem::copy(is_new ? alone : kept, is_new ? kept : alone,
                          std::filesystem::copy_options::recursive);
    return outcome->second;
  }

  json study_json(const std::string& output) const {
    return json::parse(read(output + "/study.json"), nullptr, false);
  }

  /// The study.json but for times; where it has none, all result files.
  void expect_same_as_alone(const std::string& output) const {
    const json alone = study_json("alone"), other = study_json(output);
    ASSERT_TRUE(alone.is_object() && other.is_object());
    EXPECT_EQ(without_times(other, GetParam()), without_times(alone, GetParam()));
    if (without_times(alone, GetParam()) == alone) expect_same_results("alone", output);
  }
};

TEST_P(EveryKind, PrintsWhatStudyJsonHoldsAndHasTheCommonKeys) {
  const Outcome outcome = run_alone();
  const json object = study_json("alone");
  EXPECT_EQ(json::parse(outcome.out, nullptr, false), object);
  EXPECT_EQ(object.value("kind", ""), GetParam());
  EXPECT_EQ(object.value("study", ""), "study.toml");
  EXPECT_EQ(object.value("title", ""), "a small shell");
  EXPECT_FALSE(object.value("answer", "").empty());
}

TEST_P(EveryKind, ThatIsFinishedStandsAsItIs) {
  const int code = run_alone().code;
  const auto written = std::filesystem::last_write_time(folder() / "alone/report.md");
  const auto before = results_in("alone");
  const std::string manifest = read("alone/manifest.json");
  const Outcome again = study_into("alone");
  EXPECT_EQ(again.code, code);
  EXPECT_TRUE(again.says("ran 0;")) << again.err;
  EXPECT_TRUE(again.says("stands as it is")) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder() / "alone/report.md"), written);
  EXPECT_TRUE(results_in("alone") == before);
  EXPECT_EQ(read("alone/manifest.json"), manifest);
}

TEST_P(EveryKind, ThatWasKilledComesToTheSame) {
  const int code = run_alone().code;
  // On a busy machine a study may end before it is killed.
  bool was_killed = false;
  for (int attempt = 0; attempt < 5 && !was_killed; ++attempt) {
    std::filesystem::remove_all(folder() / "out");
    start({"study", "study.toml", "-o", "out", "--jobs", "1"});
    wait_for_a_case("out");
    send(SIGKILL);
    was_killed = wait().code == -1;
  }
  if (!was_killed) GTEST_SKIP() << "the study ended each time before it was killed";
  const auto kept = case_files("out");
  const Outcome resumed = study_into("out");
  EXPECT_EQ(resumed.code, code) << resumed.err;
  const auto files = case_files("out");
  for (const auto& [hash, time] : kept) EXPECT_EQ(files.at(hash), time) << hash << " was computed again";
  EXPECT_FALSE(kept.empty());
  EXPECT_FALSE(resumed.says("re-used 0 ")) << resumed.err;
  expect_same_as_alone("out");
}

TEST_P(EveryKind, InShardsMergesToTheWhole) {
  const int code = run_alone().code;
  for (const char* shard : {"1", "2"}) {
    const std::string output = std::string("shard-") + shard;
    const Outcome outcome = study_into(output, {"--shard", std::string(shard) + "/2"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_FALSE(exists(output + "/report.md"));
  }
  const Outcome merged = run({"merge", "study.toml", "-o", "merged", "shard-1", "shard-2"});
  EXPECT_EQ(merged.code, code) << merged.err;
  EXPECT_TRUE(merged.says("ran 0;")) << merged.err;
  expect_same_as_alone("merged");
  const std::string manifest = read("merged/manifest.json");
  EXPECT_EQ(run({"merge", "study.toml", "-o", "merged", "shard-1", "shard-2"}).code, code);
  EXPECT_EQ(read("merged/manifest.json"), manifest);
}

TEST_P(EveryKind, WithoutMemoryFailsAndJudgesNothing) {
  const Outcome outcome = study_into("out", {"--memory", "1B", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(outcome.says("memory")) << outcome.err;
  EXPECT_TRUE(whole_cases("out").empty());
  const json printed = json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(printed.contains("failures")) << outcome.out;
  EXPECT_GE(printed["failures"].size(), 1u);
  for (const char* verdict : {":\"SAFE\"", ":\"UNSAFE\""})
    EXPECT_EQ(printed.dump().find(verdict), std::string::npos) << verdict;
  for (const auto& [name, bytes] : results_in("out")) EXPECT_FALSE(name.ends_with(".partial")) << name;
}

TEST_P(EveryKind, EstimateWritesNothing) {
  const Outcome outcome = study_into("out", {"--dry-run", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json estimate = json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(estimate.value("kind", ""), GetParam());
  EXPECT_GE(estimate.value("mechanical_runs", 0), 1);
  EXPECT_FALSE(exists("out"));
}

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const kinds::Kind& kind : kinds::kinds()) names.push_back(kind.traits.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, ::testing::ValuesIn(names_of_kinds()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace launchsafe::app

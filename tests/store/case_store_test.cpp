#include "launchsafe/store/case_store.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <fstream>
#include <regex>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
using CaseStoreTest = StoreFixture;

void append(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary | std::ios::app) << text;
}

std::size_t lines_of(const std::filesystem::path& path) {
  const std::string text = *read_file(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(CaseStoreTest, NamesACaseByItsInput) {
  const CaseIdentity identity("abc");
  EXPECT_EQ(identity.input(), "abc");
  EXPECT_EQ(identity.hash(), "ba7816bf8f01cfea414140de5dae2223");
}

TEST_F(CaseStoreTest, GivesBackEveryBit) {
  const auto store = opened();
  const std::string hash = identity_of(1).hash();
  EXPECT_FALSE(store->holds(hash));
  save(*store, 1);
  EXPECT_TRUE(store->holds(hash));
  ASSERT_FALSE(store->flush());
  EXPECT_TRUE(store->holds(hash));
  const auto result = store->load(hash);
  ASSERT_TRUE(result) << result.error().message;
  expect_same(result_of(1), *result);
  EXPECT_EQ(*store->input_of(hash), identity_of(1).input());
}

TEST_F(CaseStoreTest, RemembersAfterItWasClosed) {
  fill(3);
  const auto store = opened();
  for (int number = 0; number < 3; ++number) {
    const std::string hash = identity_of(number).hash();
    EXPECT_TRUE(store->holds(hash));
    const auto entry = store->last_entry(hash);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->state, CaseState::done);
    EXPECT_EQ(entry->label, "case " + std::to_string(number));
    EXPECT_EQ(entry->model_version, model_version);
    EXPECT_EQ(entry->wall_time, 61.5);
    EXPECT_EQ(entry->processor_time, 60.25);
    EXPECT_EQ(entry->predicted_updates, 1e9);
    EXPECT_EQ(entry->host, host_name());
    EXPECT_EQ(entry->file_size, std::filesystem::file_size(file_of(number)));
    expect_same(result_of(number), *store->load(hash));
  }
  EXPECT_EQ(store->entries().size(), 3U);
  EXPECT_EQ(store->remarks(), std::vector<std::string>{});
  EXPECT_EQ(lines_of(where() / "journal.jsonl"), 3U) << "nothing is journaled twice";
}

TEST_F(CaseStoreTest, EqualCasesAreEqualFiles) {
  const auto first = opened_at(folder() / "first"), second = opened_at(folder() / "second");
  first->save(identity_of(1), sample_scene(), result_of(1), entry_of(1));
  ASSERT_FALSE(first->flush());
  // HDF5's time stamps and those of a manifest have a resolution of one second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  run::CaseResult slower = result_of(1);
  slower.mechanics.wall_time = 99;
  JournalEntry entry = entry_of(1);
  entry.wall_time = 99;
  second->save(identity_of(1), sample_scene(), slower, entry);
  ASSERT_FALSE(second->flush());
  const std::string name = "cases/" + identity_of(1).hash() + ".h5";
  EXPECT_TRUE(*read_file(folder() / "first" / name) == *read_file(folder() / "second" / name));
  EXPECT_EQ(second->load(identity_of(1).hash())->mechanics.wall_time, 99);
}

TEST_F(CaseStoreTest, FilesSayWhichModelAndInputTheyAreOf) {
  fill(1);
  const auto manifest = read_manifest(file_of(0));
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->model_version, model_version);
  EXPECT_EQ(manifest->input_text, identity_of(0).input());
  EXPECT_EQ(manifest->host, "");
  EXPECT_EQ(manifest->start_time, "");
  EXPECT_EQ(manifest->wall_time, 0);
}

TEST_F(CaseStoreTest, AMissingCaseIsToldFromADamagedOne) {
  const auto store = opened();
  const auto result = store->load(identity_of(1).hash());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, Error::Kind::missing);
  EXPECT_FALSE(store->last_entry(identity_of(1).hash()));
}

TEST_F(CaseStoreTest, AResultThatDoesNotFitTogetherEndsTheWriting) {
  int failures = 0;
  const auto store = CaseStore::open(where(), {"", model_version, [&](const Error&) { ++failures; }});
  run::CaseResult result = result_of(1);
  result.mechanics.trace.chamber_pressure.pop_back();
  (*store)->save(identity_of(1), sample_scene(), result, entry_of(1));
  EXPECT_TRUE((*store)->flush());
  EXPECT_EQ(failures, 1);
  EXPECT_FALSE((*store)->holds(identity_of(1).hash()));
}

// --- the journal ---

TEST_F(CaseStoreTest, JournalsAttemptsThatLeftNoResult) {
  {
    const auto store = opened();
    JournalEntry entry = entry_of(1);
    entry.hash = identity_of(1).hash();
    entry.state = CaseState::timed_out;
    entry.reason = "60 s had passed";
    entry.time_limit = 60;
    entry.predicted_updates = not_a_number;
    store->note(entry);
    EXPECT_EQ(store->last_entry(entry.hash)->state, CaseState::timed_out);
  }
  const std::string line = *read_file(where() / "journal.jsonl");
  EXPECT_TRUE(line.starts_with("{\"case\":\"" + identity_of(1).hash() + "\",\"state\":\"timed-out\""))
      << line;
  EXPECT_NE(line.find("\"predicted_updates\":null"), std::string::npos) << line;
  const auto entry = opened()->last_entry(identity_of(1).hash());
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->state, CaseState::timed_out);
  EXPECT_EQ(entry->reason, "60 s had passed");
  EXPECT_EQ(entry->time_limit, 60);
  EXPECT_TRUE(std::isnan(entry->predicted_updates));
  EXPECT_TRUE(std::regex_match(entry->end_time, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
}

TEST_F(CaseStoreTest, TheNewestEntryOfACaseCounts) {
  {
    const auto store = opened();
    for (const CaseState state : {CaseState::failed, CaseState::interrupted}) {
      JournalEntry entry;
      entry.hash = "00ff";
      entry.state = state;
      store->note(entry);
    }
  }
  const auto store = opened();
  EXPECT_EQ(store->last_entry("00ff")->state, CaseState::interrupted);
  EXPECT_EQ(store->entries().size(), 1U);
}

TEST_F(CaseStoreTest, ALineThatAKillCutShortHurtsNoOther) {
  fill(2);
  append(where() / "journal.jsonl", R"({"case":"00ff","state":"do)");
  append(where() / "answers.jsonl", identity_of(9).hash() + " 0123456789abcdef {\"x\":");
  {
    const auto store = opened();
    EXPECT_FALSE(store->last_entry("00ff"));
    EXPECT_FALSE(store->answer(identity_of(9).hash()));
    save(*store, 2);
    store->save_answer("00aa", "after");
  }
  const auto store = opened();
  for (int number = 0; number < 3; ++number) EXPECT_TRUE(store->last_entry(identity_of(number).hash()));
  EXPECT_EQ(store->entries().size(), 3U);
  EXPECT_EQ(store->answer("00aa"), "after");
  EXPECT_TRUE(any_contains(store->remarks(), "journal.jsonl: 1 "));
}

// An editor who knows how lines are checked can make them pass; the journal knows better.
TEST_F(CaseStoreTest, AnEditedAnswerWithARecomputedChecksumCountsForNothing) {
  {
    const auto store = opened();
    store->save_answer("01", "INDETERMINATE");
    store->save_answer("02", "two");
  }
  std::string text = rehashed_line("01", "SAFE") + rehashed_line("02", "two") + rehashed_line("03", "SAFE");
  ASSERT_FALSE(write_file_atomically(where() / "answers.jsonl", text, IfExists::replace));
  const auto store = opened();
  EXPECT_FALSE(store->answer("01"));
  EXPECT_EQ(store->answer("02"), "two");
  EXPECT_FALSE(store->answer("03"));
  EXPECT_TRUE(any_contains(store->remarks(), "answers.jsonl: 2 "));
}

TEST_F(CaseStoreTest, ADamagedLineIsIgnoredAndRemarked) {
  {
    const auto store = opened();
    store->save_answer("01", "one");
    store->save_answer("02", "two");
    store->save_answer("03", "three");
  }
  std::string text = *read_file(where() / "answers.jsonl");
  text.replace(text.find("two"), 3, "tvo");
  ASSERT_FALSE(write_file_atomically(where() / "answers.jsonl", text, IfExists::replace));
  append(where() / "journal.jsonl", std::string(4, '\0') + "\n[1]\n{\"case\":\"0f\",\"state\":\"odd\"}\n");
  const auto store = opened();
  EXPECT_EQ(store->answer("01"), "one");
  EXPECT_FALSE(store->answer("02"));
  EXPECT_EQ(store->answer("03"), "three");
  EXPECT_TRUE(any_contains(store->remarks(), "answers.jsonl: 1 "));
  EXPECT_TRUE(any_contains(store->remarks(), "journal.jsonl: 3 "));
}

// --- answers ---

TEST_F(CaseStoreTest, KeepsTheLastAnswerOfAKey) {
  {
    const auto store = opened();
    EXPECT_FALSE(store->answer("0a"));
    store->save_answer("0a", R"({"x": 1})");
    store->save_answer("0b", "");
    EXPECT_EQ(store->answer("0a"), R"({"x": 1})");
    store->save_answer("0a", R"({"x": 2})");
    EXPECT_EQ(store->answer("0a"), R"({"x": 2})");
  }
  const auto store = opened();
  EXPECT_EQ(store->answer("0a"), R"({"x": 2})");
  EXPECT_EQ(store->answer("0b"), "");
  EXPECT_FALSE(store->answer("0c"));
}

TEST_F(CaseStoreTest, AnAnswerOfTwoLinesEndsTheWriting) {
  const auto store = opened();
  store->save_answer("0a", "one\ntwo");
  EXPECT_TRUE(store->flush());
  EXPECT_FALSE(store->answer("0a"));
}

}  // namespace
}  // namespace launchsafe::store

#include "launchsafe/store/case_store.hpp"

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <fstream>
#include <regex>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
using CaseStoreTest = StoreFixture;

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
}

TEST_F(CaseStoreTest, RemembersAfterItWasClosed) {
  fill(3);
  const auto store = opened();
  for (int number = 0; number < 3; ++number) {
    const std::string hash = identity_of(number).hash();
    EXPECT_TRUE(store->holds(hash));
    const auto entry = store->record_of(hash);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->state, CaseState::done);
    EXPECT_EQ(entry->label, "case " + std::to_string(number));
    EXPECT_EQ(entry->model_version, model_version);
    EXPECT_EQ(entry->wall_time, 61.5);
    EXPECT_EQ(entry->processor_time, 60.25);
    EXPECT_EQ(entry->program, program_of(make_manifest({}, 1)));
    expect_same(result_of(number), *store->load(hash));
  }
  EXPECT_EQ(store->records().size(), 3U);
  EXPECT_EQ(store->remarks(), std::vector<std::string>{});
}

TEST_F(CaseStoreTest, EqualCasesAreEqualFiles) {
  const auto first = opened_at(folder() / "first"), second = opened_at(folder() / "second");
  first->save(identity_of(1), sample_scene(), result_of(1), record_of(1));
  ASSERT_FALSE(first->flush());
  // HDF5's time stamps and those of a manifest have a resolution of one second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  run::CaseResult slower = result_of(1);
  slower.mechanics.wall_time = 99;
  RunRecord entry = record_of(1);
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
  EXPECT_FALSE(store->record_of(identity_of(1).hash()));
}

// --- attempts ---

TEST_F(CaseStoreTest, RecordsAttemptsThatLeftNoResult) {
  {
    const auto store = opened();
    RunRecord entry = record_of(1);
    entry.hash = identity_of(1).hash();
    entry.state = CaseState::timed_out;
    entry.reason = "60 s had passed";
    entry.time_limit = 60;
    store->note(entry);
    EXPECT_EQ(store->record_of(entry.hash)->state, CaseState::timed_out);
  }
  const auto entry = opened()->record_of(identity_of(1).hash());
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->state, CaseState::timed_out);
  EXPECT_EQ(entry->reason, "60 s had passed");
  EXPECT_EQ(entry->time_limit, 60);
  EXPECT_TRUE(std::regex_match(entry->end_time, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
}

TEST_F(CaseStoreTest, TheNewestEntryOfACaseCounts) {
  {
    const auto store = opened();
    for (const CaseState state : {CaseState::failed, CaseState::interrupted}) {
      RunRecord entry;
      entry.hash = "00ff";
      entry.state = state;
      store->note(entry);
    }
  }
  const auto store = opened();
  EXPECT_EQ(store->record_of("00ff")->state, CaseState::interrupted);
  EXPECT_EQ(store->records().size(), 1U);
}

// --- tables ---

TEST_F(CaseStoreTest, TablesForOtherProgramsAreReplacedTogether) {
  const PlainTable cases{"cases", {"case", "gap_cm"}, {{std::string("a"), 0.5}, {std::string("b"), {}}}};
  {
    const auto store = opened();
    store->replace_tables({{"verdicts", {"verdict"}, {{std::string("SAFE")}}}, cases});
    store->replace_tables({cases, {"runs", {"steps"}, {{std::int64_t{12}}}}});
    save(*store, 1);
  }
  auto file = Database::copy_of(results());
  EXPECT_TRUE(file.rows("SELECT 1 FROM sqlite_schema WHERE name = 'verdicts'").empty());
  EXPECT_EQ(file.rows("SELECT * FROM cases WHERE gap_cm > 0.1"), std::vector<SqlRow>{cases.rows[0]});
  EXPECT_EQ(file.rows("SELECT steps FROM runs").front(), SqlRow{std::int64_t{12}});
  EXPECT_EQ(opened()->records().size(), 1U);
}

TEST_F(CaseStoreTest, SomethingWrongInATableEndsTheWritingAndChangesNothing) {
  {
    const auto store = opened();
    store->replace_tables({{"cases", {"case"}, {{std::string("a")}}}});
    store->replace_tables({{"cases", {"case", "case"}, {}}});
    EXPECT_TRUE(store->flush());
  }
  EXPECT_EQ(Database::copy_of(results()).rows("SELECT * FROM cases").size(), 1U);
}

}  // namespace
}  // namespace launchsafe::store

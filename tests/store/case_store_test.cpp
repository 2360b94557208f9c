#include "launchsafe/store/case_store.hpp"

#include "same_case.hpp"
#include "store_fixture.hpp"

#include <sqlite3.h>

#include <fstream>
#include <regex>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
using CaseStoreTest = StoreFixture;
using Remarks = std::vector<std::string>;

TEST_F(CaseStoreTest, NamesACaseByItsInput) {
  EXPECT_EQ(CaseIdentity("abc").hash, "ba7816bf8f01cfea414140de5dae2223");
}

TEST_F(CaseStoreTest, GivesBackEveryBitAndRemembersAfterItWasClosed) {
  fill(3);
  const auto store = opened();
  for (int number = 0; number < 3; ++number) {
    EXPECT_TRUE(store->holds(hash_of(number)));
    const auto record = store->record_of(hash_of(number));
    ASSERT_TRUE(record);
    EXPECT_EQ(record->state, CaseState::done);
    EXPECT_EQ(record->label, "case " + std::to_string(number));
    EXPECT_EQ(record->model_version, 7);
    EXPECT_EQ(record->wall_time, 61.5);
    EXPECT_EQ(record->processor_time, 60.25);
    EXPECT_EQ(record->program, program_of(make_manifest({})));
    EXPECT_TRUE(std::regex_match(record->end_time, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
    expect_same(result_of(number), *store->load(hash_of(number)));
  }
  EXPECT_EQ(store->records().size(), 3U);
  EXPECT_EQ(store->remarks(), Remarks{});
  EXPECT_FALSE(store->holds(hash_of(3)));
  EXPECT_FALSE(store->load(hash_of(3)));
  EXPECT_FALSE(store->record_of(hash_of(3)));
}

TEST_F(CaseStoreTest, EqualCasesAreEqualFiles) {
  const auto first = CaseStore::open(folder() / "first"), second = CaseStore::open(folder() / "second");
  save(*first, 1);
  // HDF5's time stamps and those of a manifest have a resolution of one second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  run::CaseResult slower = result_of(1);
  slower.mechanics.wall_time = 99;
  RunRecord record = record_of(1);
  record.wall_time = 99;
  second->save(identity_of(1), slower, record);
  const std::string name = "cases/" + hash_of(1) + ".h5";
  EXPECT_TRUE(read_file(folder() / "first" / name) == read_file(folder() / "second" / name));
  EXPECT_EQ(second->load(hash_of(1))->mechanics.wall_time, 99);
}

TEST_F(CaseStoreTest, TheNewestAttemptOnACaseCounts) {
  {
    const auto store = opened();
    store->note(record_of(1, CaseState::failed));
    RunRecord late = record_of(1, CaseState::timed_out);
    late.reason = "60 s had passed";
    late.time_limit = 60;
    store->note(late);
  }
  const auto store = opened();
  EXPECT_EQ(store->records().size(), 1U);
  const auto record = store->record_of(hash_of(1));
  ASSERT_TRUE(record);
  EXPECT_EQ(record->state, CaseState::timed_out);
  EXPECT_EQ(record->reason, "60 s had passed");
  EXPECT_EQ(record->time_limit, 60);
}

// --- damaged files ---

TEST_F(CaseStoreTest, ADamagedFileIsReplaced) {
  fill(1);
  const std::string whole = read_file(file_of(0));
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 4;
  for (const std::string& bytes : {whole.substr(0, whole.size() - 1), std::string(), flipped}) {
    std::ofstream(file_of(0), std::ios::binary) << bytes;
    const auto store = opened();
    EXPECT_FALSE(store->load(hash_of(0)));
    EXPECT_FALSE(store->holds(hash_of(0)));
    ASSERT_EQ(store->remarks().size(), 1U);
    EXPECT_NE(store->remarks()[0].find(file_of(0).string()), std::string::npos);
    save(*store, 0);
    EXPECT_EQ(read_file(file_of(0)), whole);
  }
}

TEST_F(CaseStoreTest, AWholeFileWithoutARecordIsHeld) {
  fill(1);
  std::filesystem::remove(results_file(where()));
  const auto store = opened();
  EXPECT_FALSE(store->record_of(hash_of(0)));
  EXPECT_TRUE(store->holds(hash_of(0)));
  EXPECT_TRUE(store->load(hash_of(0)));
}

TEST_F(CaseStoreTest, AResultsFileOfAnotherProgramOrFormatIsRefusedAndStays) {
  std::filesystem::create_directory(where());
  for (const char* application : {"7", "1280524614"}) {  // the second is ours
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(results_file(where()).c_str(), &database), SQLITE_OK);
    const std::string statements =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = 1; CREATE TABLE t (x)", application);
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
    const std::string before = read_file(results_file(where()));
    EXPECT_EQ(fault(), Error::Kind::conflict);
    EXPECT_EQ(read_file(results_file(where())), before);
    std::filesystem::remove(results_file(where()));
  }
  std::ofstream(results_file(where())) << std::string(5000, 'x');
  EXPECT_EQ(fault(), Error::Kind::conflict);
}

// --- tables and status ---

TEST_F(CaseStoreTest, TablesForOtherProgramsAreReplacedTogether) {
  const PlainTable cases{"cases", {"case", "gap_cm"}, {{std::string("a"), 0.5}, {std::string("b"), {}}}};
  {
    const auto store = opened();
    store->replace_tables({{"verdicts", {"verdict"}, {{std::string("SAFE")}}}, cases});
    store->replace_tables({cases, {"runs", {"steps"}, {{std::int64_t{12}}}}});
    store->replace_tables({{"cases", {"case", "case"}, {}}});
    EXPECT_TRUE(store->flush()) << "something wrong in a table ends the writing and changes nothing";
  }
  Database file(results_file(where()), false);
  EXPECT_TRUE(file.rows("SELECT 1 FROM sqlite_schema WHERE name = 'verdicts'").empty());
  EXPECT_EQ(file.rows("SELECT * FROM cases WHERE gap_cm > 0.1"), std::vector<SqlRow>{cases.rows[0]});
  EXPECT_EQ(file.rows("SELECT steps FROM runs").front(), SqlRow{std::int64_t{12}});
}

TEST_F(CaseStoreTest, TheStatusIsReadBesideTheWriter) {
  EXPECT_FALSE(status_in(where()));
  {
    const auto store = opened();
    EXPECT_FALSE(status_in(where()));
    store->tell_status({.shard = "1/4", .command = "launchsafe", .cases = 24, .cases_done = 7}, true);
    store->tell_status({.cases = 24, .cases_done = 8}, false);  // within a second
    const auto status = status_in(where());
    ASSERT_TRUE(status);
    EXPECT_TRUE(status->alive);
    EXPECT_EQ(status->shard, "1/4");
    EXPECT_EQ(status->cases_done, 7);
    EXPECT_TRUE(std::isnan(status->time_left));
    EXPECT_EQ(status->exit_code, -1);
  }
  EXPECT_FALSE(status_in(where())->alive);
}

// --- another folder ---

TEST_F(CaseStoreTest, TakesOverWholeResultsWithTheirRecords) {
  const std::filesystem::path there = folder() / "other";
  {
    const auto other = CaseStore::open(there);
    for (int number = 0; number < 3; ++number) save(*other, number);
    other->note(record_of(5, CaseState::timed_out));
    other->note(record_of(6, CaseState::failed));
  }
  {
    const auto store = opened();
    save(*store, 1);
    save(*store, 6);
    EXPECT_EQ(store->import_from(there), 2U);
    EXPECT_EQ(store->import_from(there), 0U);
    EXPECT_EQ(store->import_from(where() / ".." / "study"), 0U);
    EXPECT_EQ(kind_of([&] { store->import_from(folder()); }), Error::Kind::missing);
  }
  const auto store = opened();
  EXPECT_EQ(store->records().size(), 5U);
  for (int number = 0; number < 3; ++number) EXPECT_TRUE(store->holds(hash_of(number)));
  expect_same(result_of(2), *store->load(hash_of(2)));
  EXPECT_EQ(store->record_of(hash_of(0))->label, "case 0");
  EXPECT_EQ(store->record_of(hash_of(5))->state, CaseState::timed_out);
  EXPECT_EQ(store->record_of(hash_of(6))->state, CaseState::done) << "a result counts more than an attempt";
}

// --- many threads ---

TEST_F(CaseStoreTest, ThreadsSaveLoadAndAskAtTheSameTime) {
  constexpr int threads = 8, cases = 24;
  std::atomic<int> faults = 0;
  {
    const auto store = opened();
    std::vector<std::jthread> team;
    for (int thread = 0; thread < threads; ++thread)
      team.emplace_back([&, thread] {
        for (int step = 0; step < cases; ++step) {
          const int number = (step * 5 + thread * 3) % cases;
          if (!store->holds(hash_of(number))) save(*store, number);
          const auto result = store->load(hash_of(number));
          if (!result || result->mechanics.end_time != number) ++faults;
          if (!store->record_of(hash_of(number)) && step > 0 && store->flush()) ++faults;
        }
      });
    team.clear();
    EXPECT_EQ(store->remarks(), Remarks{});
  }
  EXPECT_EQ(faults, 0);
  EXPECT_EQ(opened()->records().size(), static_cast<std::size_t>(cases));
}

}  // namespace
}  // namespace launchsafe::store

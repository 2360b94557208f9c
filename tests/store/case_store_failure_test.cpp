// What is left of a store when the disk is full or the process is killed.
#include "child_process.hpp"
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class StoreFailure : public StoreFixture {
 protected:
  /// Names in the folder of the cases that end so.
  static std::size_t count_of(const std::filesystem::path& store, const std::string& ending) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(store / "cases"))
      count += entry.path().filename().string().ends_with(ending) ? 1 : 0;
    return count;
  }
};

// --- a full disk ---

struct Failures {
  int calls = 0;
  std::function<void(const Error&)> counter() {
    return [this](const Error&) { ++calls; };
  }
};

TEST_F(StoreFailure, AFullDiskIsReportedOnceAndSparesWhatWasThere) {
  fill(2);
  EXPECT_TRUE(holds_under_file_size_limit(4096, [&] {
    Failures failures;
    auto store = CaseStore::open(where(), "", failures.counter());
    if (!store) return false;
    for (int number = 2; number < 6; ++number) save(**store, number);
    const MaybeError error = (*store)->flush();
    save(**store, 6);
    return error && error->kind == Error::Kind::write_failed && failures.calls == 1 &&
           error->message.find(file_of(2).string()) != std::string::npos &&
           (*store)->flush()->message == error->message && !(*store)->holds(identity_of(3).hash()) &&
           !(*store)->record_of(identity_of(6).hash()) && (*store)->load(identity_of(1).hash());
  }));
  EXPECT_EQ(count_of(where(), ".partial"), 0U);
  const auto store = opened();
  EXPECT_EQ(store->records().size(), 2U);
  for (int number = 0; number < 2; ++number)
    expect_same(result_of(number), *store->load(identity_of(number).hash()));
}

TEST_F(StoreFailure, AResultsFileThatIsFullHurtsNoRowBefore) {
  constexpr int notes = 300;
  const auto note_all = [&](CaseStore& store) {
    for (int number = 0; number < notes; ++number) {
      RunRecord record = record_of(number);
      record.hash = identity_of(number).hash();
      record.state = CaseState::failed;
      store.note(record);
    }
  };
  EXPECT_TRUE(holds_under_file_size_limit(30'000, [&] {
    Failures failures;
    auto store = CaseStore::open(where(), "", failures.counter());
    if (!store) return false;
    note_all(**store);
    const MaybeError error = (*store)->flush();
    return error && error->message.find("study.db") != std::string::npos && failures.calls == 1;
  }));
  {
    const auto store = opened();
    EXPECT_GT(store->records().size(), 10U);
    EXPECT_LT(store->records().size(), static_cast<std::size_t>(notes));
    note_all(*store);
  }
  EXPECT_EQ(opened()->records().size(), static_cast<std::size_t>(notes));
}

// --- a kill ---

/// Saves until it is killed; says so once the first is on disk.
[[noreturn]] void work_forever(const std::filesystem::path& folder, int first, int report) {
  const auto store = CaseStore::open(folder);
  if (!store) ::_exit(1);
  for (int number = first;; ++number) {
    save(**store, number);
    if (number == first && ((*store)->flush() || ::write(report, "y", 1) != 1)) ::_exit(1);
  }
}

/// Starts such a process and kills it after `delay`, counted from its start or from its first result.
void work_and_be_killed(const std::filesystem::path& folder, int first, std::chrono::microseconds delay,
                        bool after_a_result) {
  std::array<int, 2> report{};
  ASSERT_EQ(::pipe(report.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) work_forever(folder, first, report[1]);
  ::close(report[1]);
  char sign = 0;
  if (after_a_result) {
    EXPECT_EQ(::read(report[0], &sign, 1), 1);
  }
  std::this_thread::sleep_for(delay);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(report[0]);
}

TEST_F(StoreFailure, AKillAtAnyInstantLosesOnlyWhatWasInFlight) {
  constexpr int rounds = 40;
  std::mt19937 random(1);
  std::size_t known = 0;
  for (int round = 0; round < rounds; ++round) {
    const bool after_a_result = round % 4 != 0;
    work_and_be_killed(where(), 1000 * round, std::chrono::microseconds(random() % 30'000), after_a_result);

    const auto store = opened();
    ASSERT_NE(store, nullptr) << "the lock of the dead clears itself";
    EXPECT_EQ(count_of(where(), ".partial"), 0U) << "half-written files are gone";
    const std::vector<RunRecord> entries = store->records();
    EXPECT_GE(entries.size(), known + (after_a_result ? 1 : 0)) << "nothing is forgotten";
    known = entries.size();
    for (const RunRecord& entry : entries) {
      ASSERT_TRUE(std::filesystem::exists(where() / "cases" / (entry.hash + ".h5")));
      ASSERT_TRUE(store->holds(entry.hash));
    }
    for (std::size_t i = 0; i < entries.size(); i += 1 + entries.size() / 5)
      EXPECT_TRUE(store->load(entries[i].hash));
  }
  const auto store = opened();
  for (const auto& file : std::filesystem::directory_iterator(where() / "cases"))
    EXPECT_TRUE(store->holds(file.path().stem())) << "a whole file is held, recorded or not";
  EXPECT_EQ(store->remarks(), std::vector<std::string>{});
}

TEST_F(StoreFailure, LeftoversAreRemovedWhenNobodyElseWrites) {
  std::filesystem::create_directories(where() / "cases");
  const std::filesystem::path leftover = where() / "cases/.launchsafe.x.h5.01234567.partial";
  ASSERT_FALSE(write_file_atomically(leftover, "half", IfExists::refuse));
  opened("1-of-2");
  EXPECT_TRUE(std::filesystem::exists(leftover)) << "its writer may be alive";
  opened();
  EXPECT_FALSE(std::filesystem::exists(leftover));
}

}  // namespace
}  // namespace launchsafe::store

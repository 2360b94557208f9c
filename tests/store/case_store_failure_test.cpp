// What is left of a store when the disk is full or the process is killed, and who may write at the same time.
#include "child_process.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <array>
#include <csignal>
#include <random>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class StoreFailure : public StoreFixture {
 protected:
  /// Half-written files in the folder of the cases.
  std::ptrdiff_t leftovers() const {
    const std::filesystem::directory_iterator entries(where() / "cases");
    return std::ranges::count_if(
        entries, [](const auto& entry) { return is_temporary(entry.path().filename().string()); });
  }
};

// --- a full disk ---

TEST_F(StoreFailure, AFullDiskIsReportedOnceAndSparesWhatWasThere) {
  fill(2);
  EXPECT_TRUE(holds_under_file_size_limit(4096, [&] {
    int calls = 0;
    const auto store = CaseStore::open(where(), [&](const Error&) { ++calls; });
    for (int number = 2; number < 6; ++number) save(*store, number);
    const auto error = store->flush();
    return error && error->kind == Error::Kind::write_failed && calls == 1 &&
           error->message.find(file_of(2).string()) != std::string::npos && !store->holds(hash_of(3)) &&
           !store->record_of(hash_of(5)) && store->load(hash_of(1));
  }));
  EXPECT_EQ(leftovers(), 0);
  const auto store = opened();
  EXPECT_EQ(store->records().size(), 2U);
  for (int number = 0; number < 2; ++number) expect_same(result_of(number), *store->load(hash_of(number)));
}

TEST_F(StoreFailure, AResultsFileThatIsFullHurtsNoRowBefore) {
  constexpr int notes = 300;
  const auto note_all = [&](CaseStore& store) {
    for (int number = 0; number < notes; ++number) store.note(record_of(number, CaseState::failed));
  };
  EXPECT_TRUE(holds_under_file_size_limit(40'000, [&] {
    int calls = 0;
    const auto store = CaseStore::open(where(), [&](const Error&) { ++calls; });
    note_all(*store);
    const auto error = store->flush();
    return error && error->message.find("study.db") != std::string::npos && calls == 1;
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

/// A process that saves cases, beginning with number `first`, until it is killed. Made when the first is on
/// disk where `after_a_result`.
class Worker {
 public:
  Worker(const std::filesystem::path& folder, int first, bool after_a_result = true) {
    std::array<int, 2> report{};
    if (::pipe(report.data()) != 0) return;
    process_ = ::fork();
    if (process_ == 0) work(folder, first, report[1]);
    ::close(report[1]);
    char sign = 0;
    has_begun_ = !after_a_result || ::read(report[0], &sign, 1) == 1;
    ::close(report[0]);
  }
  ~Worker() { kill(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  bool has_begun() const { return has_begun_; }

 private:
  [[noreturn]] static void work(const std::filesystem::path& folder, int first, int report) try {
    const auto store = CaseStore::open(folder);
    store->tell_status({}, true);
    for (int number = first;; ++number) {
      save(*store, number);
      if (number == first && (store->flush() || ::write(report, "y", 1) != 1)) ::_exit(1);
    }
  } catch (const Error&) {
    ::_exit(1);
  }

  pid_t process_ = 0;
  bool has_begun_ = false;
};

TEST_F(StoreFailure, AKillAtAnyInstantLosesOnlyWhatWasInFlight) {
  std::mt19937 random(1);
  std::size_t known = 0;
  for (int round = 0; round < 40; ++round) {
    const bool after_a_result = round % 4 != 0;
    Worker worker(where(), 1000 * round, after_a_result);
    EXPECT_TRUE(worker.has_begun());
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 30'000));
    worker.kill();
    const auto store = opened();
    EXPECT_EQ(leftovers(), 0) << "half-written files are gone";
    const std::vector<RunRecord> records = store->records();
    EXPECT_GE(records.size(), known + (after_a_result ? 1 : 0)) << "nothing is forgotten";
    known = records.size();
    for (const RunRecord& record : records) ASSERT_TRUE(store->holds(record.hash));
    for (std::size_t i = 0; i < records.size(); i += 1 + records.size() / 5)
      EXPECT_TRUE(store->load(records[i].hash));
    EXPECT_EQ(store->remarks(), std::vector<std::string>{});
  }
}

// --- the lock ---

TEST_F(StoreFailure, TheLockRefusesOthersUntilItsOwnerEndsOrIsKilled) {
  Worker worker(where(), 0);
  ASSERT_TRUE(worker.has_begun());
  EXPECT_EQ(fault(), Error::Kind::conflict);
  EXPECT_TRUE(status_in(where())->alive);
  EXPECT_GE(CaseStore::open_to_read(where())->records().size(), 1U) << "who only looks may";
  worker.kill();
  EXPECT_FALSE(status_in(where())->alive);
  const auto store = opened();
  EXPECT_EQ(fault(), Error::Kind::conflict) << "also to the same process";
  EXPECT_EQ(fault(), Error::Kind::conflict) << "and asking does not give it away";
  EXPECT_FALSE(Worker(where(), 0).has_begun());
}

TEST_F(StoreFailure, AReaderNeedsNoRightToWrite) {
  fill(2);
  const auto permit = [this](unsigned mode) {
    for (const auto& path : {where() / "cases", where(), folder()})
      std::filesystem::permissions(path, std::filesystem::perms(mode));
  };
  permit(0555);
  EXPECT_TRUE(holds_without_privileges([&] {
    const auto reader = CaseStore::open_to_read(where());
    return reader->records().size() == 2 && reader->holds(hash_of(1));
  }));
  permit(0755);
}

TEST_F(StoreFailure, AFolderThatCannotBeMadeIsAnError) {
  write_file_atomically(where(), "a file", IfExists::replace);
  EXPECT_EQ(fault(), Error::Kind::write_failed);
}

}  // namespace
}  // namespace launchsafe::store

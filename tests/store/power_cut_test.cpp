// What is left of a store when the power goes: whatever was written to a file and not synced is lost. The
// calls below take the place of the system's in this program, SQLite's included, and lose it when the process
// is cut off as it begins to sync for the n-th time.
#include "child_process.hpp"
#include "store_fixture.hpp"

#include <sys/stat.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>

namespace launchsafe::testing {
namespace {

/// A write that is not on disk yet.
struct Unsynced {
  int file = -1;
  off_t place = 0, size_before = 0;
  std::string before;  ///< what it replaced
};

class Power {
 public:
  /// From now on; for this process, which has one thread.
  void fail_at_sync(int number, int report) {
    syncs_left_ = number;
    report_ = report;
  }

  void note_write(int file, off_t place, size_t count) {
    struct stat status {};
    if (syncs_left_ == 0 || place < 0 || ::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return;
    std::string before(count, '\0');
    const ssize_t found = ::pread(file, before.data(), count, place);
    before.resize(found > 0 ? static_cast<std::size_t>(found) : 0);
    unsynced_.push_back({file, place, status.st_size, std::move(before)});
  }

  void note_sync(int file) {
    if (syncs_left_ == 0) return;
    if (--syncs_left_ == 0) cut();
    std::erase_if(unsynced_, [file](const Unsynced& write) { return write.file == file; });
  }

 private:
  [[noreturn]] void cut() {
    const bool loses = !unsynced_.empty();
    for (auto write = unsynced_.rbegin(); write != unsynced_.rend(); ++write) {
      ::syscall(SYS_pwrite64, write->file, write->before.data(), write->before.size(), write->place);
      ::syscall(SYS_ftruncate, write->file, write->size_before);
    }
    if (loses) ::syscall(SYS_write, report_, "L", 1);
    ::kill(::getpid(), SIGKILL);
    ::_exit(1);
  }

  int syncs_left_ = 0, report_ = -1;
  std::vector<Unsynced> unsynced_;
};

Power& power() {
  static Power state;
  return state;
}

}  // namespace
}  // namespace launchsafe::testing

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  launchsafe::testing::power().note_write(file, ::lseek(file, 0, SEEK_CUR), count);
  return ::syscall(SYS_write, file, bytes, count);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off_t place) {
  launchsafe::testing::power().note_write(file, place, count);
  return ::syscall(SYS_pwrite64, file, bytes, count, place);
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t place) {
  return ::pwrite64(file, bytes, count, place);
}
int fsync(int file) {
  launchsafe::testing::power().note_sync(file);
  return static_cast<int>(::syscall(SYS_fsync, file));
}
int fdatasync(int file) {
  launchsafe::testing::power().note_sync(file);
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}
}

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class PowerCut : public StoreFixture {
 protected:
  /// Saves cases and names each once the store has taken it.
  [[noreturn]] static void work(const std::filesystem::path& folder, int sync, int report) {
    power().fail_at_sync(sync, report);
    const auto store = CaseStore::open(folder);
    for (int number = 0; number < 20; ++number) {
      save(*store, number);
      const char name = static_cast<char>(number);
      if (::write(report, &name, 1) != 1) ::_exit(1);
    }
    ::_exit(0);
  }

  /// What such a process said until the power went.
  static std::string said_until_cut(const std::filesystem::path& folder, int sync) {
    std::array<int, 2> report{};
    EXPECT_EQ(::pipe(report.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) work(folder, sync, report[1]);
    ::close(report[1]);
    std::string said(100, '\0');
    std::size_t length = 0;
    for (ssize_t count = 1; count > 0; length += static_cast<std::size_t>(std::max<ssize_t>(0, count)))
      count = ::read(report[0], said.data() + length, said.size() - length);
    ::close(report[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it was cut off";
    said.resize(length);
    return said;
  }
};

TEST_F(PowerCut, LosesNothingThatTheStoreHadTaken) {
  int losses = 0;
  std::size_t most = 0;
  for (int sync = 1; sync <= 40; ++sync) {
    SCOPED_TRACE(sync);
    const std::filesystem::path place = folder() / std::to_string(sync);
    std::string said = said_until_cut(place, sync);
    losses += said.ends_with('L') ? 1 : 0;
    std::erase(said, 'L');
    most = std::max(most, said.size());
    const auto store = CaseStore::open(place);
    for (const char number : said) {
      const std::string hash = hash_of(number);
      EXPECT_EQ(store->record_of(hash)->label, "case " + std::to_string(number));
      EXPECT_TRUE(store->load(hash));
    }
    for (const auto& file : std::filesystem::directory_iterator(place / "cases"))
      EXPECT_TRUE(store->holds(file.path().stem())) << "a file under its name is whole";
    EXPECT_EQ(store->remarks(), std::vector<std::string>{});
  }
  EXPECT_GT(losses, 20) << "most cuts lose something that was written";
  EXPECT_GE(most, 3U);
}

}  // namespace
}  // namespace launchsafe::store

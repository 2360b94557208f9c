// Who may write at the same time.
#include "child_process.hpp"
#include "launchsafe/store/file.hpp"
#include "store_fixture.hpp"

#include <nlohmann/json.hpp>
#include <sqlite3.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class StoreLockTest : public StoreFixture {
 protected:
  /// The message of the conflict; empty when there is none.
  std::string conflict(const std::string& part = {}) const {
    const auto store = try_open(where(), part);
    if (store) return {};
    EXPECT_EQ(store.error().kind, Error::Kind::conflict) << store.error().message;
    return store.error().message;
  }
};

/// Another process that holds a store until it is killed.
class Holder {
 public:
  Holder(const std::filesystem::path& folder, const std::string& part) {
    std::array<int, 2> ready{};
    if (::pipe(ready.data()) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
      const auto store = CaseStore::open(folder, part);
      const char outcome = store ? 'y' : 'n';
      if (::write(ready[1], &outcome, 1) == 1)
        while (true) ::pause();
      ::_exit(1);
    }
    char outcome = 'n';
    holds_ = ::read(ready[0], &outcome, 1) == 1 && outcome == 'y';
    ::close(ready[0]);
    ::close(ready[1]);
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  ~Holder() { kill(); }

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  bool holds() const { return holds_; }
  std::string name() const { return "process " + std::to_string(process_); }

 private:
  pid_t process_ = 0;
  bool holds_ = false;
};

TEST_F(StoreLockTest, ASecondProcessIsToldThatTheStoreIsHeld) {
  Holder holder(where(), "");
  ASSERT_TRUE(holder.holds());
  const std::string message = conflict();
  EXPECT_NE(message.find(where().string()), std::string::npos) << message;
}

TEST_F(StoreLockTest, ClearsItselfWhenItsOwnerIsKilled) {
  Holder holder(where(), "");
  ASSERT_TRUE(holder.holds());
  EXPECT_TRUE(statuses_in(where()).at(0).alive);
  holder.kill();
  EXPECT_FALSE(statuses_in(where()).at(0).alive);
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, IsReleasedWithTheStore) {
  {
    const auto store = opened();
    EXPECT_NE(read_file(where() / "status.json")->find(host_name()), std::string::npos);
    EXPECT_NE(conflict(), "") << "also to the same process";
    EXPECT_NE(conflict(), "") << "and asking does not give it away";
    Holder other(where(), "");
    EXPECT_FALSE(other.holds());
  }
  EXPECT_NE(read_file(where() / "status.json")->find("\"ended\": true"), std::string::npos);
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, AReaderIsToldThatSomebodyWrites) {
  fill(2);
  {
    const auto store = opened();
    store->tell_progress({{"runs_done", 3}, {"runs_running", 1}, {"runs_total", 12}});
    const auto reader = CaseStore::open_to_read(where());
    ASSERT_FALSE(reader);
    EXPECT_EQ(reader.error().kind, Error::Kind::conflict);
    const std::string status = *read_file(where() / "status.json");
    EXPECT_NE(status.find("\"runs_stored\": 2"), std::string::npos) << status;
    EXPECT_NE(status.find("\"runs_running\": 1"), std::string::npos) << status;
  }
  const auto reader = CaseStore::open_to_read(where());
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->records().size(), 2U);
  EXPECT_EQ(conflict(), "") << "who only looks holds nothing";
}

TEST_F(StoreLockTest, AReaderNeedsNoRightToWrite) {
  fill(2);
  for (const auto& path : {folder(), where(), where() / "cases"})
    std::filesystem::permissions(path, std::filesystem::perms(0555));
  const bool reads = holds_without_privileges([&] {
    const auto reader = CaseStore::open_to_read(where());
    return reader && (*reader)->records().size() == 2 && (*reader)->holds(identity_of(1).hash());
  });
  for (const auto& path : {folder(), where(), where() / "cases"})
    std::filesystem::permissions(path, std::filesystem::perms(0755));
  EXPECT_TRUE(reads);
}

/// fcntl() on a file system without locks.
int refuse_lock(int, int, ...) {
  errno = ENOLCK;
  return -1;
}

TEST_F(StoreLockTest, AFileSystemWithoutLocksIsNoOtherProcess) {
  fill(2);
  sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
  system->xSetSystemCall(system, "fcntl", reinterpret_cast<sqlite3_syscall_ptr>(refuse_lock));
  const auto writer = try_open(where(), "");
  const auto reader = CaseStore::open_to_read(where());
  system->xSetSystemCall(system, "fcntl", nullptr);  // the real one again
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().kind, Error::Kind::write_failed) << writer.error().message;
  ASSERT_FALSE(reader);
  EXPECT_EQ(reader.error().kind, Error::Kind::write_failed) << reader.error().message;
}

TEST_F(StoreLockTest, DifferentPartsCoexist) {
  Holder first(where(), "1-of-3");
  Holder second(where(), "2-of-3");
  EXPECT_TRUE(first.holds());
  EXPECT_TRUE(second.holds());
  EXPECT_EQ(conflict("3-of-3"), "");
}

TEST_F(StoreLockTest, APartExcludesTheWhole) {
  Holder first(where(), "1-of-3");
  Holder second(where(), "2-of-3");
  EXPECT_NE(conflict(), "");
  first.kill();
  EXPECT_NE(conflict(), "");
  second.kill();
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, TheWholeAndEqualPartsExcludeAPart) {
  for (const char* held : {"", "1-of-3"}) {
    Holder holder(where(), held);
    ASSERT_TRUE(holder.holds());
    EXPECT_NE(conflict("1-of-3"), "");
  }
}

TEST_F(StoreLockTest, PartsWriteTheirOwnFilesAndTheWholeTakesAllOver) {
  for (int part = 1; part <= 2; ++part) {
    const auto store = opened(fmt::format("{}-of-2", part));
    save(*store, part);
  }
  EXPECT_TRUE(std::filesystem::exists(where() / "study.1-of-2.db"));
  EXPECT_TRUE(std::filesystem::exists(where() / "study.2-of-2.db"));
  EXPECT_FALSE(std::filesystem::exists(results()));
  const auto check = [this](CaseStore& whole) {
    for (int part = 1; part <= 2; ++part) {
      EXPECT_EQ(whole.record_of(identity_of(part).hash())->label, fmt::format("case {}", part));
      EXPECT_TRUE(whole.holds(identity_of(part).hash()));
    }
  };
  check(**CaseStore::open_to_read(where()));
  EXPECT_FALSE(std::filesystem::exists(results())) << "who only looks makes no file";
  check(*opened());
  check(*opened());
  check(*opened("1-of-3"));
}

TEST_F(StoreLockTest, AFolderThatCannotBeMadeIsAnError) {
  ASSERT_FALSE(write_file_atomically(where(), "a file", IfExists::replace));
  const auto store = try_open(where());
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().kind, Error::Kind::write_failed);
}

}  // namespace
}  // namespace launchsafe::store

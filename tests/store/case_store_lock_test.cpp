// Who may write at the same time.
#include "child_process.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "store_fixture.hpp"

#include <array>
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
      const auto store = CaseStore::open(folder, {part, 7, {}});
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

TEST_F(StoreLockTest, ASecondProcessIsToldWhoHoldsTheStore) {
  Holder holder(where(), "");
  ASSERT_TRUE(holder.holds());
  const std::string message = conflict();
  EXPECT_NE(message.find(holder.name()), std::string::npos) << message;
  EXPECT_NE(message.find(host_name()), std::string::npos) << message;
  EXPECT_NE(message.find(where().string()), std::string::npos) << message;
}

TEST_F(StoreLockTest, ClearsItselfWhenItsOwnerIsKilled) {
  Holder holder(where(), "");
  ASSERT_TRUE(holder.holds());
  holder.kill();
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, IsReleasedWithTheStoreAndItsFileStaysEmpty) {
  {
    const auto store = opened();
    EXPECT_NE(read_file(where() / "lock")->find(host_name()), std::string::npos);
    EXPECT_NE(conflict(), "") << "also to the same process";
  }
  EXPECT_EQ(*read_file(where() / "lock"), "");
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, DifferentPartsCoexist) {
  Holder first(where(), "1-of-3");
  Holder second(where(), "2-of-3");
  EXPECT_TRUE(first.holds());
  EXPECT_TRUE(second.holds());
  EXPECT_EQ(conflict("3-of-3"), "");
}

TEST_F(StoreLockTest, APartExcludesTheWholeAndIsNamed) {
  Holder first(where(), "1-of-3");
  Holder second(where(), "2-of-3");
  std::string message = conflict();
  EXPECT_NE(message.find(first.name()), std::string::npos) << message;
  EXPECT_NE(message.find(second.name()), std::string::npos) << message;
  first.kill();
  message = conflict();
  EXPECT_NE(message.find(second.name()), std::string::npos) << message;
  second.kill();
  EXPECT_EQ(conflict(), "");
}

TEST_F(StoreLockTest, TheWholeAndEqualPartsExcludeAPart) {
  for (const char* held : {"", "1-of-3"}) {
    Holder holder(where(), held);
    ASSERT_TRUE(holder.holds());
    EXPECT_NE(conflict("1-of-3").find(holder.name()), std::string::npos) << conflict("1-of-3");
  }
}

TEST_F(StoreLockTest, PartsWriteTheirOwnJournalsAndReadAll) {
  for (int part = 1; part <= 2; ++part) {
    const auto store = opened(fmt::format("{}-of-2", part));
    save(*store, part);
    store->save_answer(fmt::format("0{}", part), "answer");
  }
  EXPECT_TRUE(std::filesystem::exists(where() / "journal.1-of-2.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(where() / "answers.2-of-2.jsonl"));
  EXPECT_FALSE(std::filesystem::exists(where() / "journal.jsonl"));
  const auto whole = opened();
  for (int part = 1; part <= 2; ++part) {
    EXPECT_TRUE(whole->holds(identity_of(part).hash()));
    EXPECT_EQ(whole->answer(fmt::format("0{}", part)), "answer");
  }
}

TEST_F(StoreLockTest, AFolderThatCannotBeMadeIsAnError) {
  ASSERT_FALSE(write_file_atomically(where(), "a file", IfExists::replace));
  const auto store = try_open(where());
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().kind, Error::Kind::write_failed);
}

}  // namespace
}  // namespace launchsafe::store

// What becomes of case files that are not what their records say.
#include "child_process.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class DamagedCase : public StoreFixture {
 protected:
  /// One case is stored, then its file is changed.
  void SetUp() override {
    StoreFixture::SetUp();
    fill(1);
    whole_ = *read_file(file_of(0));
  }

  void overwrite(const std::string& bytes) const { std::ofstream(file_of(0), std::ios::binary) << bytes; }

  /// The file does not count, stays until there is a new result, and is replaced by that.
  void expect_replaced(const std::string& bytes) const {
    overwrite(bytes);
    {
      const auto store = opened();
      EXPECT_FALSE(store->holds(hash_));
      EXPECT_EQ(*read_file(file_of(0)), bytes);
      EXPECT_TRUE(any_contains(store->remarks(), file_of(0).string())) << "the remark names the file";
      save(*store, 0);
      ASSERT_FALSE(store->flush());
      EXPECT_TRUE(store->holds(hash_));
    }
    EXPECT_EQ(*read_file(file_of(0)), whole_);
    EXPECT_TRUE(opened()->holds(hash_));
  }

  std::string whole_;
  const std::string hash_ = identity_of(0).hash();
};

TEST_F(DamagedCase, ATruncatedFileIsReplaced) { expect_replaced(whole_.substr(0, whole_.size() - 1)); }

TEST_F(DamagedCase, AnEmptyFileIsReplaced) { expect_replaced(""); }

TEST_F(DamagedCase, SomethingElseInItsPlaceIsReplacedAndKept) {
  const std::string theirs(whole_.size(), 'x');
  expect_replaced(theirs);
  EXPECT_TRUE(*read_file(file_of(0).string() + ".edited-1") == theirs);
}

TEST_F(DamagedCase, AFlippedBitIsSeen) {
  std::string flipped = whole_;
  flipped[whole_.size() / 2] ^= 4;
  expect_replaced(flipped);
}

TEST_F(DamagedCase, TheResultOfAnotherCaseIsReplaced) {
  {
    const auto store = opened();
    save(*store, 1);
  }
  const std::string other = *read_file(file_of(1));
  expect_replaced(other);
}

TEST_F(DamagedCase, LoadingFindsWhatKeptItsSizeAndTime) {
  struct stat before {};
  ASSERT_EQ(::stat(file_of(0).c_str(), &before), 0);
  std::string flipped = whole_;
  flipped[whole_.size() / 2] ^= 4;
  overwrite(flipped);
  const timespec times[2] = {before.st_atim, before.st_mtim};
  ASSERT_EQ(::utimensat(AT_FDCWD, file_of(0).c_str(), times, 0), 0);
  const auto store = opened();
  EXPECT_TRUE(store->holds(hash_)) << "trusted by its size and time";
  const auto result = store->load(hash_);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, Error::Kind::corrupt);
  EXPECT_FALSE(store->holds(hash_));
  save(*store, 0);
  EXPECT_TRUE(store->load(hash_));
}

TEST_F(DamagedCase, AskingForTheInputFindsItToo) {
  overwrite("garbage");
  const auto store = opened();
  const auto input = store->input_of(hash_);
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().kind, Error::Kind::corrupt);
}

TEST_F(DamagedCase, AFileThatWasOnlyCopiedIsTrustedAfterOneLook) {
  overwrite(whole_);  // the same bytes, another time
  {
    const auto store = opened();
    EXPECT_TRUE(store->holds(hash_));
    EXPECT_EQ(store->load(hash_)->mechanics.wall_time, 61.5);
  }
  struct stat status {};
  ASSERT_EQ(::stat(file_of(0).c_str(), &status), 0);
  const auto entry = opened()->record_of(hash_);
  EXPECT_EQ(entry->file_time, status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec);
  EXPECT_EQ(entry->label, "case 0");
}

TEST_F(DamagedCase, AWholeFileWithoutARecordIsHeld) {
  std::filesystem::remove(results());
  {
    const auto store = opened();
    EXPECT_FALSE(store->record_of(hash_));
    EXPECT_TRUE(store->holds(hash_));
    EXPECT_EQ(store->record_of(hash_)->state, CaseState::done);
    EXPECT_EQ(store->record_of(hash_)->model_version, model_version);
  }
  EXPECT_TRUE(opened()->record_of(hash_)) << "it was recorded";
}

TEST_F(DamagedCase, AFileThatMayNotBeReadIsNotHeldAndStays) {
  std::filesystem::remove(results());
  for (const auto& path : {folder(), where(), where() / "cases"})
    std::filesystem::permissions(path, std::filesystem::perms::all);
  std::filesystem::permissions(file_of(0), std::filesystem::perms::none);
  std::filesystem::remove(where() / "status.json");
  EXPECT_TRUE(holds_without_privileges([&] {
    const auto store = try_open(where());
    return store && !(*store)->holds(hash_) && !(*store)->remarks().empty() &&
           (*store)->load(hash_).error().kind == Error::Kind::unreadable;
  }));
  EXPECT_TRUE(std::filesystem::exists(file_of(0)));
}

}  // namespace
}  // namespace launchsafe::store

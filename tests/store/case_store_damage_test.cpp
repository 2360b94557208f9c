// What becomes of files that are damaged, or of another program.
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <sqlite3.h>

#include <fstream>

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

  /// Loading finds it, the file does not count any more, and a new result takes its place.
  void expect_replaced(const std::string& bytes) const {
    std::ofstream(file_of(0), std::ios::binary) << bytes;
    const auto store = opened();
    const auto result = store->load(hash_);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, Error::Kind::corrupt);
    EXPECT_FALSE(store->holds(hash_));
    EXPECT_TRUE(any_contains(store->remarks(), file_of(0).string())) << "the remark names the file";
    save(*store, 0);
    ASSERT_FALSE(store->flush());
    EXPECT_TRUE(store->holds(hash_));
    EXPECT_EQ(*read_file(file_of(0)), whole_);
  }

  std::string whole_;
  const std::string hash_ = identity_of(0).hash();
};

TEST_F(DamagedCase, ATruncatedFileIsReplaced) { expect_replaced(whole_.substr(0, whole_.size() - 1)); }

TEST_F(DamagedCase, AnEmptyFileIsReplaced) { expect_replaced(""); }

TEST_F(DamagedCase, AFlippedBitIsSeen) {
  std::string flipped = whole_;
  flipped[whole_.size() / 2] ^= 4;
  expect_replaced(flipped);
}

TEST_F(DamagedCase, AWholeFileWithoutARecordIsHeld) {
  std::filesystem::remove(results());
  const auto store = opened();
  EXPECT_FALSE(store->record_of(hash_));
  EXPECT_TRUE(store->holds(hash_));
  EXPECT_TRUE(store->load(hash_));
}

/// A database as another program, or another version of this one, makes it.
void make_database(const std::filesystem::path& path, int application, int version) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const std::string statements = fmt::format(
      "PRAGMA application_id = {}; PRAGMA user_version = {}; CREATE TABLE t (x)", application, version);
  EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

TEST_F(StoreFixture, AResultsFileOfAnotherProgramOrFormatIsRefusedAndStays) {
  std::filesystem::create_directory(where());
  for (const int application : {7, 0x4c534146}) {
    make_database(results(), application, 1);
    const std::string before = *read_file(results());
    const auto store = try_open(where());
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().kind, Error::Kind::conflict) << store.error().message;
    EXPECT_EQ(*read_file(results()), before);
    std::filesystem::remove(results());
  }
}

}  // namespace
}  // namespace launchsafe::store

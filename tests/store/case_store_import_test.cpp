// Taking over what another folder holds.
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <fstream>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class Import : public StoreFixture {
 protected:
  std::filesystem::path there() const { return folder() / "other"; }

  /// Another folder with the cases 0 to 2 and an attempt that failed.
  void SetUp() override {
    StoreFixture::SetUp();
    const auto other = opened_at(there(), "1-of-2");
    for (int number = 0; number < 3; ++number) save(*other, number);
    note(*other, 5, CaseState::timed_out);
  }

  static void note(CaseStore& store, int number, CaseState state) {
    RunRecord entry = record_of(number);
    entry.hash = identity_of(number).hash();
    entry.state = state;
    entry.reason = "for a reason";
    store.note(entry);
  }

  std::filesystem::path file_there(int number) const {
    return there() / "cases" / (identity_of(number).hash() + ".h5");
  }
};

TEST_F(Import, CopiesWholeResultsWithTheirEntries) {
  {
    const auto store = opened();
    save(*store, 1);
    const auto imported = store->import_from(there());
    ASSERT_TRUE(imported) << imported.error().message;
    EXPECT_EQ(imported->cases, 2U);
    EXPECT_EQ(imported->already_there, 1U);
    expect_same(result_of(2), *store->load(identity_of(2).hash()));
  }
  const auto store = opened();
  for (int number = 0; number < 3; ++number) EXPECT_TRUE(store->holds(identity_of(number).hash()));
  EXPECT_EQ(store->load(identity_of(0).hash())->mechanics.wall_time, 61.5);
  EXPECT_EQ(store->record_of(identity_of(0).hash())->label, "case 0");
  EXPECT_EQ(store->record_of(identity_of(5).hash())->state, CaseState::timed_out);
  EXPECT_EQ(*read_file(file_of(0)), *read_file(file_there(0)));
}

TEST_F(Import, TwiceIsAsGoodAsOnce) {
  const auto store = opened();
  ASSERT_TRUE(store->import_from(there()));
  const auto records = store->records();
  const auto again = store->import_from(there());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->cases, 0U);
  EXPECT_EQ(again->already_there, 3U);
  EXPECT_EQ(store->records().size(), records.size());
}

TEST_F(Import, OfItselfDoesNothing) {
  fill(2);
  const auto store = opened();
  const auto imported = store->import_from(folder() / "study" / ".." / "study");
  ASSERT_TRUE(imported);
  EXPECT_EQ(imported->cases + imported->already_there, 0U);
}

TEST_F(Import, AttemptsElsewhereSayNothingOfACaseThatIsDone) {
  const auto store = opened();
  save(*store, 5);
  ASSERT_TRUE(store->import_from(there()));
  EXPECT_EQ(store->record_of(identity_of(5).hash())->state, CaseState::done);
}

TEST_F(Import, IsRefusedWhileAnotherProcessWritesThere) {
  const auto other = opened_at(there(), "1-of-2");
  const auto store = opened();
  const auto imported = store->import_from(there());
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().kind, Error::Kind::conflict);
  EXPECT_NE(imported.error().message.find("in use"), std::string::npos) << imported.error().message;
  EXPECT_TRUE(store->records().empty());
}

TEST_F(Import, AFolderWithoutAStoreIsMissing) {
  const auto store = opened();
  for (const auto& path : {folder() / "nowhere", folder()}) {
    const auto imported = store->import_from(path);
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error().kind, Error::Kind::missing);
  }
}

}  // namespace
}  // namespace launchsafe::store

// Results of earlier programs. `format_1` was written by the program of 2026-11-22: a case, and a journal
// where this program has a results file.
#include "same_case.hpp"
#include "store_fixture.hpp"

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class StoredFormat : public StoreFixture {
 protected:
  static std::filesystem::path stored() {
    return std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) / "tests/store/format_1";
  }
};

TEST_F(StoredFormat, CasesOfTheFirstFormatAreReadBitByBit) {
  std::filesystem::create_directory(where());
  std::filesystem::copy(stored() / "cases", where() / "cases");
  const auto store = opened();
  const std::string hash = identity_of(1).hash();
  ASSERT_TRUE(store->holds(hash));
  const auto result = store->load(hash);
  ASSERT_TRUE(result) << result.error().message;
  run::CaseResult expected = result_of(1);
  expected.mechanics.wall_time = 0;  // which its record would say
  expect_same(expected, *result);
  EXPECT_EQ(*store->input_of(hash), identity_of(1).input());
}

TEST_F(StoredFormat, AFolderWithAJournalIsRefusedWithWhatToDo) {
  std::filesystem::copy(stored(), where(), std::filesystem::copy_options::recursive);
  const auto refused = [](const auto& opened) {
    return !opened && opened.error().kind == Error::Kind::conflict &&
           opened.error().message.find("run the study anew into another folder") != std::string::npos;
  };
  EXPECT_TRUE(refused(try_open(where())));
  EXPECT_TRUE(refused(try_open(where(), "1-of-2")));
  EXPECT_TRUE(refused(CaseStore::open_to_read(where())));
  EXPECT_TRUE(refused(opened_at(folder() / "another")->import_from(where())));
  EXPECT_FALSE(std::filesystem::exists(results()));
}

}  // namespace
}  // namespace launchsafe::store

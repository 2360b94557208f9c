// Case files of the day on which the format was settled: `format_1` was written by the program of 2026-11-28.
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
  // Found without a record, it is still that of the program which made it.
  const auto made = read_manifest(where() / "cases" / (hash + ".h5"));
  ASSERT_TRUE(made);
  EXPECT_EQ(store->record_of(hash)->program, program_of(*made));
  EXPECT_NE(store->record_of(hash)->program, program_of(make_manifest({}, 1)));
  const auto result = store->load(hash);
  ASSERT_TRUE(result) << result.error().message;
  run::CaseResult expected = result_of(1);
  expected.mechanics.wall_time = 0;  // which its record would say
  expect_same(expected, *result);
  EXPECT_EQ(*store->input_of(hash), identity_of(1).input());
}

}  // namespace
}  // namespace launchsafe::store

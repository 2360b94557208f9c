// Stores of earlier programs. `format_1` was written by the program of 2026-11-22: a case, an attempt that
// was timed out, and an answer. The expected values are those that it was given.
#include "same_case.hpp"
#include "store_fixture.hpp"

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class StoredFormat : public StoreFixture {
 protected:
  void SetUp() override {
    StoreFixture::SetUp();
    const auto stored = std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) / "tests/store/format_1";
    std::filesystem::copy(stored, where(), std::filesystem::copy_options::recursive);
  }
};

TEST_F(StoredFormat, CasesOfTheFirstFormatAreReadBitByBit) {
  const auto store = opened();
  const std::string hash = identity_of(1).hash();
  ASSERT_TRUE(store->holds(hash));
  const auto result = store->load(hash);
  ASSERT_TRUE(result) << result.error().message;
  expect_same(result_of(1), *result);
  EXPECT_EQ(*store->input_of(hash), identity_of(1).input());
}

TEST_F(StoredFormat, JournalsAndAnswersOfTheFirstFormatAreRead) {
  const auto store = opened();
  EXPECT_EQ(store->remarks(), std::vector<std::string>{});
  ASSERT_EQ(store->entries().size(), 2U);
  const JournalEntry done = *store->last_entry(identity_of(1).hash());
  EXPECT_EQ(done.state, CaseState::done);
  EXPECT_EQ(done.label, "case 1");
  EXPECT_EQ(done.model_version, model_version);
  EXPECT_EQ(done.wall_time, 61.5);
  EXPECT_EQ(done.processor_time, 60.25);
  EXPECT_EQ(done.predicted_updates, 1e9);
  EXPECT_EQ(done.file_size, 87792U);
  EXPECT_EQ(done.end_time, "2026-11-22T15:40:23Z");
  const JournalEntry timed_out = *store->last_entry(identity_of(2).hash());
  EXPECT_EQ(timed_out.state, CaseState::timed_out);
  EXPECT_EQ(timed_out.reason, "60 s had passed");
  EXPECT_EQ(timed_out.time_limit, 60);
  EXPECT_TRUE(std::isnan(timed_out.predicted_updates));
  EXPECT_EQ(store->answer(identity_of(1).hash()), R"({"verdict": "SAFE"})");
}

}  // namespace
}  // namespace launchsafe::store

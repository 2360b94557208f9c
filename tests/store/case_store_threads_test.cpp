// Many threads on one store.
#include "same_case.hpp"
#include "store_fixture.hpp"

#include <atomic>
#include <thread>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
using StoreThreads = StoreFixture;

constexpr int threads = 8, stored_cases = 24;

/// Every thread saves every case and asks for what any of them may have saved.
void use(CaseStore& store, int thread, std::atomic<int>& faults) {
  for (int step = 0; step < stored_cases; ++step) {
    const int number = (step * 5 + thread * 3) % stored_cases;
    const std::string hash = identity_of(number).hash();
    if (!store.holds(hash)) save(store, number);
    const auto result = store.load(hash);
    if (!result || result->mechanics.end_time != number) ++faults;
    if (!store.record_of(hash) || store.records().empty()) ++faults;
    if (step % 7 == 0 && store.flush()) ++faults;
  }
}

TEST_F(StoreThreads, SaveLoadAndAskAtTheSameTime) {
  std::atomic<int> faults = 0;
  {
    const auto store = opened();
    std::vector<std::thread> team;
    for (int thread = 0; thread < threads; ++thread)
      team.emplace_back([&, thread] { use(*store, thread, faults); });
    for (std::thread& member : team) member.join();
    EXPECT_EQ(store->remarks(), std::vector<std::string>{});
  }
  EXPECT_EQ(faults, 0);
  const auto store = opened();
  EXPECT_EQ(store->records().size(), static_cast<std::size_t>(stored_cases));
  for (int number = 0; number < stored_cases; ++number) {
    EXPECT_TRUE(store->holds(identity_of(number).hash()));
    EXPECT_EQ(store->record_of(identity_of(number).hash())->wall_time, 61.5) << "as it was saved";
  }
}

}  // namespace
}  // namespace launchsafe::store

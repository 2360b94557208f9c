#include "launchsafe/study/run_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace launchsafe::study;

std::vector<double> loads_of(const std::vector<double>& costs, int count) {
  std::vector<double> loads(static_cast<std::size_t>(count));
  const auto shards = shards_of(costs, count);
  for (std::size_t i = 0; i < costs.size(); ++i)
    loads.at(static_cast<std::size_t>(shards[i] - 1)) += costs[i];
  return loads;
}

TEST(Shards, EveryCaseBelongsToExactlyOne) {
  const std::vector<double> costs{3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5};
  const auto shards = shards_of(costs, 4);
  ASSERT_EQ(shards.size(), costs.size());
  for (const int shard : shards) EXPECT_TRUE(shard >= 1 && shard <= 4) << shard;
}

// Longest first to the least loaded ends within 4/3 - 1/(3 m) of the best division (Graham 1969), which is no
// better than the mean or the largest cost.
TEST(Shards, CostsAreBalanced) {
  std::vector<double> costs;
  for (int i = 0; i < 200; ++i) costs.push_back(1.0 + (i * 37) % 101);
  const auto loads = loads_of(costs, 7);
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / 7.0;
  EXPECT_LE(*std::max_element(loads.begin(), loads.end()), 1.02 * mean);
  EXPECT_GE(*std::min_element(loads.begin(), loads.end()), 0.98 * mean);
}

TEST(Shards, MoreShardsThanCasesLeaveSomeEmpty) {
  const auto loads = loads_of({2, 1}, 5);
  EXPECT_EQ(std::count(loads.begin(), loads.end(), 0.0), 3);
}

TEST(Shards, AreReadAsIndexOfCount) {
  Shard shard;
  EXPECT_TRUE(parse_shard("2/4", shard));
  EXPECT_EQ(shard.index, 2);
  EXPECT_EQ(shard.count, 4);
  for (const char* wrong : {"", "2", "0/4", "5/4", "2/0", "-1/4", "2/4x", "2 /4", "1/10001", "a/b", "/"})
    EXPECT_FALSE(parse_shard(wrong, shard)) << wrong;
  EXPECT_EQ(shard.index, 2);  // left as it was
}

}  // namespace

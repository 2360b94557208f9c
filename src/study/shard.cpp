#include "launchsafe/study/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <queue>
#include <utility>

namespace launchsafe::study {

std::string Shard::part() const { return whole() ? std::string{} : fmt::format("{}-of-{}", index, count); }

bool parse_shard(std::string_view text, Shard& shard) {
  constexpr int most_shards = 10000;
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return false;
  const auto whole_number = [](std::string_view digits, int& number) {
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return status == std::errc{} && end == digits.data() + digits.size();
  };
  Shard read;
  if (!whole_number(text.substr(0, slash), read.index) || !whole_number(text.substr(slash + 1), read.count))
    return false;
  if (read.index < 1 || read.index > read.count || read.count > most_shards) return false;
  shard = read;
  return true;
}

std::vector<int> shards_of(const std::vector<double>& costs, int count) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&costs](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  using Load = std::pair<double, int>;  // ties go to the lower shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (int shard = 1; shard <= count; ++shard) least.emplace(0.0, shard);
  std::vector<int> shards(costs.size());
  for (const std::size_t at : order) {
    auto [load, shard] = least.top();
    least.pop();
    shards[at] = shard;
    least.emplace(load + costs[at], shard);
  }
  return shards;
}

}  // namespace launchsafe::study

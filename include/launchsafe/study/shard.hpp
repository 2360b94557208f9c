// A study divided over several processes or machines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::study {

/// Part `index` (from 1) of `count`.
struct Shard {
  int index = 1, count = 1;
  bool whole() const { return count == 1; }
  /// "2-of-4"; empty for the whole.
  std::string part() const;
};

/// "2/4", with 1 <= index <= count <= 10000; nothing for any other text.
bool parse_shard(std::string_view text, Shard& shard);

/// The shard (from 1) of every case such that the shards' costs are nearly equal: the most costly first, each
/// to the shard with the least so far. Depends on the costs and their order alone.
std::vector<int> shards_of(const std::vector<double>& costs, int count);

}  // namespace launchsafe::study

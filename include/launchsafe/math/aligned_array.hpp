// Arrays that start on a cache line, so that reading a Pack never straddles two.
#pragma once

#include <boost/align/aligned_allocator.hpp>

#include <vector>

namespace launchsafe::math {

inline constexpr std::size_t cache_line = 64;
using AlignedArray = std::vector<double, boost::alignment::aligned_allocator<double, cache_line>>;

}  // namespace launchsafe::math

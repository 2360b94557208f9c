// What a text for people says, asked by its names and numbers: how it words them is left to it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace launchsafe::testing {

/// Success where the text has all of these names and numbers, one after the other.
inline ::testing::AssertionResult in_order(std::string_view text,
                                           std::initializer_list<std::string_view> facts) {
  std::size_t from = 0;
  for (const std::string_view fact : facts) {
    const std::size_t at = text.find(fact, from);
    if (at == std::string_view::npos) {
      return ::testing::AssertionFailure() << "\"" << fact << "\" is not where it belongs in:\n" << text;
    }
    from = at + fact.size();
  }
  return ::testing::AssertionSuccess();
}

inline bool has_digits(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char letter) { return letter >= '0' && letter <= '9'; });
}

}  // namespace launchsafe::testing

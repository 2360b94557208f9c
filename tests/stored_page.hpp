// Pages of the program against the stored ones of studies. They are made anew by
// LAUNCHSAFE_REMAKE_PAGES=1 ctest --test-dir build/release -R Walkthrough
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::testing {

/// Words of a text, with every number by itself; what only draws a table's columns is left out.
inline std::vector<std::string> words_of(const std::string& text) {
  static const std::regex word(R"([-+]?\d+\.?\d*(?:e[-+]?\d+)?|[^\s\d]+)");
  std::vector<std::string> words;
  for (std::sregex_iterator each(text.begin(), text.end(), word), end; each != end; ++each)
    if (each->str().find_first_not_of('-') != std::string::npos) words.push_back(each->str());
  return words;
}

/// Numbers may differ by a hundredth between processors, words not at all.
inline bool agrees(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char *end_a = nullptr, *end_b = nullptr;
  const double first = std::strtod(a.c_str(), &end_a), second = std::strtod(b.c_str(), &end_b);
  if (*end_a != '\0' || *end_b != '\0') return false;
  return std::abs(first - second) <= 0.01 * std::max(std::abs(first), std::abs(second));
}

/// Compares a page with the one that a file holds.
inline void expect_stored(const std::string& page, const std::filesystem::path& file) {
  if (std::getenv("LAUNCHSAFE_REMAKE_PAGES") != nullptr) {
    std::ofstream(file) << page;
    return;
  }
  std::ifstream stream(file);
  const std::string stored{std::istreambuf_iterator<char>(stream), {}};
  const std::vector<std::string> expected = words_of(stored), found = words_of(page);
  ASSERT_EQ(expected.size(), found.size()) << page;
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_TRUE(agrees(expected[i], found[i])) << expected[i] << " is " << found[i] << " in\n" << page;
}

}  // namespace launchsafe::testing

// Every series of errors: the observed orders are what the theory of its method says.
#include "series.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

namespace {

using namespace launchsafe::error_of_parts;

class OrdersOfParts : public testing::TestWithParam<ErrorSeries> {};

TEST_P(OrdersOfParts, AreThoseOfTheMethodsTheory) {
  const ErrorSeries& series = GetParam();
  const std::vector<Setting>& settings = series.settings;
  ASSERT_GE(settings.size(), 3U);
  std::vector<double> errors, orders;
  for (const Setting& setting : settings) {
    errors.push_back(std::abs(setting.work()));
    ASSERT_TRUE(std::isfinite(errors.back())) << setting.text;
    const std::size_t k = errors.size() - 1;
    if (k == 0) continue;
    ASSERT_LT(setting.size, settings[k - 1].size);
    orders.push_back(
        order_between(settings[k - 1].size, errors[k - 1], setting.size, errors[k], series.round_off));
  }
  if (std::isinf(series.order)) {  // nothing but round-off at any setting
    for (std::size_t k = 0; k < errors.size(); ++k)
      EXPECT_LE(errors[k], series.round_off) << settings[k].text;
    return;
  }
  if (std::isnan(series.order)) {  // the finest setting still is far better than the coarsest
    EXPECT_LT(errors.back(), 1e-2 * errors.front());
    EXPECT_LT(errors.back(), 1e-4);
    return;
  }
  for (std::size_t k = 1; k < errors.size(); ++k) EXPECT_LT(errors[k], errors[k - 1]) << settings[k].text;
  // The last two orders are averaged: a step control changes its number of steps by whole ones.
  EXPECT_NEAR(0.5 * (orders.back() + orders[orders.size() - 2]), series.order, 0.1) << series.theory;
}

/// "bar_wave_velocity": part and quantity in letters and digits.
std::string series_name(const testing::TestParamInfo<ErrorSeries>& info) {
  std::string name;
  for (const char letter : info.param.part + " " + info.param.quantity) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (plain) name += letter;
    if (!plain && !name.empty() && name.back() != '_') name += '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Parts, OrdersOfParts, testing::ValuesIn(error_series()), series_name);

}  // namespace

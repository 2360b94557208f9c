#include "series.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace launchsafe::error_of_parts {

std::vector<ErrorSeries> error_series() {
  std::vector<ErrorSeries> all;
  for (const auto& topic : {skin_series(), solid_series(), mechanics_series()})
    all.insert(all.end(), topic.begin(), topic.end());
  return all;
}

double order_between(double coarse_size, double coarse_error, double fine_size, double fine_error,
                     double round_off) {
  if (!(fine_error > round_off)) return no_order;
  return std::log(coarse_error / fine_error) / std::log(coarse_size / fine_size);
}

Setting with_steps(double duration, int steps, std::function<double()> work) {
  const double step = duration / steps;
  const auto [per_second, unit] = step < 0.999e-6   ? std::pair{1e9, "ns"}
                                  : step < 0.999e-3 ? std::pair{1e6, "us"}
                                                    : std::pair{1e3, "ms"};
  return {fmt::format("step {:.3g} {}", per_second * step, unit), step, std::move(work)};
}

Setting with_cell(double cell, std::function<double()> work) {
  const bool small = cell < 1e-4;
  return {fmt::format("cell {:g} {}", small ? 1e6 * cell : 1e3 * cell, small ? "um" : "mm"), cell,
          std::move(work)};
}

}  // namespace launchsafe::error_of_parts

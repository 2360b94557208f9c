#include "launchsafe/verify/error_against_time.hpp"

#include "error_settings.hpp"
#include "launchsafe/run/processor_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace launchsafe::verify {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
/// What a batch of repeated work takes at least, s: a thousand ticks of a clock of microseconds.
constexpr double shortest_batch = 2e-3;
constexpr int batches = 3;

double time_of(const std::function<void()>& work, long repetitions) {
  const double start = run::thread_processor_time();
  for (long k = 0; k < repetitions; ++k) work();
  return run::thread_processor_time() - start;
}

/// NaN where the finer error is of round-off, which does not depend on the method.
double order_between(const MeasuredSetting& coarse, const MeasuredSetting& fine, double round_off) {
  if (!(fine.error > round_off)) return not_a_number;
  return std::log(coarse.error / fine.error) / std::log(coarse.size / fine.size);
}

/// Least processor time (s) that one call takes. Short work is repeated until a clock can see it.
double least_processor_time(const std::function<void()>& work) {
  long repetitions = 1;
  double batch = time_of(work, repetitions);
  while (batch < shortest_batch) {
    const double growth = batch > 0.0 ? std::clamp(1.2 * shortest_batch / batch, 2.0, 100.0) : 100.0;
    repetitions = std::lround(std::ceil(growth * static_cast<double>(repetitions)));
    batch = time_of(work, repetitions);
  }
  for (int k = 1; k < batches; ++k) batch = std::min(batch, time_of(work, repetitions));
  return batch / static_cast<double>(repetitions);
}

/// "10 us", "0.5 ms"; of a time in s.
std::string time_text(double time) {
  if (time < 0.999e-6) return fmt::format("{:.3g} ns", 1e9 * time);
  if (time < 0.999e-3) return fmt::format("{:.3g} us", 1e6 * time);
  return fmt::format("{:.3g} ms", 1e3 * time);
}

}  // namespace

Setting with_steps(double duration, int steps, std::function<double()> work) {
  const double step = duration / steps;
  return {"step " + time_text(step), step, std::move(work)};
}

Setting with_cell(double cell, std::function<double()> work) {
  const bool small = cell < 1e-4;
  return {fmt::format("cell {:g} {}", small ? 1e6 * cell : 1e3 * cell, small ? "um" : "mm"), cell,
          std::move(work)};
}

std::vector<MeasuredSetting> measured(const ErrorSeries& series) {
  std::vector<MeasuredSetting> rows;
  for (const Setting& setting : series.settings()) {
    MeasuredSetting row{setting.text, setting.size, not_a_number, not_a_number, not_a_number};
    row.processor_time = least_processor_time([&] { row.error = std::abs(setting.work()); });
    if (!rows.empty()) row.order = order_between(rows.back(), row, series.round_off);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ErrorSeries> error_series() {
  std::vector<ErrorSeries> all;
  for (const auto& topic :
       {skin_series(), solid_series(), conduction_series(), wave_series(), flight_series(), shape_series()})
    all.insert(all.end(), topic.begin(), topic.end());
  return all;
}

}  // namespace launchsafe::verify

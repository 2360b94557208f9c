#include "launchsafe/report/combustion_table.hpp"

#include "launchsafe/report/quantities.hpp"

#include <algorithm>

namespace launchsafe::report {
namespace {

std::string end_of(const run::CombustionHistory& combustion) {
  switch (combustion.end) {
    case run::CombustionEnd::time:
      return "time after ignition";
    case run::CombustionEnd::pressure:
      return "stop pressure";
    case run::CombustionEnd::broke_off:
      return "broke off: " + combustion.reason;
    case run::CombustionEnd::burnt_through:
      return "charge burnt through";
  }
  return "";
}

double last_of(const std::vector<double>& values) { return values.empty() ? 0.0 : values.back(); }

}  // namespace

BurntState burnt_state_of(const run::CombustionHistory& c) {
  return {1e3 * last_of(c.burnt_mass), 1e-3 * last_of(c.released),
          c.pressure.empty() ? 0.0 : 1e-6 * *std::max_element(c.pressure.begin(), c.pressure.end())};
}

Table combustion_table(const run::CaseResult& result) {
  Table table{"After ignition, with two-way coupling",
              {quantity::gap(), significant_column("flame in the skin", "m/s", 3, "skin_flame_speed_m_per_s"),
               significant_column("behind it", "m/s", 3, "bulk_flame_speed_m_per_s"),
               quantity::skin_burnt_time(), quantity::burnt_mass(), quantity::gas_volume(),
               quantity::gas_temperature(), quantity::bottom_pressure_max(), quantity::heat_released(),
               significant_column("kept back", "kJ", 3, "heat_kept_back_kJ"),
               significant_column("brought", "kJ", 3, "heat_brought_kJ"), quantity::combustion_residual(),
               quantity::energy_drift(), named_text("ended by", "combustion_end"),
               number_column("wall time", "s", 1, "wall_time_s")},
              {}};
  for (const run::GapResult& gap : result.gaps) {
    if (!gap.combustion) continue;
    const run::CombustionHistory& c = *gap.combustion;
    const BurntState state = burnt_state_of(c);
    table.rows.push_back({100.0 * gap.gap, c.skin_flame_speed, c.bulk_flame_speed,
                          optional_number(1e3 * c.complete_time), state.burnt_mass,
                          1e6 * last_of(c.gas_volume), last_of(c.gas_temperature), state.highest_pressure,
                          state.released, 1e-3 * last_of(c.kept_back), 1e-3 * last_of(c.brought),
                          c.energy_residual, c.energy_drift, end_of(c), c.wall_time});
  }
  if (table.rows.empty()) return table;
  table.notes = {
      "At the end of the run; p max is the largest over it. Released and kept back: of the heat of reaction "
      "of "
      "what had burnt. Brought: heat above the initial temperature that it had before, from air, friction "
      "and "
      "slow reaction.",
      "The flame lives on conduction alone. Friction heats by the closure and the localisation of the "
      "launch, "
      "which are not calibrated for the motion that the gas causes: how fast burning spreads over the bottom "
      "is "
      "a result of the model, and no prediction."};
  return table;
}

Table combustion_history_table(const run::CombustionHistory& c, double gap, std::size_t rows) {
  Table table{fmt::format("History of the combustion at {:.6g} cm", 100.0 * gap),
              {number_column("time", "ms", 3, "time_ms"),
               number_column("largest reaction degree", "", 3, "reaction_degree_max"),
               number_column("largest depth", "mm", 4, "burnt_depth_mm"), quantity::burnt_mass(),
               quantity::gas_volume(), quantity::gas_temperature(),
               number_column("p bottom", "MPa", 1, "bottom_pressure_MPa"), quantity::heat_released()},
              {}};
  if (c.time.empty() || rows == 0) return table;
  const std::size_t stations = c.reaction_degree.size() / c.time.size();
  const std::size_t stride = std::max<std::size_t>(1, (c.time.size() + rows - 1) / rows);
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    const bool last = i + 1 == c.time.size();
    if (i % stride != 0 && !last) continue;
    const auto begin = c.reaction_degree.begin() + static_cast<std::ptrdiff_t>(i * stations);
    const double degree =
        stations > 0 ? *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(stations)) : 0.0;
    table.rows.push_back({1e3 * c.time[i], degree, 1e3 * c.burnt_depth[i], 1e3 * c.burnt_mass[i],
                          1e6 * c.gas_volume[i], c.gas_temperature[i], 1e-6 * c.pressure[i],
                          1e-3 * c.released[i]});
  }
  return table;
}

}  // namespace launchsafe::report

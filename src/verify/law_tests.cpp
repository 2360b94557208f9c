#include "law_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace launchsafe::verify {

namespace law_tests {

void Bounds::at_most(const std::string& what, double value, double bound) {
  const auto known =
      std::find_if(measures_.begin(), measures_.end(), [&](const Measure& m) { return m.what == what; });
  if (known == measures_.end()) {
    measures_.push_back({what, value, bound});
    return;
  }
  // Written so that NaN is the worst; without a bound above 0 the value itself is compared.
  const bool shares = known->bound > 0.0 && bound > 0.0;
  const bool smaller =
      shares ? value / bound <= known->value / known->bound : value - bound <= known->value - known->bound;
  if (!smaller && known->good()) *known = {what, value, bound};
}

void Bounds::never(const std::string& fault, bool happened) {
  if (happened && std::find(faults_.begin(), faults_.end(), fault) == faults_.end()) faults_.push_back(fault);
}

void Bounds::caught(const std::string& reason) {
  if (std::find(reasons_.begin(), reasons_.end(), reason) == reasons_.end()) reasons_.push_back(reason);
}

Finding Bounds::finding() const {
  std::string broken, kept;
  const auto add = [](std::string& text, const std::string& part) {
    if (!text.empty()) text += "; ";
    text += part;
  };
  for (const std::string& fault : faults_) add(broken, fault);
  for (const Measure& m : measures_) {
    add(m.good() ? kept : broken,
        fmt::format("{} {:.3g} ({} {:.3g})", m.what, m.value, m.good() ? "at most" : "beyond", m.bound));
  }
  if (!broken.empty()) return {Outcome::wrong, broken};
  for (const std::string& reason : reasons_) add(kept, reason);
  if (kept.empty()) return {Outcome::wrong, "nothing was measured"};
  return {reasons_.empty() ? Outcome::held : Outcome::caught, kept};
}

std::string duration_text(double seconds) {
  if (std::isinf(seconds)) return "infinity";
  static constexpr std::array<const char*, 5> units{"s", "ms", "us", "ns", "ps"};
  std::size_t unit = 0;
  double value = seconds;
  while (value < 0.9995 && unit + 1 < units.size()) {
    value *= 1e3;
    ++unit;
  }
  return fmt::format("{:.4g} {}", value, units[unit]);
}

materials::ViscoScramDissipation<double> advance_solid(const Solid& solid, double dt, SolidState& state,
                                                       math::Deviator<double> strain, double pressure) {
  return materials::visco_scram_update<double>(solid, materials::relaxation(solid, dt), state, strain,
                                               pressure);
}

}  // namespace law_tests

std::vector<StressTest> law_stress_tests() {
  std::vector<StressTest> all;
  for (const auto topic : {law_tests::explosion_tests, law_tests::exchange_tests, law_tests::film_tests,
                           law_tests::relaxation_tests, law_tests::growth_tests, law_tests::conduction_tests,
                           law_tests::steel_tests, law_tests::charge_pressure_tests, law_tests::gas_tests,
                           law_tests::denormal_tests}) {
    for (law_tests::LawTest& test : topic())
      all.push_back({std::move(test.group), std::move(test.name), std::move(test.must_hold),
                     [assess = std::move(test.assess)] {
                       law_tests::Bounds bounds;
                       assess(bounds);
                       return bounds.finding();
                     }});
  }
  return all;
}

}  // namespace launchsafe::verify

#include "hard_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace launchsafe::verify {

namespace hard {

void Judge::at_most(const std::string& what, double value, double bound) {
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

void Judge::never(const std::string& fault, bool happened) {
  if (happened && std::find(faults_.begin(), faults_.end(), fault) == faults_.end()) faults_.push_back(fault);
}

void Judge::caught(const std::string& reason) {
  if (std::find(reasons_.begin(), reasons_.end(), reason) == reasons_.end()) reasons_.push_back(reason);
}

Finding Judge::finding() const {
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
  // A case that measured nothing has shown nothing.
  if (kept.empty()) return {Outcome::wrong, "nothing was measured"};
  return {reasons_.empty() ? Outcome::held : Outcome::caught, kept};
}

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
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

}  // namespace hard

std::vector<HardCase> hard_laws() {
  std::vector<HardCase> all;
  for (const auto topic :
       {hard::explosion_cases, hard::exchange_cases, hard::film_cases, hard::relaxation_cases,
        hard::growth_cases, hard::conduction_cases, hard::steel_cases, hard::charge_pressure_cases,
        hard::gas_cases, hard::denormal_cases}) {
    for (HardCase& hard_case : topic()) all.push_back(std::move(hard_case));
  }
  return all;
}

}  // namespace launchsafe::verify

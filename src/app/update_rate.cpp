#include "update_rate.hpp"

#include "launchsafe/run/run_case.hpp"
#include "signals.hpp"

#include <atomic>
#include <chrono>

namespace launchsafe::app {

using namespace std::chrono_literals;

double measured_update_rate(const scene::Scene& scene) {
  std::atomic<bool> enough{false};
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &enough;
  options.progress = [&](double) {
    if (std::chrono::steady_clock::now() - start > 300ms || stop_requested()) enough = true;
  };
  const run::MechanicsResult result = run::run_mechanics(scene, options);
  return stop_requested() ? 0.0 : result.update_rate();
}

}  // namespace launchsafe::app

#include "launchsafe/verify/static_stress_comparison.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::verify {
namespace {

/// Written so that no number misses too.
bool exceeds(double value, double limit) { return !(std::abs(value) <= limit); }

void assess_points(const StaticComparison& comparison, const ParticleMeans& mesh, const std::string& where,
                   const StressTargets& targets, std::vector<std::string>& missed) {
  for (std::size_t k = 0; k < comparison.compared.stations.size(); ++k) {
    const StressStation& station = comparison.compared.stations[k];
    const double allowed = station.r <= targets.inner_radius + 1e-9 ? targets.inner : targets.outer;
    const auto compare = [&](const char* what, double found, double expected) {
      const double error = found / expected - 1.0;
      if (!exceeds(error, allowed)) return;
      missed.push_back(fmt::format("{}: {} at {} is {:.5g} MPa, {:+.2f} % from {:.5g} MPa; allowed: {:.3g} %",
                                   where, what, station.name, found / 1e6, 100.0 * error, expected / 1e6,
                                   100.0 * allowed));
    };
    const StressMeasures &mean = mesh.means[k], &reference = comparison.reference()[k];
    compare("pressure", mean.pressure, reference.pressure);
    compare("von Mises stress", mean.von_mises, reference.von_mises);
  }
}

}  // namespace

std::vector<std::string> missed_targets(const StaticComparison& comparison) {
  const StressTargets& targets = comparison.compared.targets;
  std::vector<std::string> missed;
  for (const ParticleMeans& mesh : comparison.meshes) {
    const std::string where =
        fmt::format("{}, cells of {:.4g} mm", comparison.compared.name, 1e3 * mesh.cell_size);
    if (!mesh.failure.empty()) {
      missed.push_back(where + ": " + mesh.failure);
      continue;
    }
    assess_points(comparison, mesh, where, targets, missed);
    const bool charge = scene::has_charge(comparison.compared.scene);
    if (charge && exceeds(mesh.alternation, targets.alternation))
      missed.push_back(fmt::format("{}: the pressure alternates by {:.3g} % rms; allowed: {:.3g} %", where,
                                   100.0 * mesh.alternation, 100.0 * targets.alternation));
    const double still = targets.ringing_share * targets.inner;
    for (const double ringing : {mesh.ringing_pressure, mesh.ringing_von_mises})
      if (exceeds(ringing, still))
        missed.push_back(fmt::format("{}: it still moves, by {:.3g} %; allowed: {:.3g} %", where,
                                     100.0 * ringing, 100.0 * still));
  }
  return missed;
}

}  // namespace launchsafe::verify

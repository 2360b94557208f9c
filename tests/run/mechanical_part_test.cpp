#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "scene/perturbed_scenes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace launchsafe::run {
namespace {

/// All bits of a mechanical run but its wall time, one number a line of the comparison.
class Bits {
 public:
  explicit Bits(const MechanicsResult& result) {
    whole({static_cast<std::uint64_t>(result.status), result.steps, result.particles});
    text(result.reason);
    add({result.end_time, mass_of(result, "steel"), mass_of(result, "charge")});
    trace(result.trace);
    for (const MonitorSample& sample : result.monitor) monitor(sample);
    for (const Snapshot& snapshot : result.snapshots) fields(snapshot);
    const LimiterCounts& counts = result.limiters;
    whole({counts.crack_at_bound, counts.tension_cutoff, counts.hugoniot_guard});
  }
  friend bool operator==(const Bits&, const Bits&) = default;
  std::size_t size() const { return bits_.size(); }

 private:
  void whole(const std::vector<std::uint64_t>& values) {
    bits_.insert(bits_.end(), values.begin(), values.end());
  }
  void add(const std::vector<double>& values) {
    bits_.push_back(values.size());
    for (const double value : values) bits_.push_back(std::bit_cast<std::uint64_t>(value));
  }
  void text(const std::string& letters) {
    bits_.push_back(letters.size());
    for (const char letter : letters) bits_.push_back(static_cast<unsigned char>(letter));
  }
  void trace(const trace::BottomTrace& bottom) {
    for (const auto& station : bottom.stations) {
      text(station.name);
      add({station.x, station.r, station.area});
      bits_.push_back(station.observation);
    }
    for (const auto* values : {&bottom.time, &bottom.chamber_pressure, &bottom.bottom_pressure,
                               &bottom.mean_chamber_pressure, &bottom.mean_bottom_pressure})
      add(*values);
    for (const auto& friction : bottom.friction) add(friction);
  }
  void monitor(const MonitorSample& sample) {
    const EnergyBalance& energy = sample.energy;
    add({sample.time, sample.time_step, energy.kinetic, energy.internal, energy.external, energy.body_force,
         energy.damping, energy.plastic, energy.viscous, energy.crack, sample.largest_plastic_strain,
         sample.largest_crack_radius, sample.momentum});
  }
  void fields(const Snapshot& shot) {
    add({shot.time});
    for (const auto* values : {&shot.x, &shot.r, &shot.velocity_x, &shot.velocity_r, &shot.density,
                               &shot.pressure, &shot.von_mises, &shot.temperature})
      add(*values);
    for (const auto& [name, values] : shot.state) add(values);
    for (const int body : shot.body) bits_.push_back(static_cast<std::uint64_t>(body));
  }

  std::vector<std::uint64_t> bits_;
};

Bits bits_of(const scene::Scene& scene) { return Bits(run_mechanics(scene)); }

TEST(MechanicalPart, RunsToTheSameBits) {
  for (const auto& [name, file] : scene::quick_scenes()) {
    const MechanicsResult whole = run_mechanics(file.scene);
    EXPECT_EQ(whole.status, RunStatus::completed) << name << ": " << whole.reason;
    EXPECT_GT(Bits(whole).size(), 1000u) << name;
    EXPECT_TRUE(Bits(whole) == bits_of(scene::mechanical_part(file.scene))) << name;
  }
}

TEST(MechanicalPart, KeysThatItLeavesOutChangeNoBit) {
  for (const auto& [name, file] : scene::quick_scenes()) {
    const Bits bits = bits_of(file.scene);
    for (const auto& key : scene::scene_keys()) {
      if (!scene::is_dropped(file, key)) continue;
      for (const scene::SceneFile& other : scene::perturbed(file, key))
        EXPECT_TRUE(bits_of(other.scene) == bits) << name << ", " << key.name;
    }
  }
}

}  // namespace
}  // namespace launchsafe::run

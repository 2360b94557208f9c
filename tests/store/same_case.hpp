// Whether two results are the same, bit by bit.
#pragma once

#include "launchsafe/run/case_result.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace launchsafe::testing {

inline std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double value : values) result.push_back(std::bit_cast<std::uint64_t>(value));
  return result;
}

inline void expect_same(const trace::BottomTrace& a, const trace::BottomTrace& b) {
  ASSERT_EQ(a.stations.size(), b.stations.size());
  for (std::size_t i = 0; i < a.stations.size(); ++i) {
    EXPECT_EQ(a.stations[i].name, b.stations[i].name);
    EXPECT_EQ(bits({a.stations[i].x, a.stations[i].r, a.stations[i].area}),
              bits({b.stations[i].x, b.stations[i].r, b.stations[i].area}));
    EXPECT_EQ(a.stations[i].observation, b.stations[i].observation);
  }
  EXPECT_EQ(bits(a.time), bits(b.time));
  EXPECT_EQ(bits(a.chamber_pressure), bits(b.chamber_pressure));
  EXPECT_EQ(bits(a.bottom_pressure), bits(b.bottom_pressure));
  EXPECT_EQ(bits(a.mean_bottom_pressure), bits(b.mean_bottom_pressure));
  EXPECT_EQ(bits(a.friction), bits(b.friction));
}

inline std::vector<double> numbers_of(const run::MonitorSample& sample) {
  std::vector<double> numbers{sample.time, sample.time_step, sample.momentum, sample.largest_plastic_strain,
                              sample.largest_crack_radius};
  for (const auto& term : run::energy_terms) numbers.push_back(sample.energy.*term.member);
  return numbers;
}

inline void expect_same(const run::Snapshot& a, const run::Snapshot& b) {
  EXPECT_EQ(bits({a.time}), bits({b.time}));
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(bits(a.x), bits(b.x));
  EXPECT_EQ(bits(a.r), bits(b.r));
  EXPECT_EQ(bits(a.velocity_x), bits(b.velocity_x));
  EXPECT_EQ(bits(a.velocity_r), bits(b.velocity_r));
  for (const run::SnapshotField& field : run::snapshot_fields())
    EXPECT_EQ(bits(values_of(a, field)), bits(values_of(b, field))) << field.name;
  EXPECT_EQ(a.events, b.events);
  EXPECT_EQ(bits(a.bottom_x), bits(b.bottom_x));
  EXPECT_EQ(bits(a.bottom_r), bits(b.bottom_r));
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (std::size_t i = 0; i < a.skins.size(); ++i) {
    EXPECT_EQ(bits({a.skins[i].gap}), bits({b.skins[i].gap}));
    EXPECT_EQ(bits(a.skins[i].temperature), bits(b.skins[i].temperature));
    EXPECT_EQ(bits(a.skins[i].reaction_degree), bits(b.skins[i].reaction_degree));
  }
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].body, b.faces[i].body);
    for (const auto values :
         {&run::FaceSnapshot::x, &run::FaceSnapshot::r, &run::FaceSnapshot::slip,
          &run::FaceSnapshot::pressure, &run::FaceSnapshot::shear, &run::FaceSnapshot::opening})
      EXPECT_EQ(bits(a.faces[i].*values), bits(b.faces[i].*values));
  }
}

inline void expect_same(const run::MechanicsResult& a, const run::MechanicsResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.particles, b.particles);
  EXPECT_EQ(bits({a.end_time, a.wall_time, a.yielded_wall}), bits({b.end_time, b.wall_time, b.yielded_wall}));
  ASSERT_EQ(a.masses.size(), b.masses.size());
  for (std::size_t i = 0; i < a.masses.size(); ++i) {
    EXPECT_EQ(a.masses[i].material, b.masses[i].material);
    EXPECT_EQ(bits({a.masses[i].mass}), bits({b.masses[i].mass}));
  }
  EXPECT_TRUE(a.limiters == b.limiters);
  ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
  for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
    EXPECT_EQ(a.interfaces[i].body, b.interfaces[i].body);
    EXPECT_EQ(bits({a.interfaces[i].overlap}), bits({b.interfaces[i].overlap}));
  }
  expect_same(a.trace, b.trace);
  ASSERT_EQ(a.monitor.size(), b.monitor.size());
  for (std::size_t i = 0; i < a.monitor.size(); ++i) {
    EXPECT_EQ(bits(numbers_of(a.monitor[i])), bits(numbers_of(b.monitor[i])));
  }
  ASSERT_EQ(a.snapshots.size(), b.snapshots.size());
  for (std::size_t i = 0; i < a.snapshots.size(); ++i) expect_same(a.snapshots[i], b.snapshots[i]);
}

inline void expect_same(const std::optional<surface::Ignition>& a,
                        const std::optional<surface::Ignition>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(bits({a->time, a->chemical_share}), bits({b->time, b->chemical_share}));
  EXPECT_EQ(a->station, b->station);
  EXPECT_EQ(a->cause, b->cause);
}

inline void expect_same(const run::GapResult& a, const run::GapResult& b) {
  EXPECT_EQ(bits({a.air.taken, a.air.supplied}), bits({b.air.taken, b.air.supplied}));
  EXPECT_EQ(bits({a.gap, a.skin.gap}), bits({b.gap, b.skin.gap}));
  EXPECT_EQ(bits({a.at_points.temperature, a.at_points.time, a.at_stations.temperature, a.at_stations.time}),
            bits({b.at_points.temperature, b.at_points.time, b.at_stations.temperature, b.at_stations.time}));
  EXPECT_EQ(a.at_points.station, b.at_points.station);
  EXPECT_EQ(a.at_stations.station, b.at_stations.station);
  EXPECT_EQ(bits(a.skin.time), bits(b.skin.time));
  EXPECT_EQ(bits(a.skin.air_temperature), bits(b.skin.air_temperature));
  EXPECT_EQ(bits(a.skin.temperature), bits(b.skin.temperature));
  expect_same(a.skin.ignition, b.skin.ignition);
  ASSERT_EQ(a.combustion.has_value(), b.combustion.has_value());
  if (!a.combustion) return;
  ASSERT_EQ(a.combustion->snapshots.size(), b.combustion->snapshots.size());
  for (std::size_t i = 0; i < a.combustion->snapshots.size(); ++i)
    expect_same(a.combustion->snapshots[i], b.combustion->snapshots[i]);
}

inline void expect_same(const run::CaseResult& a, const run::CaseResult& b) {
  expect_same(a.mechanics, b.mechanics);
  ASSERT_EQ(a.gaps.size(), b.gaps.size());
  for (std::size_t i = 0; i < a.gaps.size(); ++i) expect_same(a.gaps[i], b.gaps[i]);
}

}  // namespace launchsafe::testing

// Small launches whose pictures tests look at.
#pragma once

#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

namespace launchsafe::report {
/// A charge in a wall on a base; a slender one has its bottom enlarged.
inline scene::Scene cased_charge(double length = 0.02) {
  scene::Scene scene;
  scene.title = "a cased charge";
  scene.bodies = {{"charge", "charge", 0.0, length, 0.0, 0.01},
                  {"wall", "steel", 0.0, length, 0.01, 0.015},
                  {"base", "steel", length, length + 0.01, 0.0, 0.015}};
  scene.load.duration = 4e-5;
  scene.load.peak = 100e6;
  scene.load.peak_time = 4e-5;
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.exponent = 2.0;
  scene.numerics.cell_size = 2.5e-3;
  scene.numerics.energy_drift_limit = 0.5;
  scene.output.trace_interval = 2e-6;
  scene.output.snapshot_times = {4e-5, 0.0, 2e-5};
  scene.surface.gaps = {0.0, 1e-4, 4e-4};
  return scene;
}

/// A scene with what it came to.
struct RunScene {
  scene::Scene scene;
  run::CaseResult result;

  explicit RunScene(scene::Scene of) : scene(std::move(of)), result(run::run_case(scene)) {}
  DrawnCase drawn(std::vector<double> times = {}) const { return {scene, result, std::move(times)}; }
};

inline const PictureKind& kind(const std::string& word) {
  const auto& kinds = picture_kinds();
  return *std::find_if(kinds.begin(), kinds.end(),
                       [&](const PictureKind& each) { return each.word == word; });
}

inline std::vector<Picture> pictures(const DrawnCase& drawn, const std::string& word) {
  EXPECT_EQ(kind(word).lacks(drawn), "");
  return kind(word).pictures(drawn);
}

inline std::vector<std::string> files(const std::vector<Picture>& drawn) {
  std::vector<std::string> names;
  for (const Picture& picture : drawn) names.push_back(picture.file);
  return names;
}

inline const Plot& plot_of(const std::vector<Picture>& drawn, const std::string& file) {
  for (const Picture& picture : drawn)
    if (picture.file == file) return std::get<Plot>(picture.drawing);
  ADD_FAILURE() << "no picture " << file;
  static const Plot none;
  return none;
}

}  // namespace launchsafe::report

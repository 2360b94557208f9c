// What a study will run and what that will cost.
#pragma once

#include "launchsafe/study/read_study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

/// The work of a study, from the plans of its scenes.
struct StudyCost {
  std::size_t runs = 0;           ///< mechanical runs
  std::size_t confirmations = 0;  ///< complete coupled runs, at most
  std::size_t gaps = 0;           ///< listed, for every run; the bisection adds some
  int jobs = 1;                   ///< runs at a time
  double updates = 0;             ///< particle updates of all runs
  double memory = 0;              ///< bytes, of `jobs` of the largest runs
  double time = 0;                ///< s of wall time
};

/// At an update rate (particle updates per second, > 0).
StudyCost cost_of(const study::StudyFile& file, double update_rate, int jobs);

std::string study_text(const study::StudyFile& file, const StudyCost& cost, double update_rate);
nlohmann::ordered_json study_json(const study::StudyFile& file, const StudyCost& cost, double update_rate);

}  // namespace launchsafe::app

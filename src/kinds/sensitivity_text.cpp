#include "sensitivity_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

std::string name_of(math::Design design) {
  switch (design) {
    case math::Design::monte_carlo:
      return "independent random points";
    case math::Design::latin_hypercube:
      return "a Latin hypercube";
    case math::Design::scrambled_sobol:
      break;
  }
  return "a scrambled Sobol sequence";
}

std::string interval_text(const study::Study& study) {
  return fmt::format("{}% intervals from a bootstrap of {} resamples, seed {}",
                     significant(100.0 * settings_of<SensitivitySettings>(study).confidence, 6),
                     settings_of<SensitivitySettings>(study).resamples,
                     settings_of<SensitivitySettings>(study).seed);
}

}  // namespace

ShownOutput shown_output(SensitivityOutput output) {
  const std::string key = to_string(output);
  switch (output) {
    case SensitivityOutput::maximum_temperature:
      return {"T max", "T max", key, "K", 1.0};
    case SensitivityOutput::critical_gap:
      return {"critical gap", "the critical gap", key, "cm", 100.0};
    case SensitivityOutput::margin:
      break;
  }
  return {"margin", "the margin", key, "K", 1.0};
}

std::string at_gap(const study::Study& study, SensitivityOutput output) {
  if (output == SensitivityOutput::critical_gap || study.gaps.empty()) return {};
  return " at a gap of " + centimetres(study.gaps.front());
}

std::string reason_of(const SensitivityResult& result, const OutputSensitivity& output) {
  if (!output.reason.empty()) return output.reason;
  const std::vector<math::Estimate> importance = importance_of(result, output);
  const bool any = std::any_of(importance.begin(), importance.end(),
                               [](const math::Estimate& each) { return std::isfinite(each.value); });
  return any ? std::string{} : "too few evaluations have a number";
}

bool has_indices(const SensitivityResult& result, const OutputSensitivity& output) {
  return reason_of(result, output).empty();
}

std::size_t size_of(const study::Study& study) {
  return static_cast<std::size_t>(settings_of<SensitivitySettings>(study).method == SensitivityMethod::sobol
                                      ? settings_of<SensitivitySettings>(study).samples
                                      : settings_of<SensitivitySettings>(study).trajectories);
}

std::string size_noun(const study::Study& study) {
  return settings_of<SensitivitySettings>(study).method == SensitivityMethod::sobol ? "rows" : "trajectories";
}

std::string method_text(const SensitivityResult& result) {
  const study::Study& study = result.study.study;
  const std::size_t evaluations = result.answers.size();
  if (settings_of<SensitivitySettings>(study).method == SensitivityMethod::sobol) {
    std::string text = fmt::format(
        "Sobol indices (first order: Saltelli 2010, total order: Jansen 1999) from N = {} rows, {} "
        "evaluations, on {}; {}.",
        settings_of<SensitivitySettings>(study).samples, evaluations,
        name_of(settings_of<SensitivitySettings>(study).design), interval_text(study));
    if (settings_of<SensitivitySettings>(study).design == math::Design::scrambled_sobol &&
        settings_of<SensitivitySettings>(study).samples < 256)
      text += " Of a Sobol sequence with fewer than 256 rows the intervals often miss weak inputs.";
    return text;
  }
  return fmt::format(
      "Elementary effects (Morris 1991) of N = {} trajectories on {} levels, {} evaluations; {}. An effect "
      "is "
      "the change of the output over the whole range of the input (between the ends of its distribution).",
      settings_of<SensitivitySettings>(study).trajectories, settings_of<SensitivitySettings>(study).levels,
      evaluations, interval_text(study));
}

std::vector<math::Estimate> importance_of(const SensitivityResult& result, const OutputSensitivity& output) {
  std::vector<math::Estimate> importance;
  if (settings_of<SensitivitySettings>(result.study.study).method == SensitivityMethod::sobol) {
    for (const math::InputIndices& each : output.sobol.inputs) importance.push_back(each.total);
  } else {
    for (const math::MorrisEffects& each : output.morris) importance.push_back(each.mu_star);
  }
  return importance;
}

std::vector<std::vector<std::size_t>> ranked(const std::vector<math::Estimate>& importance) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(importance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What has no value goes last; where an interval is missing nothing can be told apart.
  const auto value = [&](std::size_t i) {
    return std::isfinite(importance[i].value) ? importance[i].value : -infinite;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
  const auto lower = [&](std::size_t i) {
    return std::isfinite(importance[i].lower) ? importance[i].lower : -infinite;
  };
  std::vector<double> highest_behind(order.size() + 1, -infinite);
  for (std::size_t k = order.size(); k-- > 0;) {
    const double upper = importance[order[k]].upper;
    highest_behind[k] = std::max(highest_behind[k + 1], std::isfinite(upper) ? upper : infinite);
  }
  std::vector<std::vector<std::size_t>> groups;
  double lowest_before = infinite;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || lowest_before > highest_behind[k]) groups.emplace_back();
    groups.back().push_back(order[k]);
    lowest_before = std::min(lowest_before, lower(order[k]));
  }
  return groups;
}

}  // namespace launchsafe::kinds

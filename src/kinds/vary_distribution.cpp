// Distributions of what varies, and the constants of a calibration that vary together.
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "vary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace launchsafe::kinds {

using study::Fault;

namespace {

using math::Distribution;
using scene::Dimension, scene::Place;

/// Deviations of a normal that is not cut off which must lie within the limits of its key.
constexpr double deviations_within_limits = 4.0;

std::string to_string(Distribution::Kind kind) {
  constexpr std::array words{"uniform", "log-uniform", "normal"};
  return words.at(static_cast<std::size_t>(kind));
}

/// Keys that the distribution needs, and those that would silently do nothing.
Fault check_given(const VaryReader& reader) {
  const bool normal = reader.text.distribution.kind == Distribution::Kind::normal;
  const std::string what = fmt::format("a {} distribution", to_string(reader.text.distribution.kind));
  if (!normal && !reader.given("range")) return reader.missing("range", what);
  for (const char* key : {"mean", "deviation"}) {
    if (normal && !reader.given(key)) return reader.missing(key, what);
    if (!normal && reader.given(key)) {
      return reader.fault(
          key, "a key of distribution \"normal\"",
          fmt::format("range alone for distribution \"{}\"", to_string(reader.text.distribution.kind)));
    }
  }
  return std::nullopt;
}

std::string range_text(double lower, double upper, Dimension dimension) {
  return fmt::format("{} to {}", scene::format_quantity(lower, dimension),
                     scene::format_quantity(upper, dimension));
}

/// The range to write for a normal that needs one; empty where the limits leave none.
std::string suggested_range(const VaryText& text) {
  const double reach = deviations_within_limits * text.distribution.deviation;
  const double lower = std::max(text.distribution.centre - reach, text.key.limits.lowest);
  const double upper = std::min(text.distribution.centre + reach, text.key.limits.highest);
  if (!(lower < upper) || !text.key.limits.contain(lower) || !text.key.limits.contain(upper)) return {};
  return fmt::format("range = \"{}\"", range_text(lower, upper, text.key.dimension));
}

/// A normal without a range must in practice stay within the limits of its key.
Fault check_reach(const VaryReader& reader) {
  const VaryText& text = reader.text;
  if (text.distribution.kind != Distribution::Kind::normal || reader.given("range")) return std::nullopt;
  const double reach = deviations_within_limits * text.distribution.deviation;
  const double lower = text.distribution.centre - reach, upper = text.distribution.centre + reach;
  if (text.key.limits.contain(lower) && text.key.limits.contain(upper)) return std::nullopt;
  return reader.fault(
      "deviation",
      fmt::format("values of {} within {:g} deviations, outside the limits of {}",
                  range_text(lower, upper, text.key.dimension), deviations_within_limits, text.key.name),
      "a range that cuts the normal off: " + scene::allowed_text(text.key), suggested_range(text));
}

// --- the constants of a calibration, together ---

/// Whether the study's scene and keys allow constants of a record to vary.
Fault check_place_of_record(const VaryReader& reader) {
  const study::StudyFile& study = reader.study;
  if (settings_of<SensitivitySettings>(study.study).correlated)
    return reader.fault("calibration", "a second calibration", "one calibration among what varies");
  if (!study.study.calibration_record.empty())
    return reader.fault("calibration", "a calibration beside that of the study",
                        "one of both: the constants vary around those of the record that [[vary]] names",
                        "leave out calibration = \"" + study.study.calibration_record + "\"");
  const scene::Load& load = study.scene.scene.load;
  if (load.curve_time.empty() && load.shape == scene::LoadShape::bell) return std::nullopt;
  return reader.fault("calibration",
                      fmt::format("constants of a bell for a scene whose load is {}",
                                  load.curve_time.empty() ? '"' + scene::word_of(load.shape) + '"'
                                                          : std::string("a measured curve")),
                      "a scene with load.shape = \"bell\"");
}

/// The record, with a covariance.
scene::Expected<study::CalibrationRecord> read_covariance(VaryReader& reader,
                                                          const std::filesystem::path& folder,
                                                          const std::string& name) {
  const std::string wanted = "the calibration.json of a calibration with load_fitted = true";
  const auto text = scene::read_text_file(folder / name);
  if (!text)
    return reader.fault("calibration", fmt::format("\"{}\", which cannot be read", name),
                        wanted + ", by its path from the study file's folder", text.error().suggestion);
  auto record = study::parse_calibration_record(*text, (folder / name).string());
  if (!record) return record;
  reader.study.records.push_back(store::sha256(*text));
  if (!record->failure.empty())
    return reader.fault("calibration", "a record without constants: " + record->failure, wanted);
  if (record->covariance.empty())
    return reader.fault("calibration", "a record without a covariance: its load was not fitted", wanted);
  return record;
}

}  // namespace

Fault check_distribution(const VaryReader& reader) {
  if (Fault fault = check_given(reader)) return fault;
  const VaryText& text = reader.text;
  if (text.distribution.kind == Distribution::Kind::log_uniform && !(text.distribution.lower > 0.0)) {
    return reader.fault(
        "range",
        fmt::format("{}, whose lower end has no logarithm",
                    range_text(text.distribution.lower, text.distribution.upper, text.key.dimension)),
        "a range above 0 for distribution \"log-uniform\"");
  }
  if (Fault fault = check_reach(reader)) return fault;
  if (math::is_valid(text.distribution)) return std::nullopt;
  return reader.fault(
      "range",
      fmt::format(
          "{}, where a normal of mean {} and deviation {} has no share",
          range_text(text.distribution.lower, text.distribution.upper, text.key.dimension),
          scene::format_quantity(text.distribution.centre, text.key.dimension),
          scene::format_quantity(text.distribution.deviation, scene::difference_of(text.key.dimension))),
      "a range near the mean");
}

std::vector<scene::Key<VaryRecord>> vary_record_keys() {
  return {scene::text_key("calibration", scene::Standing::input,
                          "Instead of the other keys: the calibration.json whose fitted constants vary "
                          "together, by the covariance of its fit; of kind sensitivity.",
                          "../reports/calibrate_table8/calibration.json", &VaryRecord::name)};
}

Fault read_calibrated(VaryReader& reader, const std::filesystem::path& folder) {
  VaryRecord named;
  auto read = scene::read_table(reader.table, vary_record_keys(), {}, reader.study.file, named);
  if (!read) return study::in_table(read.error(), "vary");
  reader.places = std::move(*read);
  const Place place = reader.place_of("calibration");
  const std::string study_key = reader.study_key("calibration");
  reader.study.places[study_key] = place;
  if (Fault fault = check_place_of_record(reader)) return fault;
  const auto record = read_covariance(reader, folder, named.name);
  if (!record) return record.error();
  constexpr std::size_t count = study::fitted_keys.size();
  auto factor = math::covariance_factor(record->covariance, count);
  if (!factor)
    return reader.fault("calibration", "a record whose covariance is not positive definite",
                        "the record of a calibration whose fit is not singular");
  study::Study& study = reader.study.study;
  settings_of<SensitivitySettings>(study).correlated = {study.axes.size(), count, std::move(*factor)};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string key_name = study::fitted_keys[i];
    if (Fault fault = check_free(reader.study, key_name, place, "vary.calibration")) return fault;
    const auto key = varied_key(reader.study, key_name, "vary.calibration", place);
    if (!key) return key.error();
    const double median =
        std::get<double>(scene::find_key(scene::scene_keys(), key_name)->get(record->calibration.scene));
    const double deviation = std::sqrt(record->covariance[i * count + i]);
    study.axes.push_back({key_name, study_key, *key, {}, Distribution::log_normal(median, deviation)});
  }
  return std::nullopt;
}

}  // namespace launchsafe::kinds

#include "launchsafe/study/firing_record.hpp"

#include "launchsafe/study/record_reader.hpp"

#include <limits>
#include <memory>
#include <utility>

namespace launchsafe::study {
namespace {

using scene::above_to, scene::between;

constexpr RecordFormat firing_format{"launchsafe firing record 1",
                                     "calibration.json",
                                     "a study of kind calibration with firings",
                                     {"digest", "format"}};
constexpr std::size_t most_firings = 1000, most_points = 10'000;

void describe_firing(RecordObject& object, Firing& firing) {
  object.value("name", firing.name);
  object.value("ignited", firing.ignited);
  object.value("rounds", firing.rounds, 1, most_rounds);
  object.value("pressure_Pa", firing.pressure, above_to(0, 10e9));
  object.value("pressure_spread_Pa", firing.pressure_spread, between(0, 10e9));
  object.value("temperature_K", firing.temperature, above_to(0, 1000));
  object.value("temperature_spread_K", firing.temperature_spread, between(0, 1000));
  object.value("gap_m", firing.gap, between(0, 0.01));
  object.value("most_gap_m", firing.most_gap, between(firing.gap, 0.01));
}

/// Number by number over all points; each list as long as the others.
void describe_posterior(RecordObject& object, Posterior& posterior) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::size_t points = posterior.size();
  const auto describe = [&](const char* key, auto member) {
    std::vector<double> numbers;
    for (PosteriorPoint& each : posterior) numbers.push_back(member(each));
    const bool first = object.reading() && points == 0;
    object.value(key, numbers, above_to(0, largest), first ? 1 : points, first ? most_points : points);
    points = numbers.size();
    posterior.resize(points);
    for (std::size_t i = 0; i < points; ++i) member(posterior[i]) = numbers[i];
  };
  describe("localisation", [](PosteriorPoint& each) -> double& { return each.constants.localisation; });
  describe("exchange_time_s", [](PosteriorPoint& each) -> double& { return each.constants.exchange_time; });
  describe("ignition_temperature_K",
           [](PosteriorPoint& each) -> double& { return each.constants.ignition_temperature; });
  describe("scatter", [](PosteriorPoint& each) -> double& { return each.scatter; });
}

void describe_evidence(RecordObject& object, FiringEvidence& evidence) {
  object.value("demonstration", evidence.demonstration);
  object.list("firings", evidence.firings, 1, most_firings, "1 to 1000 firings", describe_firing);
  object.part("posterior", evidence.posterior, describe_posterior);
  object.part("posterior_of_doubled_prior", evidence.of_doubled_prior, describe_posterior);
}

void describe_record(RecordObject& object, FiringRecord& record) {
  object.value("title", record.title);
  object.model_version(record.model_version, "make the calibration anew");
  object.scene(record.calibration.scene, "the calibrated scene");
  CalibrationEvidence& evidence = record.calibration.evidence;
  object.value("friction_rise_K", evidence.friction_rise, above_to(0, 5000));
  object.value("air_rise_K", evidence.air_rise, between(0, 5000));
  object.value("largest_gap_m", evidence.largest_gap, between(0, 0.01));
  object.value("fit_uncertainty_K", evidence.fit_uncertainty, between(0, 1e4));
  FiringEvidence firings = record.calibration.firings ? *record.calibration.firings : FiringEvidence{};
  describe_evidence(object, firings);
  record.calibration.firings = std::make_shared<const FiringEvidence>(std::move(firings));
}

}  // namespace

std::string to_json_text(const FiringRecord& record) {
  return record_text(content_by(firing_format, describe_record, record));
}

bool is_firing_record(const std::string& text) { return text.find(firing_format.name) != std::string::npos; }

scene::Expected<FiringRecord> parse_firing_record(const std::string& text, const std::string& file) {
  return parse_record<FiringRecord>(text, file, firing_format, describe_record);
}

std::string to_text(const FiringEvidence& evidence) { return json_by(describe_evidence, evidence).dump(); }

}  // namespace launchsafe::study

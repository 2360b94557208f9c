#include "launchsafe/kinds/calibration.hpp"

#include "study/read_error.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string head = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";
const std::string six_keys =
    "fit = \"load.peak_time, load.width, load.steepness, friction.localisation, gap.exchange_time, "
    "interface.side.friction\"\n";
const std::string skin_keys = "fit = \"friction.localisation, gap.exchange_time\"\n";
const std::string start_text =
    "[set]\ninterface.wall.friction = 0.02\n[range]\npeak_pressure = \"400 to 550 MPa\"\n";

/// Friction heats with the square of the pressure, at the wall by a share that grows with the wall's
/// friction.
run::MechanicsResult rubbing_mechanics(const scene::Scene& scene) {
  run::MechanicsResult result = squared_pressure_mechanics(scene);
  const auto wall = std::ranges::find(scene.interfaces, "wall", &scene::Interface::body);
  const double shares[] = {0.5 + 5.0 * wall->friction.value_or(0.0), 1.0, 0.8, 1.0};
  constexpr double colder = 0.75;  // than the synthetic launch: the localisation that is sought is larger
  for (std::size_t i = 0; i < result.trace.friction.size(); ++i)
    result.trace.friction[i] *= colder * shares[i % 4];
  return result;
}

StudyOptions rubbing_options() {
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    return rubbing_mechanics(scene);
  };
  return options;
}

/// Values of the launch that the rows are of, by the key as a fit has it, SI.
const std::map<std::string, double> truth{{"load.peak_time", 10.8e-3},   {"load.width", 2.7e-3},
                                          {"load.steepness", 1.5},       {"friction.localisation", 1500.0},
                                          {"gap.exchange_time", 3.3e-4}, {"interface.side.friction", 0.03}};

scene::Scene true_scene() {
  const scene::SceneFile file = study_of(critical_text).scene;
  std::vector<scene::KeyChange> changes;
  for (const auto& [key, value] : truth) changes.push_back({scene::key_in_scene(file.scene, key), value, {}});
  // Nothing is triggered before it burns by itself.
  changes.push_back(
      {"kinetics.ignition_temperature", file.scene.charge().kinetics.burnt_temperature - 1e-6, {}});
  const auto changed = scene::caught([&] { return scene::with_keys(file, changes); });
  EXPECT_TRUE(changed) << (changed ? "" : changed.error().message());
  return changed ? changed->scene : file.scene;
}

/// Rows as that launch would have published them; the last ignites. `more`: of the row without a gap.
std::string rows_text(const std::string& ignition_time = "17.7 ms", const std::string& more = "") {
  const scene::Scene scene = true_scene();
  const trace::BottomTrace trace = rubbing_mechanics(scene).trace;
  std::string rows;
  for (const double gap : {0.0, 1e-4, 2e-4, 3e-4, 4e-4}) {
    const auto history = surface::integrate_skin(surface::skin_model(scene), trace, gap);
    rows += fmt::format(
        "{{ scene = \"scene_155mm.toml\", gap = \"{} m\", early_temperature = \"{} K\", "
        "maximum_temperature = \"{} K\"",
        gap, surface::maximum_at_time(history, trace, 10e-3).temperature,
        surface::maximum_until(history, trace, 18e-3).temperature);
    if (gap == 0.0)
      rows += fmt::format(", spread = \"{} K\", early_spread = \"{} K\"{}",
                          surface::spread_at_time(history, trace, 18e-3),
                          surface::spread_at_time(history, trace, 10e-3), more);
    if (gap == 4e-4) rows += ", ignition_time = \"" + ignition_time + '"';
    rows += " },\n";
  }
  return "reference = [\n" + rows + "]\n";
}

/// Once for all tests.
const CalibrationResult& six_fitted() {
  static const CalibrationResult result =
      run_calibration(study_of(head + six_keys + rows_text() + start_text), rubbing_options());
  return result;
}

class FittedCalibration : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(six_fitted().constants) << six_fitted().failure; }
  const scene::Constants& constants = *six_fitted().constants;
};

// The search settles where a step gains less than a millionth of the sum of squares: temperatures are met to
// 0.02 K, and keys along the direction that the rows determine least (condition 3e3) to some hundredths.
TEST_F(FittedCalibration, RecoversTheConstantsOfTheLaunchThatWasPublished) {
  EXPECT_LT(six_fitted().fit.sum_of_squares(), 1e-3);
  for (const scene::FittedNumber& row : constants.rows)
    if (row.is_fitted) EXPECT_NEAR(row.computed, row.published, 0.02) << row.quantity << " " << row.gap;
  ASSERT_EQ(constants.fitted_keys.size(), truth.size());
  for (const auto& [key, value] : truth)
    EXPECT_NEAR(std::get<double>(constants.values.at(key)), value, 0.05 * value) << key;
  EXPECT_EQ(constants.scene.load.peak_time, std::get<double>(constants.values.at("load.peak_time")));
}

TEST_F(FittedCalibration, PutsTheIgnitionTemperatureBetweenTheTwoGaps) {
  const double ignition = constants.scene.charge().kinetics.ignition_temperature;
  EXPECT_LT(constants.ignition_lowest, ignition);
  EXPECT_GT(constants.ignition_highest, ignition);
  EXPECT_DOUBLE_EQ(ignition, 0.5 * (constants.ignition_lowest + constants.ignition_highest));
  EXPECT_EQ(std::get<double>(constants.values.at("kinetics.ignition_temperature")), ignition);
  const auto row_of = [&](const std::string& quantity) {
    return *std::ranges::find(constants.rows, quantity, &scene::FittedNumber::quantity);
  };
  const scene::FittedNumber ignites = row_of("ignition time"), safe = row_of("largest T");
  EXPECT_EQ(ignites.unit, "ms");
  EXPECT_LT(ignites.computed, 17.7);
  EXPECT_GT(ignites.computed, 10.0);
  EXPECT_LT(safe.computed, ignition) << "it ignites";
  EXPECT_FALSE(ignites.is_fitted || safe.is_fitted);
}

TEST_F(FittedCalibration, HasASymmetricPositiveCovariance) {
  const std::size_t count = constants.fitted_keys.size();
  ASSERT_EQ(constants.covariance.size(), count * count);
  const auto at = [&](std::size_t i, std::size_t j) { return constants.covariance[i * count + j]; };
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_GT(at(i, i), 0.0) << constants.fitted_keys[i];
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(at(i, j), at(j, i), 1e-9 * std::sqrt(at(i, i) * at(j, j)));
      EXPECT_LT(at(i, j) * at(i, j), at(i, i) * at(j, j));
    }
  }
}

TEST_F(FittedCalibration, WritesAFileThatReadsBack) {
  const std::string text = scene::to_toml(constants);
  const auto read = scene::caught([&] { return scene::parse_constants(text, "constants.toml"); });
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->values, constants.values);
  EXPECT_EQ(read->fitted_keys, constants.fitted_keys);
  EXPECT_EQ(read->range, (std::map<std::string, std::string>{{"peak_pressure", "400 to 550 MPa"}}));
  EXPECT_EQ(read->rows.size(), constants.rows.size());
  EXPECT_EQ(scene::to_toml(*read), text);
}

TEST_F(FittedCalibration, HoldsWhatHoldsTheChargeAndWhatWasNotFitted) {
  EXPECT_EQ(constants.values.at("interface.side.condition"), scene::Value(std::string("sliding")));
  EXPECT_EQ(constants.values.at("interface.bottom.condition"), scene::Value(std::string("sliding")));
  EXPECT_EQ(constants.values.at("interface.bottom.friction"), scene::Value(0.0));
  for (const char* key :
       {"friction.closure", "gap.skin_thickness", "gap.air_specific_heat", "gap.air_heat_ratio",
        "station.width", "station.depth", "load.shape", "steel.yield_stress", "interface.front.condition"})
    EXPECT_TRUE(constants.values.contains(key)) << key;
}

TEST_F(FittedCalibration, ComparesEveryPublishedNumber) {
  std::set<std::string> quantities;
  std::size_t fitted = 0;
  for (const scene::FittedNumber& row : constants.rows) {
    quantities.insert(row.quantity);
    fitted += row.is_fitted ? 1 : 0;
    if (row.is_fitted) EXPECT_NEAR(row.computed, row.published, 0.1) << row.quantity << " at " << row.gap;
  }
  EXPECT_EQ(fitted, 11u);  // four and five temperatures, two spreads
  EXPECT_EQ(quantities, (std::set<std::string>{"T at 18 ms", "T at 10 ms", "spread at 18 ms",
                                               "spread at 10 ms", "ignition time", "largest T"}));
  const auto files = report::render_report(report_of(six_fitted())).files;
  EXPECT_EQ(std::ranges::count(files, "constants.toml", &store::TextFile::name), 1);
  EXPECT_EQ(std::ranges::count(files, "compared.csv", &store::TextFile::name), 1);
}

// The published place is colder than the hottest one, at the second station, and the fit is told so.
TEST(Calibration, APublishedPlaceCountsByWhatItIsColder) {
  const CalibrationResult result = run_calibration(
      study_of(head + skin_keys + rows_text("17.7 ms", ", early_point = \"G1\"") + start_text),
      rubbing_options());
  ASSERT_TRUE(result.constants) << result.failure;
  const auto place =
      std::ranges::find(result.constants->rows, "place at 10 ms", &scene::FittedNumber::quantity);
  ASSERT_NE(place, result.constants->rows.end());
  EXPECT_EQ(place->published, 0.0);
  EXPECT_GT(place->computed, 1.0);
  EXPECT_TRUE(place->is_fitted);
}

TEST(Calibration, KeysOfTheSkinAloneTakeOneLaunch) {
  const CalibrationResult result =
      run_calibration(study_of(head + skin_keys + rows_text() + start_text), rubbing_options());
  EXPECT_TRUE(result.constants) << result.failure;
  EXPECT_EQ(result.timing.runs, 1u);
  EXPECT_GT(six_fitted().timing.runs, truth.size());
}

TEST(Calibration, ALaunchThatIsNoBasisGivesNoConstants) {
  const std::string text = head + skin_keys + rows_text();
  // So much inertia matters: run::validity_warnings says so.
  const CalibrationResult warned =
      run_calibration(study_of(text + "[set]\nnumerics.inertial_scaling = 100\n"), rubbing_options());
  EXPECT_FALSE(warned.constants);
  EXPECT_NE(warned.failure.find("validity warning"), std::string::npos) << warned.failure;
  EXPECT_NE(answer(warned).find(warned.failure), std::string::npos);
  StudyOptions options = rubbing_options();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = rubbing_mechanics(scene);
    result.status = run::RunStatus::non_finite;
    return result;
  };
  const CalibrationResult broken = run_calibration(study_of(text), options);
  EXPECT_FALSE(broken.constants);
  EXPECT_FALSE(broken.failure.empty());
  EXPECT_FALSE(report_of(broken).answer.empty());
}

// At 5 ms the gap that ignites is colder than the largest safe one ever is.
TEST(Calibration, TemperaturesOutOfOrderGiveNoIgnitionTemperature) {
  const CalibrationResult result =
      run_calibration(study_of(head + skin_keys + rows_text("5 ms") + start_text), rubbing_options());
  EXPECT_FALSE(result.constants);
  EXPECT_NE(result.failure.find("ignition temperature"), std::string::npos) << result.failure;
}

/// Mechanics that no load moves leaves the load undetermined.
TEST(Calibration, RowsThatDoNotDetermineAKeyGiveNoConstants) {
  const CalibrationResult result = run_calibration(
      study_of(head + "fit = \"load.steepness, friction.localisation\"\n" + rows_text() + start_text),
      synthetic_options());
  EXPECT_FALSE(result.constants);
  EXPECT_FALSE(result.failure.empty());
}

TEST(Calibration, RefusesKeysThatHaveNoPositiveNumber) {
  const std::string rows = rows_text();
  const auto found = [&](const std::string& keys) {
    const scene::InputError error = error_in(head + "fit = \"" + keys + "\"\n" + rows);
    EXPECT_TRUE(error.key.starts_with("fit")) << error.message();
    return error.found;
  };
  EXPECT_NE(found("friction.closure").find("no number"), std::string::npos);
  EXPECT_NE(found("interface.front.friction").find("which is 0"), std::string::npos);
  EXPECT_NE(found("load.exponent").find("does nothing"), std::string::npos);
  EXPECT_NE(found("load.width, load.width").find("twice"), std::string::npos);
  for (const char* keys : {"", "load.breadth", "interface.top.friction"})
    EXPECT_FALSE(found(keys).empty()) << keys;
}

TEST(Calibration, RefusesNamesThatNothingHas) {
  const std::string rows = rows_text();
  const scene::InputError range = error_in(head + rows + "[range]\npeak_presure = \"400 to 550 MPa\"\n");
  EXPECT_NE(range.key.find("peak_presure"), std::string::npos) << range.message();
  EXPECT_NE(range.suggestion.find("peak_pressure"), std::string::npos) << range.message();
  EXPECT_EQ(error_in(head + "file = \"../155mm.toml\"\n" + rows).key, "file");
  EXPECT_EQ(error_in(head + rows_text("17.7 ms", ", point = \"G99\"")).key, "reference");
}

TEST(Calibration, NeedsARowThatIgnitesAboveOneThatDoesNot) {
  std::string rows = rows_text();
  const std::string ignition = ", ignition_time = \"17.7 ms\"";
  rows.erase(rows.find(ignition), ignition.size());
  EXPECT_EQ(error_in(head + rows).key, "reference");
  const std::string first = ", early_temperature";
  rows.insert(rows.find(first), ignition);
  EXPECT_EQ(error_in(head + rows).key, "reference");
}

}  // namespace

#include "launchsafe/study/surrogate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace launchsafe::study {
namespace {

using math::Distribution, math::Design;

/// A pressure, and two constants that vary together.
UncertainInputs some_inputs() {
  return {.distributions = {Distribution::uniform(400e6, 600e6), Distribution::log_normal(1350.0, 0.05),
                            Distribution::log_normal(0.285e-3, 0.1)},
          .correlated = CorrelatedInputs{1, 2, {0.05, 0.0, -0.08, 0.06}}};
}

/// m, a critical gap that falls with the pressure, curved, and that a fit of low degree misses a little.
double critical_gap_at(const std::vector<double>& values) {
  return 4e-4 * std::exp(-2.0 * (values[0] / 496e6 - 1.0)) * (1350.0 / values[1]) *
         (1.0 + 0.2 * std::sin(3.0 * values[2] / 0.285e-3));
}

scene::Scene shipped_scene() {
  return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
}

SurrogateRecord some_record(std::uint64_t seed = 1) {
  SurrogateRecord record{.scene = shipped_scene(),
                         .gap = 2e-4,
                         .keys = {"load.peak", "friction.localisation", "gap.exchange_time"},
                         .inputs = some_inputs(),
                         .points = math::unit_points(Design::scrambled_sobol, 64, 3, seed)};
  const std::vector<double> held_out = math::unit_points(Design::monte_carlo, 32, 3, math::hashed(seed, 1));
  record.points.insert(record.points.end(), held_out.begin(), held_out.end());
  for (std::size_t row = 64; row < 96; ++row) record.held_out.push_back(row);
  SurrogateOutput output{.name = "critical_gap"};
  for (std::size_t row = 0; row < 96; ++row)
    output.values.push_back(
        critical_gap_at(record.inputs.values_at(math::point_of_row(record.points, row, 3))));
  fit_output(record, output);
  record.outputs = {output};
  return record;
}

// The median of everything is the middle of the cube; logarithms are the factor times standard normals.
TEST(UncertainInputs, ValuesAndPointsAreEachOthersInverses) {
  const UncertainInputs inputs = some_inputs();
  const std::vector<double> medians = inputs.values_at({0.5, 0.5, 0.5});
  EXPECT_DOUBLE_EQ(medians[0], 500e6);
  EXPECT_NEAR(medians[1], 1350.0, 1e-9);
  EXPECT_NEAR(medians[2], 0.285e-3, 1e-15);
  const std::vector<double> point{0.3, 0.8, 0.1};
  const std::vector<double> values = inputs.values_at(point);
  const double z1 = math::quantile(Distribution::normal(0, 1), 0.8),
               z2 = math::quantile(Distribution::normal(0, 1), 0.1);
  EXPECT_NEAR(std::log(values[2] / 0.285e-3), -0.08 * z1 + 0.06 * z2, 1e-12);
  const std::vector<double> back = inputs.point_of(values);
  for (std::size_t i = 0; i < point.size(); ++i) EXPECT_NEAR(back[i], point[i], 1e-12) << i;
}

// 40 studies, each asked about 2 000 launches that neither its fit nor its error has seen: 1 of 100 may be
// beyond on each side. The output is rougher than any polynomial follows, and what is missed has longer tails
// than the factor supposes.
TEST(Surrogate, ItsErrorHoldsForLaunchesThatItHasNotSeen) {
  constexpr int studies = 40;
  constexpr std::size_t launches = 2000;
  double above = 0, below = 0, covered = 0;
  for (int seed = 1; seed <= studies; ++seed) {
    const SurrogateRecord record = some_record(static_cast<std::uint64_t>(seed));
    const Surrogate surrogate(record, record.outputs.front());
    const std::vector<double> points = math::unit_points(Design::monte_carlo, launches, 3, 1000);
    for (std::size_t row = 0; row < launches; ++row) {
      const auto point = math::point_of_row(points, row, 3);
      const Prediction prediction = surrogate.at(point);
      EXPECT_LT(prediction.error, prediction.covered ? 1e-4 : 1.0);  // a quarter of the critical gap
      if (!prediction.covered) continue;
      const double truth = critical_gap_at(record.inputs.values_at(point));
      above += truth > prediction.value + prediction.error;
      below += truth < prediction.value - prediction.error;
      ++covered;
    }
  }
  EXPECT_LT(above / covered, 0.01);
  EXPECT_LT(below / covered, 0.01);
  EXPECT_GT(covered / (studies * static_cast<double>(launches)), 0.9);
}

/// With a critical gap of this function of the pressure's place from -1 to 1 and of the others in it.
SurrogateRecord record_of(double (*output)(double place)) {
  SurrogateRecord record = some_record();
  for (std::size_t row = 0; row < 96; ++row)
    record.outputs.front().values[row] =
        4e-4 * output(2.0 * math::point_of_row(record.points, row, 3)[0] - 1.0);
  fit_output(record, record.outputs.front());
  return record;
}

// A step of a width of 0.1 is no polynomial of degree 6; a parabola is one, and no process is nearer.
TEST(Surrogate, TheProcessIsTakenWhereItMissesLessOfWhatIsLeftOut) {
  const SurrogateRecord steep = record_of([](double x) { return 1.0 + 0.5 * std::tanh(6.0 * x); });
  const SurrogateOutput& output = steep.outputs.front();
  ASSERT_EQ(output.reason, "");
  EXPECT_TRUE(output.fit.by_process());
  EXPECT_LT(output.fit.leave_one_out(), output.fit.chaos.leave_one_out);
  EXPECT_EQ(output.error.launches, 32u);
  const Surrogate surrogate(steep, output);
  for (const std::size_t row : steep.held_out) {
    const Prediction prediction = surrogate.at(math::point_of_row(steep.points, row, 3));
    EXPECT_NEAR(prediction.value, output.values[row], prediction.error);
    EXPECT_LE(prediction.error, surrogate.largest_error());
    EXPECT_TRUE(prediction.covered);
  }
  const auto read = parse_surrogate(to_json_text(steep), "surrogate.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(Surrogate(*read, read->outputs.front()).at({0.4, 0.5, 0.6}).value,
            surrogate.at({0.4, 0.5, 0.6}).value);
  EXPECT_FALSE(record_of([](double x) { return 1.0 + x * x; }).outputs.front().fit.by_process());
}

// Further launches lessen the error where they are: the largest leverage of the same draws falls.
TEST(Surrogate, FurtherLaunchesAreThoseWithTheLargestErrorOneAfterTheOther) {
  const SurrogateRecord record = some_record();
  const SurrogateOutput& output = record.outputs.front();
  const std::vector<double> points = least_sure_points(record, output, 4, 17);
  ASSERT_EQ(points.size(), 4u * 3u);
  const std::vector<double> draws = math::unit_points(Design::monte_carlo, 512, 3, 17);
  const auto largest_error = [&](const Surrogate& surrogate) {
    double largest = 0.0;
    for (std::size_t row = 0; row < 512; ++row)
      largest = std::max(largest, surrogate.at(math::point_of_row(draws, row, 3)).error);
    return largest;
  };
  const Surrogate before(record, output);
  EXPECT_EQ(before.at(math::point_of_row(points, 0, 3)).error, largest_error(before));
  SurrogateRecord more = record;
  more.points.insert(more.points.end(), points.begin(), points.end());
  for (std::size_t row = 0; row < 4; ++row)
    more.outputs.front().values.push_back(
        critical_gap_at(more.inputs.values_at(math::point_of_row(points, row, 3))));
  EXPECT_EQ(more.fitted(), 68u);
  EXPECT_LT(largest_error(Surrogate(more, more.outputs.front())), largest_error(before));
}

TEST(Surrogate, IsLessSureFartherOut) {
  const SurrogateRecord record = some_record();
  const Surrogate surrogate(record, record.outputs.front());
  EXPECT_LT(surrogate.at({0.5, 0.5, 0.5}).error, surrogate.at({0.98, 0.98, 0.98}).error);
  EXPECT_TRUE(surrogate.at({0.5, 0.5, 0.5}).covered);
  EXPECT_FALSE(surrogate.at({0.9999, 0.9999, 0.9999}).covered);
}

// All of a uniform; of a normal what the fitted launches span.
TEST(Surrogate, IsAskedWhereLaunchesWereFitted) {
  const SurrogateRecord record = some_record();
  EXPECT_DOUBLE_EQ(ranges_of(record)[0].lower, 400e6);
  EXPECT_DOUBLE_EQ(ranges_of(record)[0].upper, 600e6);
  const math::Interval localisation = ranges_of(record)[1];
  EXPECT_GT(localisation.lower, 1350.0 * std::exp(-0.05 * 3.0));
  EXPECT_LT(localisation.upper, 1350.0 * std::exp(0.05 * 3.0));
}

// Of pressures from 400 to 600 MPa alone, the critical gap exp(-2 (p/496 - 1)) 0.4 mm is below 0.3 mm above
// 496 (1 - ln(0.75)/2) = 567.34 MPa: 16.33 % of them.
TEST(Surrogate, CountsTheDrawsWhoseCriticalGapIsBelowAGap) {
  SurrogateRecord record = some_record();
  SurrogateOutput& output = record.outputs.front();
  for (std::size_t row = 0; row < 96; ++row) {
    auto values = record.inputs.values_at(math::point_of_row(record.points, row, 3));
    output.values[row] = 4e-4 * std::exp(-2.0 * (values[0] / 496e6 - 1.0));
  }
  fit_output(record, output);
  const PredictedIgnitions free = ignitions_of(drawn_critical_gaps(record), 3e-4);
  EXPECT_NEAR(static_cast<double>(free.predicted) / static_cast<double>(free.draws), 0.1633, 0.002);
  EXPECT_LE(free.at_least, free.predicted);
  EXPECT_GE(free.at_most, free.predicted);
  const PredictedIgnitions held = ignitions_of(drawn_critical_gaps(record, {0.5, {}, {}}), 3e-4);
  EXPECT_EQ(held.predicted, 0u);
}

// Nothing is known of a draw that is farther out than every launch by which the error is known.
TEST(Surrogate, DrawsThatAreNotCoveredMayIgniteOrNot) {
  const std::vector<Prediction> draws{{4e-4, 1e-5, true},   // does not
                                      {2e-4, 1e-5, true},   // does
                                      {3e-4, 1e-5, true},   // nearer than the error
                                      {9e-4, 1e-5, false},  // not judged, whatever the value
                                      {1e-4, 1e-5, false}};
  const PredictedIgnitions of = ignitions_of(draws, 3.05e-4);
  EXPECT_EQ(of.draws, 5u);
  EXPECT_EQ(of.at_least, 1u);
  EXPECT_EQ(of.predicted, 3u);
  EXPECT_EQ(of.at_most, 4u);
  EXPECT_EQ(of.uncovered, 2u);
  // Far below every critical gap no draw ignites by the fit; those that are not covered still may.
  const std::vector<Prediction> all = drawn_critical_gaps(some_record());
  const PredictedIgnitions none = ignitions_of(all, 1e-5);
  EXPECT_EQ(none.predicted, 0u);
  EXPECT_GT(none.uncovered, 0u);
  EXPECT_EQ(none.at_least, 0u);
  EXPECT_EQ(none.at_most, none.uncovered);
  const PredictedIgnitions every = ignitions_of(all, 1e-2);
  EXPECT_EQ(every.at_least, every.draws - every.uncovered);
  EXPECT_EQ(every.at_most, every.draws);
}

/// A critical gap of 0.4 mm less 0.05 mm a deviation of the pressure and 0.03 mm one of the temperature,
/// which heat both; their scores have this correlation.
SurrogateRecord linear_record(double correlation) {
  SurrogateRecord record{
      .scene = shipped_scene(),
      .gap = 2e-4,
      .keys = {"load.peak", "initial_temperature"},
      .inputs = {.distributions = {Distribution::normal(496e6, 10e6), Distribution::normal(293.0, 5.0)},
                 .correlation = {1.0, correlation, correlation, 1.0}}};
  const std::vector<double> points = math::unit_points(Design::monte_carlo, 96, 2, 5);
  SurrogateOutput output{.name = "critical_gap"};
  for (std::size_t row = 0; row < 96; ++row) {
    const std::vector<double> point = record.inputs.draws().at(math::point_of_row(points, row, 2));
    record.points.insert(record.points.end(), point.begin(), point.end());
    if (row >= 64) record.held_out.push_back(row);
    const std::vector<double> values = record.inputs.values_at(point);
    output.values.push_back(4e-4 - 5e-5 * (values[0] - 496e6) / 10e6 - 3e-5 * (values[1] - 293.0) / 5.0);
  }
  fit_output(record, output);
  record.outputs = {output};
  return record;
}

double share_ignited(const SurrogateRecord& record, double gap,
                     const std::vector<std::optional<double>>& fixed) {
  const PredictedIgnitions of = ignitions_of(drawn_critical_gaps(record, fixed), gap);
  return static_cast<double>(of.predicted) / static_cast<double>(of.draws);
}

// The critical gap is normal, and a'Ca its variance: 0.03^2 + 0.05^2 + 2 rho 0.03 0.05 mm^2.
TEST(Surrogate, IgnitionIsAsProbableAsTheCorrelationOfTheInputsMakesIt) {
  double before = 0.0;
  for (const double correlation : {-0.6, 0.0, 0.3, 0.6, 0.9}) {
    const SurrogateRecord record = linear_record(correlation);
    ASSERT_EQ(record.outputs.front().reason, "") << correlation;
    const double deviation = std::sqrt(3e-5 * 3e-5 + 5e-5 * 5e-5 + 2.0 * correlation * 3e-5 * 5e-5);
    const double found = share_ignited(record, 3e-4, {{}, {}});
    EXPECT_NEAR(found, math::cumulative(Distribution::normal(4e-4, deviation), 3e-4), 0.002) << correlation;
    EXPECT_GT(found, before) << "two that heat go together, " << correlation;
    before = found;
  }
}

// Under a pressure one deviation above its mean the temperature is normal about rho deviations above its own.
TEST(Surrogate, AnInputThatIsSetMovesThoseThatGoWithIt) {
  const double one_above = math::cumulative(Distribution::normal(0.0, 1.0), 1.0);
  const Distribution critical_gap = Distribution::normal(4e-4 - 5e-5 - 0.6 * 3e-5, 0.8 * 3e-5);
  EXPECT_NEAR(share_ignited(linear_record(0.6), 3.2e-4, {one_above, {}}),
              math::cumulative(critical_gap, 3.2e-4), 0.002);
}

TEST(SurrogateRecord, HasTheStatedCorrelation) {
  const SurrogateRecord record = linear_record(0.6);
  const auto read = parse_surrogate(to_json_text(record), "surrogate.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->inputs.correlation, record.inputs.correlation);
  EXPECT_EQ(share_ignited(*read, 3e-4, {{}, {}}), share_ignited(record, 3e-4, {{}, {}}));
  for (const std::vector<double>& none :
       {std::vector{1.0, 0.6, 0.5, 1.0}, {1.0, 1.0, 1.0, 1.0}, {0.9, 0.1, 0.1, 1.0}, {1.0}}) {
    SurrogateRecord edited = record;
    edited.inputs.correlation = none;
    const auto refused = parse_surrogate(to_json_text(edited), "surrogate.json");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find("no matrix of correlations"), std::string::npos)
        << refused.error().message();
  }
}

TEST(SurrogateRecord, ReadsBackAsWritten) {
  const SurrogateRecord record = some_record();
  const std::string text = to_json_text(record);
  const auto read = parse_surrogate(text, "surrogate.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_json_text(*read), text);
  const std::vector<double> point{0.3, 0.6, 0.2};
  const Prediction before = Surrogate(record, record.outputs.front()).at(point);
  const Prediction after = Surrogate(*read, read->outputs.front()).at(point);
  EXPECT_EQ(before.value, after.value);
  EXPECT_EQ(before.error, after.error);
}

TEST(SurrogateRecord, OfAnotherVersionEditedOrWithoutWhatItsErrorNeedsIsRefused) {
  const auto fault_of = [](const std::string& text) {
    const auto read = parse_surrogate(text, "surrogate.json");
    return read ? std::string{} : read.error().message();
  };
  std::string edited = to_json_text(some_record());
  const std::size_t gap = edited.find("\"gap_m\": 0.0002");
  ASSERT_NE(gap, std::string::npos);
  EXPECT_NE(fault_of(edited.replace(gap, 15, "\"gap_m\": 0.0003")).find("was edited"), std::string::npos);
  std::string other = to_json_text(some_record());
  const std::string version = "\"model_version\": ";
  other.replace(other.find(version) + version.size(), 1, "1");
  EXPECT_NE(fault_of(other).find("the version of this program"), std::string::npos);
  SurrogateRecord without_error = some_record();
  for (std::size_t row = 64; row < 67; ++row)  // 29 of 32 are left
    without_error.outputs.front().values[row] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault_of(to_json_text(without_error)).find("too few numbers"), std::string::npos);
  SurrogateRecord no_correlation = some_record();
  no_correlation.inputs.correlated->factor = {0.05, 0.0, -0.08, 0.0};
  EXPECT_NE(fault_of(to_json_text(no_correlation)).find("no factor of log-normal inputs"), std::string::npos);
  SurrogateRecord out_of_order = some_record();
  std::swap(out_of_order.held_out[3], out_of_order.held_out[4]);
  EXPECT_NE(fault_of(to_json_text(out_of_order)).find("out of their order"), std::string::npos);
  SurrogateRecord at_infinity = some_record();
  at_infinity.points[4] = 1.0;
  EXPECT_NE(fault_of(to_json_text(at_infinity)).find("none of the unit cube"), std::string::npos);
  SurrogateRecord no_distribution = some_record();
  no_distribution.inputs.distributions[0] = Distribution::uniform(2.0, 1.0);
  EXPECT_NE(fault_of(to_json_text(no_distribution)).find("no uniform distribution"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::study

// Fits of some dozens of launches against hundreds that they have not seen, of the 155 mm shell on the
// coarsest cells with which a critical gap is found: some milliseconds a launch.
#include "launchsafe/kinds/sensitivity.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string coarse_cells = R"([set]
numerics.cell_size = "20 mm"
station.width = "4 cm"
station.depth = "4 cm"
)";
const std::string accepted = R"(accept = [
  { key = "numerics.cell_size", value = "20 mm", because = "a launch of milliseconds" },
  { key = "station.width", value = "4 cm", because = "two coarse cells" },
  { key = "station.depth", value = "4 cm", because = "two coarse cells" },
]
)";

StudyOptions two_jobs() {
  StudyOptions options;
  options.jobs = 2;
  return options;
}

/// Per output of a fit, by how much it misses launches that it has not seen, over the error that it states.
struct Misses {
  std::size_t launches = 0, beyond = 0;
  double largest = 0, squares = 0, largest_error = 0;
  double root_mean_square() const { return std::sqrt(squares / static_cast<double>(launches)); }
  void add(const Prediction& prediction, double truth) {
    const double miss = std::abs(prediction.value - truth);
    ++launches;
    beyond += miss > prediction.error ? 1 : 0;
    largest = std::max(largest, miss);
    squares += miss * miss;
    largest_error = std::max(largest_error, prediction.error);
  }
};

/// Three quantities of 50, 40 and 50 values each: SI.
std::vector<double> combination(std::size_t index) {
  const auto between = [](double from, double to, std::size_t place, std::size_t count) {
    return from + (to - from) * (static_cast<double>(place) + 0.5) / static_cast<double>(count);
  };
  return {between(466e6, 526e6, index / 2000, 50), between(288, 312, index / 50 % 40, 40),
          between(0.25e-3, 0.32e-3, index % 50, 50)};
}
constexpr std::size_t combinations = 100'000;

// 1 of 100 is beyond the error on each side: of 200 4, and more than 10 in one of 200 such tests.
TEST(SurrogateSlow, AHundredThousandCombinationsFromTwoHundredLaunchesAgreeWithTwoHundredOthers) {
  const StudyFile study = study_of(R"(kind = "sensitivity"
scene = "scene_155mm.toml"
method = "polynomial-chaos"
design = "scrambled-sobol"
samples = 128
held_out = 72
gaps = "0.02 cm"
largest_gap = "0.4 cm"
vary = [
  { key = "peak_pressure", distribution = "uniform", range = "466 to 526 MPa" },
  { key = "initial_temperature", distribution = "uniform", range = "288 to 312 K" },
  { key = "gap.exchange_time", distribution = "uniform", range = "0.25 to 0.32 ms" },
]
)" + accepted + coarse_cells);
  const SensitivityResult result = run_sensitivity(study, two_jobs());
  const report::Report written = report_of(result);
  ASSERT_FALSE(written.files.empty());
  const SurrogateRecord record = parse_surrogate(written.files.front().text, "surrogate.json").value();

  std::mt19937_64 draw(1);
  std::vector<std::vector<double>> chosen;
  for (int i = 0; i < 200; ++i) chosen.push_back(combination(draw() % combinations));
  StudyFile others = study;
  others.cases = {};
  add_varied_cases(
      others, chosen.size(), [&](std::size_t row) { return chosen[row]; },
      [](std::size_t row, const StudyCase&) { return fmt::format("other {}", row + 1); });
  Timing timing;
  ProgressTracker tracker({});
  const std::vector<CaseAnswer> answers = answer_cases(others, two_jobs(), timing, tracker);
  ASSERT_TRUE(std::ranges::all_of(answers, &CaseAnswer::completed));

  for (const char* name : {"temperature_max", "critical_gap"}) {
    const SurrogateOutput* output = record.predicted(name);
    ASSERT_NE(output, nullptr) << name << ": " << record.outputs.back().reason;
    const Surrogate surrogate(record, *output);
    const auto start = std::chrono::steady_clock::now();
    std::size_t covered = 0;
    for (std::size_t index = 0; index < combinations; ++index)
      covered += surrogate.at(record.inputs.point_of(combination(index))).covered ? 1 : 0;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    Misses misses;
    for (std::size_t row = 0; row < chosen.size(); ++row) {
      const Prediction prediction = surrogate.at(record.inputs.point_of(chosen[row]));
      const GapVerdict& verdict = answers[row].verdicts.front();
      const double temperature = output->inert ? verdict.heated : verdict.maximum.temperature;
      if (prediction.covered)
        misses.add(prediction, output->name == "critical_gap" ? answers[row].critical.value : temperature);
    }
    fmt::print(
        "{}: {} of {} combinations answered in {:.2f} s; {} of 200 launches compared: off by {:.3g} at most "
        "and "
        "{:.3g} root mean square, stated error up to {:.3g}, {} beyond it\n",
        name, covered, combinations, time.count(), misses.launches, misses.largest, misses.root_mean_square(),
        misses.largest_error, misses.beyond);
    EXPECT_GT(covered, combinations * 9 / 10) << name;
    EXPECT_GT(misses.launches, 180u) << name;
    EXPECT_LE(misses.beyond, 10u) << name;
  }
}

/// The shipped study of sensitivity on coarse cells, with some of its lines otherwise.
StudyFile shipped_study(std::vector<std::pair<std::string, std::string>> lines) {
  std::ifstream file(studies_folder / "sensitivity.toml");
  std::ostringstream read;
  read << file.rdbuf();
  std::string text = read.str();
  text.erase(text.find("[set]"));
  for (const auto& [begin, line] : lines) {
    const std::size_t at = text.find(begin);
    EXPECT_NE(at, std::string::npos) << begin;
    text.replace(at, text.find('\n', at) - at, line);
  }
  return study_of(text + accepted + coarse_cells);
}

/// Whether an index lies in the interval of another estimate of it; one of nothing differs by round-off.
bool lies_within(double index, const math::Estimate& estimate, const std::string& what) {
  constexpr double round_off = 1e-4;
  fmt::print("{}: {:.4f} against {:.4f} [{:.4f}, {:.4f}]\n", what, index, estimate.value, estimate.lower,
             estimate.upper);
  return index >= estimate.lower - round_off && index <= estimate.upper + round_off;
}

// 256 rows of four inputs, of which the constants of the calibration are one, are 1536 launches: their
// indices by differences have intervals in which those of 96 launches lie. A polynomial that is fitted to all
// of them but 32 is nearer to the truth than either: of 24 intervals that are told of 96 launches one or two
// may miss it, here 2.
TEST(SurrogateSlow, IndicesFromNinetySixLaunchesLieWithinTheIntervalsOfThoseFromSixteenTimesAsMany) {
  const SensitivityResult few = run_sensitivity(shipped_study({}), two_jobs());
  ASSERT_EQ(few.answers.size(), 96u);
  const SensitivityResult many = run_sensitivity(
      shipped_study(
          {{"method = ", "method = \"sobol\""}, {"samples = ", "samples = 256"}, {"held_out = ", ""}}),
      two_jobs());
  ASSERT_EQ(many.answers.size(), 1536u);
  const Study& study = many.study.study;
  SurrogateRecord record{.scene = many.study.scene.scene,
                         .keys = std::vector<std::string>(study.axes.size()),
                         .inputs = uncertain_inputs(study)};
  for (std::size_t row = 0; row < 1536; ++row)
    std::ranges::copy(record.inputs.point_of(many.study.cases.coordinates(row)),
                      std::back_inserter(record.points));
  for (std::size_t row = 47; row < 1536; row += 48) record.held_out.push_back(row);
  std::vector<std::size_t> begins;
  for (const SensitivityInput& input : inputs_of(study)) begins.push_back(input.first);
  begins.push_back(study.axes.size());
  int missed = 0;
  const math::SobolOptions bootstrap = settings_of<SensitivitySettings>(study).bootstrap();
  for (std::size_t i = 0; i < few.outputs.size(); ++i) {
    ASSERT_EQ(few.outputs[i].reason + many.outputs[i].reason, "") << i;
    SurrogateOutput fitted{.name = fmt::format("output {}", i), .values = many.outputs[i].values};
    fit_output(record, fitted);
    ASSERT_EQ(fitted.reason, "");
    const math::FiniteRows rows = record.fitted_rows(fitted.values);
    const math::SobolIndices all =
        math::chaos_indices(fitted.fit.chaos, rows.points, rows.values, begins, bootstrap);
    for (std::size_t input = 0; input + 1 < begins.size(); ++input) {
      const math::InputIndices& own = few.outputs[i].sobol.inputs[input];
      const math::InputIndices& by_differences = many.outputs[i].sobol.inputs[input];
      const std::string what = fmt::format("output {}, input {}, ", i, input);
      EXPECT_TRUE(lies_within(own.first.value, by_differences.first, what + "first order, differences"));
      EXPECT_TRUE(lies_within(own.total.value, by_differences.total, what + "total order, differences"));
      missed += !lies_within(all.inputs[input].first.value, own.first, what + "first order, fit");
      missed += !lies_within(all.inputs[input].total.value, own.total, what + "total order, fit");
      EXPECT_NEAR(own.total.value, all.inputs[input].total.value, 0.02) << what;
    }
  }
  EXPECT_LE(missed, 3);
}

}  // namespace

// The tables, page, JSON and pictures of sensitivity studies made by hand.
#include "facts_in_text.hpp"
#include "kinds/made_studies.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <string>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using kinds::SensitivityResult;
using testing::in_order;

std::string text_of(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "no text" : *text;
}

bool has_note(const Table& table, const std::string& part) {
  return std::any_of(table.notes.begin(), table.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

/// Lets the third evaluation fail.
SensitivityResult with_failure() {
  SensitivityResult result = made_sensitivity();
  result.answers[2] = broken_answer(result.study.study, "energy drift 0.2 at 3 ms");
  for (OutputSensitivity& output : result.outputs) output.values[2] = study::not_a_number;
  return result;
}

TEST(SensitivityReport, IndicesStandWithTheirIntervalsAndN) {
  const SensitivityResult result = made_sensitivity();
  const Table table = sensitivity_table(result, result.outputs[0]);
  EXPECT_EQ(table.title, "Sensitivity of T max at a gap of 0.02 cm");
  EXPECT_EQ(keys_of(table), (std::vector<std::string>{"input", "distribution", "first_order",
                                                      "first_order_lower", "first_order_upper", "total_order",
                                                      "total_order_lower", "total_order_upper"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(text_of(table.rows[0][0]), "peak pressure");
  EXPECT_EQ(text_of(table.rows[0][1]), "uniform from 400 to 600 MPa");
  EXPECT_EQ(text_of(table.rows[1][1]), "log-uniform from 10 to 100 µm");
  EXPECT_EQ(text_of(table.rows[2][1]), "normal, 1 ± 0.1 mm, cut off at 0.5 and 1.5 mm");
  EXPECT_EQ(std::get<double>(table.rows[0][5]), 0.7);
  EXPECT_NEAR(std::get<double>(table.rows[0][6]), 0.6, 1e-12);
  for (const char* part : {"N = 4 rows", "20 evaluations", "scrambled Sobol", "seed 1", "95%", "Mean 470 K"})
    EXPECT_TRUE(has_note(table, part)) << part;
}

TEST(SensitivityReport, AnOutputWithoutIndicesShowsTheReason) {
  SensitivityResult result = made_sensitivity();
  result.outputs[1].bounds = 7;
  result.outputs[1].missing = 7;
  result.outputs[1].reason = "7 of 20 critical gaps are bounds, not numbers";
  const Table table = sensitivity_table(result, result.outputs[1]);
  for (const auto& row : table.rows)
    EXPECT_TRUE(std::all_of(row.begin() + 2, row.end(), [](const Cell& cell) { return cell == Cell(); }))
        << "no number is shown";
  const std::string& reason = result.outputs[1].reason;
  EXPECT_TRUE(has_note(table, reason));
  EXPECT_TRUE(in_order(answer(result), {"critical gap", reason}));
  EXPECT_TRUE(in_order(to_csv(sensitivity_table(result)), {"critical_gap,,", reason, "peak pressure,"}));
  EXPECT_TRUE(json_of(result)["indices"][3]["total_order"].is_null());
  EXPECT_EQ(json_of(result)["outputs"][1]["reason"], reason);
}

TEST(SensitivityReport, RanksOnlyWhatTheIntervalsTellApart) {
  SensitivityResult result = made_sensitivity();
  EXPECT_TRUE(in_order(answer(result), {"T max", "peak pressure (0.7 [0.6, 0.8])", "then",
                                        "charge.crack_radius (0.3 [0.2, 0.4])", "then",
                                        "flaw size (0.02 [0.01, 0.03])", "without influence", "flaw size"}));
  EXPECT_TRUE(in_order(answer(with_failure()), {"1 of 20", "5.0%", "sample 1", "energy drift"}));
  // The first two overlap now.
  result.outputs.resize(1);
  result.outputs[0].sobol.inputs[0].total = estimate(0.45, 0.2);
  EXPECT_TRUE(in_order(answer(result), {"peak pressure (0.45 [0.25, 0.65]) and charge.crack_radius", "then",
                                        "N = 4", "peak pressure and charge.crack_radius"}));
  // And now all of them.
  for (auto& input : result.outputs[0].sobol.inputs) input.total = estimate(0.5, 0.4);
  EXPECT_TRUE(in_order(answer(result), {"N = 4", "too few"}));
  EXPECT_EQ(answer(result).find(", then "), std::string::npos) << answer(result);
}

TEST(SensitivityReport, WithoutIntervalsNothingIsRanked) {
  SensitivityResult result = made_sensitivity();
  result.outputs.resize(1);
  for (auto& input : result.outputs[0].sobol.inputs)
    input.total.lower = input.total.upper = study::not_a_number;
  EXPECT_NE(answer(result).find("too few to tell"), std::string::npos) << answer(result);
}

// Evaluations 0, 1, 5, 6, 10, ... are A and B of four rows: critical gaps of 400 um less a micrometre each.
// Of 8 draws the quantile of 2.5 % is the first and that of 50 % the fourth.
TEST(SensitivityReport, QuantilesAreThoseOfTheDrawsAlone) {
  const auto json = json_of(made_sensitivity());
  const auto& rows = json["quantiles"];
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0]["share_percent"], 2.5);
  EXPECT_NEAR(rows[0]["critical_gap_cm"].get<double>(), 0.0384, 1e-12);
  EXPECT_NEAR(rows[2]["critical_gap_cm"].get<double>(), 0.0390, 1e-12);
  EXPECT_NEAR(rows[4]["critical_gap_cm"].get<double>(), 0.0400, 1e-12);
  std::int64_t draws = 0;
  for (const auto& row : json["histogram"])
    if (row["output"] == "critical_gap") draws += row["draws"].get<std::int64_t>();
  EXPECT_EQ(draws, 8);
}

// Of the first four draws (400, 399, 395, 394 um) half are at or below 395 um, of all eight 390 um.
TEST(SensitivityReport, PictureSaysHowTheCriticalGapSettlesWithTheDraws) {
  const report::Report report = report_of(made_sensitivity());
  const report::Picture* picture = nullptr;
  for (const auto& item : report.items)
    if (const auto* each = std::get_if<report::Picture>(&item);
        each != nullptr && each->file == "histogram.svg")
      picture = each;
  ASSERT_NE(picture, nullptr);
  EXPECT_TRUE(picture->plot.named_in_place) << "the lines of median and gap asked for look the same";
  EXPECT_TRUE(picture->plot.vertical_lines[0].label.starts_with("median: "));
  EXPECT_TRUE(picture->plot.subtitle.ends_with("; the last 4 moved the median by 0.0005 cm"))
      << picture->plot.subtitle;
}

TEST(SensitivityReport, ACriticalGapThatIsNoNumberHasARankAndNoValue) {
  SensitivityResult result = made_sensitivity();
  for (const auto& [evaluation, kind] :
       {std::pair{0, CriticalGapKind::all_ignite}, std::pair{1, CriticalGapKind::all_safe}}) {
    const auto i = static_cast<std::size_t>(evaluation);
    result.answers[i].critical.kind = kind;
    result.answers[i].critical.value = result.outputs[1].values[i] = study::not_a_number;
  }
  const auto json = json_of(result);
  EXPECT_TRUE(json["quantiles"][0]["critical_gap_cm"].is_null());
  EXPECT_EQ(json["quantiles"][0]["critical_gap_reads_as"], "ignites without a gap");
  EXPECT_NEAR(json["quantiles"][2]["critical_gap_cm"].get<double>(), 0.0389, 1e-12);
  EXPECT_EQ(json["quantiles"][4]["critical_gap_reads_as"], "> 0.1 cm");
  EXPECT_EQ(json["histogram"][0]["reads_as"], "ignites without a gap");
  EXPECT_EQ(json["histogram"][0]["draws"], 1);
  EXPECT_TRUE(json["histogram"][0]["from"].is_null());
}

// One of eight: 0.3 to 52.7 % (Clopper and Pearson). A draw that failed may have ignited: 2 of 8 give 65.1 %.
TEST(SensitivityReport, TheProbabilityOfIgnitionHoldsWhateverFailedDrawsWouldHaveDone) {
  SensitivityResult result = made_sensitivity();
  result.answers[5].verdicts.front().ignition = result.answers[7].verdicts.front().ignition =
      NamedIgnition{};  // the second is no draw
  auto ignition = json_of(result)["ignition"];
  EXPECT_EQ(ignition["igniting"], 1);
  EXPECT_EQ(ignition["sound"], 8);
  EXPECT_NEAR(ignition["probability_from"].get<double>(), 0.0032, 5e-5);
  EXPECT_NEAR(ignition["probability_to"].get<double>(), 0.5265, 5e-5);
  EXPECT_TRUE(in_order(answer(result), {"Of 8 launches", "1 ignition", "0.02 cm", "0.316 % to 52.7 %"}));
  const auto expect_seven_of_eight = [&](const char* why) {
    ignition = json_of(result)["ignition"];
    EXPECT_EQ(ignition["sound"], 7) << why;
    EXPECT_NEAR(ignition["probability_from"].get<double>(), 0.0032, 5e-5) << why;
    EXPECT_NEAR(ignition["probability_to"].get<double>(), 0.6509, 5e-5) << why;
  };
  result.answers[6].validity_warnings = {"its stations are thinner than a cell"};
  expect_seven_of_eight("a warning");
  result.answers[6] = broken_answer(result.study.study, "energy drift");
  expect_seven_of_eight("a failure");
}

TEST(SensitivityReport, EveryEvaluationIsARow) {
  const SensitivityResult result = with_failure();
  const Table table = evaluation_table(result);
  ASSERT_EQ(table.rows.size(), 20u);
  EXPECT_EQ(keys_of(table),
            (std::vector<std::string>{"number", "evaluation", "peak_pressure_MPa", "charge_crack_radius_um",
                                      "flaw_size_mm", "temperature_max_K", "critical_gap_cm", "margin_K",
                                      "critical_gap_kind", "critical_gap_reads_as", "status", "reason"}));
  EXPECT_EQ(std::get<double>(table.rows[4][2]), 440.0);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(table.rows[2][6]));
  EXPECT_EQ(text_of(table.rows[2][11]), "energy drift 0.2 at 3 ms");
}

TEST(SensitivityReport, JsonHasMethodInputsOutputsAndEvaluations) {
  const auto json = json_of(made_sensitivity());
  EXPECT_EQ(json["kind"], "sensitivity");
  EXPECT_EQ(json["method"]["name"], "sobol");
  EXPECT_EQ(json["method"]["N"], 4);
  EXPECT_EQ(json["gap_cm"], 0.02);
  EXPECT_EQ(json["failed"], 0);
  EXPECT_EQ(json["indices"][0]["total_order"], 0.7);
  EXPECT_EQ(json["outputs"][1]["unit"], "cm");
  EXPECT_EQ(json["evaluations"].size(), 20u);
  EXPECT_EQ(json_of(with_failure())["failed"], 1);
}

// Of 20 evaluations one failed; each statistic would be over the other 19.
TEST(SensitivityReport, QuantilesAreEmptyAndNothingIsDrawnWhereAnEvaluationFailed) {
  const report::Report report = report_of(with_failure());
  for (const auto& item : report.items)
    if (const auto* picture = std::get_if<report::Picture>(&item)) {
      EXPECT_NE(picture->file, "histogram.svg");
    }
  const auto json = nlohmann::ordered_json::parse(report.json);
  ASSERT_EQ(json["quantiles"].size(), 5u);
  for (const auto& row : json["quantiles"]) {
    EXPECT_TRUE(row["critical_gap_cm"].is_null() && row["temperature_max_K"].is_null()) << row;
    EXPECT_EQ(row["critical_gap_reads_as"], "");
  }
  EXPECT_EQ(json["evaluations"].size(), 20u);
}

TEST(SensitivityReport, PicturesHaveIntervalsAndTheirConfidence) {
  SensitivityResult sobol = made_sensitivity();
  settings_of<SensitivitySettings>(sobol.study.study).confidence = 0.9;
  const Plot indices = sensitivity_plot(sobol, sobol.outputs[0]);
  ASSERT_EQ(indices.series.size(), 2u);
  EXPECT_EQ(indices.series[0].style, Style::filled_bars);
  EXPECT_TRUE(std::ranges::is_sorted(indices.series[0].x, std::greater()));
  EXPECT_EQ(indices.series[1].style, Style::horizontal_bars);
  EXPECT_EQ(indices.series[1].upper.size(), 3u);
  EXPECT_EQ(indices.series[1].label, "90 % interval");
  EXPECT_EQ(indices.series[1].mark, Mark::none);
  EXPECT_EQ(indices.y.tics.front().label, "peak pressure");
  EXPECT_TRUE(indices.title.starts_with("Peak pressure makes ")) << indices.title;
  EXPECT_TRUE(indices.subtitle.starts_with("peak pressure: ")) << indices.subtitle << ": by what it varies";
}

TEST(SensitivityReport, TheTitleSaysWhereNoInputActsThroughAnother) {
  SensitivityResult result = made_sensitivity();
  math::InputIndices& indices = result.outputs[0].sobol.inputs[1];
  for (math::InputIndices& each : result.outputs[0].sobol.inputs) each.first = each.total;
  const std::string without = sensitivity_plot(result, result.outputs[0]).title;
  EXPECT_TRUE(without.ends_with(", without interactions")) << without;
  indices = {estimate(0.1, 0.01), estimate(0.3, 0.1)};
  const std::string with = sensitivity_plot(result, result.outputs[0]).title;
  EXPECT_EQ(with.find("interactions"), std::string::npos) << with;
}

TEST(SensitivityReport, ATotalOrderBelowTheFirstIsCalledSamplingError) {
  SensitivityResult result = made_sensitivity();
  EXPECT_FALSE(has_note(sensitivity_table(result, result.outputs[0]), "sampling error"));
  result.outputs[0].sobol.inputs[1] = {estimate(0.35, 0.1), estimate(0.3, 0.1)};
  const Table table = sensitivity_table(result, result.outputs[0]);
  EXPECT_TRUE(has_note(table,
                       "charge.crack_radius (total 0.3 [0.2, 0.4], first 0.35 [0.25, 0.45]). Their intervals "
                       "overlap."));
  result.outputs[0].sobol.inputs[1].first = estimate(0.6, 0.1);
  EXPECT_TRUE(has_note(sensitivity_table(result, result.outputs[0]), "too narrow"));
}

TEST(SensitivityReport, WritesItsFilesTheSameEveryTime) {
  SensitivityResult result = made_sensitivity();
  const auto first = render_report(report_of(result)).files;
  result.timing = {99.0, 7, 29, 3e9, 88.0, 16};
  EXPECT_EQ(first, render_report(report_of(result)).files);
  EXPECT_EQ(first.size(), gnuplot_is_there() ? 9u : 6u);
}

}  // namespace
}  // namespace launchsafe::kinds

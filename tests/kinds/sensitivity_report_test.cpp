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

/// Lets the third evaluation fail.
SensitivityResult with_failure() {
  SensitivityResult result = made_sensitivity();
  result.rows[2] = broken_row(result.study.study, "energy drift 0.2 at 3 ms");
  for (OutputSensitivity& output : result.outputs) output.values[2] = study::not_a_number;
  return result;
}

TEST(SensitivityReport, IndicesStandWithTheirIntervalsAndN) {
  const SensitivityResult result = made_sensitivity();
  const Table table = sensitivity_table(result);
  EXPECT_EQ(keys_of(table),
            (std::vector<std::string>{"output", "reason", "input", "distribution", "first_order",
                                      "first_order_lower", "first_order_upper", "total_order",
                                      "total_order_lower", "total_order_upper"}));
  ASSERT_EQ(table.rows.size(), 9u);
  EXPECT_EQ(text_of(table.rows[0][2]), "peak pressure");
  EXPECT_EQ(std::get<double>(table.rows[0][7]), 0.7);
  EXPECT_NEAR(std::get<double>(table.rows[0][8]), 0.6, 1e-12);
}

TEST(SensitivityReport, AnOutputWithoutIndicesShowsTheReason) {
  SensitivityResult result = made_sensitivity();
  result.outputs[1].bounds = 7;
  result.outputs[1].missing = 7;
  result.outputs[1].reason = "7 of 20 critical gaps are bounds, not numbers";
  const std::string& reason = result.outputs[1].reason;
  EXPECT_TRUE(in_order(to_csv(sensitivity_table(result)), {"critical_gap,", reason, "peak pressure,"}));
  EXPECT_TRUE(json_of(result)["indices"][3]["total_order"].is_null());
  EXPECT_EQ(json_of(result)["outputs"][1]["reason"], reason);
}

TEST(SensitivityReport, RanksOnlyWhatTheIntervalsTellApart) {
  SensitivityResult result = made_sensitivity();
  EXPECT_TRUE(in_order(answer(result),
                       {"T max", "peak pressure (0.7 [0.6, 0.8])", "then",
                        "charge.crack_radius (0.3 [0.2, 0.4])", "then", "flaw size (0.02 [0.01, 0.03])"}));
  // The first two overlap now.
  result.outputs.resize(1);
  result.outputs[0].sobol.inputs[0].total = estimate(0.45, 0.2);
  EXPECT_TRUE(
      in_order(answer(result), {"peak pressure (0.45 [0.25, 0.65]) and charge.crack_radius", "then"}));
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
  EXPECT_EQ(json["method"]["name"], "polynomial-chaos");
  EXPECT_EQ(json["method"]["N"], 20);
  EXPECT_EQ(json["gap_cm"], 0.02);
  EXPECT_EQ(json["failed"], 0);
  EXPECT_EQ(json["indices"][0]["total_order"], 0.7);
  EXPECT_EQ(json["outputs"][1]["unit"], "cm");
  EXPECT_EQ(json["evaluations"].size(), 20u);
  EXPECT_EQ(json_of(with_failure())["failed"], 1);
}

TEST(SensitivityReport, WritesItsFilesTheSameEveryTime) {
  SensitivityResult result = made_sensitivity();
  const auto first = render_report(report_of(result)).files;
  result.timing = {99.0, 7, 29, 16};
  EXPECT_EQ(first, render_report(report_of(result)).files);
  EXPECT_EQ(first.size(), 6u);
}

}  // namespace
}  // namespace launchsafe::kinds

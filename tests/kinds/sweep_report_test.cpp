// The tables, page, JSON and pictures of sweeps made by hand.
#include "kinds/made_studies.hpp"
#include "launchsafe/report/table.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

std::size_t column_of(const Table& table, const std::string& key) {
  const auto keys = keys_of(table);
  const auto found = std::find(keys.begin(), keys.end(), key);
  EXPECT_NE(found, keys.end()) << key;
  return static_cast<std::size_t>(found - keys.begin());
}

const Cell& cell(const Table& table, std::size_t row, const std::string& key) {
  return table.rows.at(row).at(column_of(table, key));
}

std::string shown_text(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "no text" : *text;
}

bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell); }

/// One axis of crack radii with every kind of row.
CriticalGapResult one_axis() {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0, 1e-4});
  file.study.axes = {axis(file, "crack_radius", "charge.crack_radius", {5e-6, 30e-6, 50e-6, 100e-6, 400e-6}),
                     axis(file, "flaw_size", "charge.flaw_size", {1e-3})};
  return swept(std::move(file), [](const study::Study& study, const std::vector<double>& place) {
    if (place[0] == 5e-6) return all_safe_row(study);
    if (place[0] == 50e-6) return broken_row(study, "non-finite at 2 ms");
    if (place[0] == 400e-6) return all_ignite_row(study);
    return value_row(study, closed_form(496e6, place[0]));
  });
}

TEST(SweepReport, EveryCaseIsARowInTheUnitsPeopleUse) {
  const Table table = critical_gap_table(made_sweep());
  ASSERT_EQ(table.rows.size(), 36u);
  const auto keys = keys_of(table);
  EXPECT_EQ(keys[0], "peak_pressure_MPa");
  EXPECT_EQ(keys[1], "crack_radius_um");
  EXPECT_EQ(std::get<double>(cell(table, 7, "peak_pressure_MPa")), 400.0);
  EXPECT_EQ(std::get<double>(cell(table, 8, "crack_radius_um")), 30.0) << "exactly, as it was written";
  EXPECT_NEAR(std::get<double>(cell(table, 8, "critical_gap_cm")), 100 * closed_form(400e6, 30e-6), 1e-12);
  EXPECT_EQ(shown_text(cell(table, 8, "critical_gap_kind")), "value");
}

TEST(SweepReport, TheEndOfASearchIsNeverANumberAmongTheCriticalGaps) {
  const CriticalGapResult result = made_sweep();
  const Table table = critical_gap_table(result);
  std::map<std::string, std::size_t> kinds;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string kind = shown_text(cell(table, row, "critical_gap_kind"));
    ++kinds[kind];
    EXPECT_EQ(is_empty(cell(table, row, "critical_gap_cm")), kind == "all-safe" || kind == "unknown") << row;
  }
  EXPECT_EQ(kinds["value"], 31u);
  EXPECT_EQ(kinds["all-safe"], 3u);
  EXPECT_EQ(kinds["unknown"], 1u);
  EXPECT_EQ(std::get<double>(cell(table, 35, "critical_gap_cm")), 0.0);
  EXPECT_EQ(shown_text(cell(table, 0, "critical_gap_reads_as")), "> 0.1 cm");
  const auto json = json_of(result);
  EXPECT_TRUE(json["cases"][0]["critical_gap_cm"].is_null());
  EXPECT_EQ(json["cases"][0]["critical_gap_kind"], "all-safe");
}

TEST(SweepReport, TheLongTableHasARowForEveryGap) {
  const Table table = verdict_table(made_sweep());
  EXPECT_EQ(table.rows.size(), 180u);
  const auto keys = keys_of(table);
  EXPECT_EQ((std::vector<std::string>{keys.begin(), keys.begin() + 5}),
            (std::vector<std::string>{"gap_cm", "peak_pressure_MPa", "crack_radius_um", "flaw_size_mm",
                                      "temperature_max_K"}));
  EXPECT_EQ(std::get<double>(cell(table, 8, "gap_cm")), 0.039);
  EXPECT_EQ(shown_text(cell(table, 179, "ignition")), "T1 at 17.86 ms, G1");
  const std::string csv = to_csv(table);
  EXPECT_NE(csv.find("\r\n0,350,10,1,416.1,G1,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n0.01,450,100,1,NaN,"), std::string::npos);
}

TEST(SweepReport, TheAxesTakeTheUnitInWhichTheirValuesReadBest) {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
  const auto key_of = [&](const std::string& key, std::vector<double> values) {
    study::StudyFile one = file;
    one.study.axes = {axis(file, key, key, std::move(values))};
    return keys_of(critical_gap_table(swept(
                       one, [](const study::Study& study, const auto&) { return all_safe_row(study); })))
        .front();
  };
  EXPECT_EQ(key_of("charge.flaw_size", {0.5e-3, 1e-3, 2e-3}), "charge_flaw_size_mm");
  EXPECT_EQ(key_of("charge.crack_radius", {10e-6, 30e-6, 100e-6}), "charge_crack_radius_um");
  EXPECT_EQ(key_of("load.peak", {500e6, 1000e6, 1500e6}), "load_peak_MPa");
  EXPECT_EQ(key_of("kinetics.ignition_temperature", {520, 525}), "kinetics_ignition_temperature_K");
  EXPECT_EQ(key_of("friction.localisation", {700, 800}), "friction_localisation");
}

TEST(SweepReport, JsonHasAxesCountsAndCases) {
  const CriticalGapResult result = made_sweep();
  const auto json = json_of(result);
  EXPECT_EQ(json["kind"], "critical-gap");
  EXPECT_EQ(json["axes"][0]["scene_key"], "load.peak");
  EXPECT_EQ(json["axes"][1]["values"][2], 30.0);
  EXPECT_EQ(json["counts"]["critical_gaps"]["value"], 31);
  EXPECT_EQ(json["counts"]["verdicts"]["INDETERMINATE"], 5);
  ASSERT_EQ(json["cases"].size(), 36u);
  EXPECT_EQ(json["cases"][8]["crack_radius_um"], 30.0);
  EXPECT_EQ(json["cases"][8]["critical_gap_kind"], "value");
  EXPECT_EQ(json["cases"][16]["reason"], "energy drift 0.2 at 3 ms");
  EXPECT_EQ(json["cases"][8]["status"], "completed");
  ASSERT_EQ(json["verdicts"].size(), 180u) << "five for every case";
  const auto& second = json["verdicts"][8 * 5 + 1];
  EXPECT_EQ(second["crack_radius_um"], 30.0);
  EXPECT_EQ(second["gap_cm"], 0.01);
  EXPECT_EQ(second["verdict"], "SAFE");
  EXPECT_TRUE(json["verdicts"][16 * 5]["temperature_max_K"].is_null());
}

// --- pictures ---

// Six pressures and six crack radii: a line a radius, and its lower bound.
TEST(SweepPictures, TwoAxesMakeALineForEachValueOfTheShorterOne) {
  const auto made = gap_picture(made_sweep());
  ASSERT_TRUE(made);
  EXPECT_EQ(made->file, "critical_gap.svg");
  const Plot& plot = std::get<Plot>(made->drawing);
  EXPECT_EQ(plot.x.label, "peak pressure [MPa]");
  EXPECT_EQ(plot.y.label, "critical gap [cm]");
  EXPECT_EQ(plot.x.scale, Scale::linear);
  const Series &value = *std::ranges::find(plot.series, "crack radius 30 µm", &Series::label),
               &lower = *std::ranges::find(plot.series, "lower bound, 30 µm", &Series::label);
  EXPECT_NEAR(value.y[3], 0.0395, 1e-12);
  EXPECT_NEAR(lower.y[3], 0.0395 - 0.0004, 1e-12);
  EXPECT_EQ(lower.style, Style::dashed_line);
  EXPECT_EQ(lower.colour, value.colour) << "one colour a line";
}

TEST(SweepPictures, WhatIsNoValueIsAMarkByItsReasonAndBreaksItsLine) {
  const Plot plot = std::get<Plot>(gap_picture(made_sweep()).value().drawing);
  std::size_t values = 0;
  for (std::size_t line = 0; line < 6; ++line)
    for (const double value : plot.series[line].y) values += std::isfinite(value) ? 1 : 0;
  EXPECT_EQ(values, 31u);
  const auto named = [&](const std::string& label) -> const Series& {
    return *std::ranges::find(plot.series, label, &Series::label);
  };
  EXPECT_EQ(named("no ignition up to here").x.size(), 3u);
  EXPECT_EQ(plot.subtitle, "not drawn: 1 case without a critical gap");
  EXPECT_TRUE(std::isnan(plot.series[4].y[2]));
}

TEST(SweepPictures, MoreThanTwoAxesMakeNoPicture) {
  EXPECT_FALSE(gap_picture(made_sweep({0.5e-3, 1e-3}, "charge.flaw_size")));
}

TEST(SweepPictures, OneAxisMakesOneLineWithItsLowerBoundAndMarks) {
  const auto made = gap_picture(one_axis());
  ASSERT_TRUE(made);
  const Plot& curve = std::get<Plot>(made->drawing);
  EXPECT_EQ(curve.title, "Critical gap over crack radius, flaw size 1 mm");
  EXPECT_EQ(curve.x.scale, Scale::logarithmic);
  EXPECT_TRUE(std::isnan(curve.series[0].y[2])) << "the line breaks at the failure";
  EXPECT_NEAR(curve.series[0].y[1] - curve.series[1].y[1], 4e-4, 1e-12);
  const auto bound = std::ranges::find(curve.series, Mark::up_triangle, &Series::mark);
  ASSERT_NE(bound, curve.series.end());
  EXPECT_EQ(bound->y, std::vector<double>{0.1});
}

// --- files ---

TEST(SweepReport, WritesItsFiles) {
  const CriticalGapResult result = made_sweep();
  const auto rendered = render_report(report_of(result));
  if (gnuplot_is_there()) {
    EXPECT_NE(text_in(rendered, "critical_gap.svg"), "");
  }
  EXPECT_EQ(nlohmann::ordered_json::parse(text_in(rendered, "study.json")), json_of(result));
  const std::string page = text_in(rendered, "report.md");
  EXPECT_TRUE(page.starts_with("# A made study\n")) << page.substr(0, 100);
  EXPECT_NE(page.find("launchsafe study studies/made.toml -o DIR"), std::string::npos);
  EXPECT_NE(page.find("350, 400, 450, 496, 550, 600 MPa"), std::string::npos);
  EXPECT_EQ(page.find("`load.peak` = "), std::string::npos) << "the scene's own value was not run";
}

}  // namespace
}  // namespace launchsafe::kinds

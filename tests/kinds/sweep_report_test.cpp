// The tables, page, JSON and pictures of sweeps made by hand.
#include "facts_in_text.hpp"
#include "kinds/made_studies.hpp"
#include "launchsafe/report/table.hpp"
#include "report/gnuplot.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using testing::in_order;

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

/// One axis of crack radii with every kind of answer.
CriticalGapResult one_axis() {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0, 1e-4});
  file.study.axes = {axis(file, "crack_radius", "charge.crack_radius", {5e-6, 30e-6, 50e-6, 100e-6, 400e-6}),
                     axis(file, "flaw_size", "charge.flaw_size", {1e-3})};
  return swept(std::move(file), [](const study::Study& study, const std::vector<double>& place) {
    if (place[0] == 5e-6) return all_safe_answer(study);
    if (place[0] == 50e-6) return broken_answer(study, "non-finite at 2 ms");
    if (place[0] == 400e-6) return all_ignite_answer(study);
    return value_answer(study, closed_form(496e6, place[0]));
  });
}

TEST(SweepReport, TellsWhatEachAxisChanges) {
  CriticalGapResult result = made_sweep();
  ASSERT_EQ(cell(axis_effect_table(result), 0, "critical_gap_change_cm"), Cell())
      << "one of the cases failed";
  result.answers[16] = value_answer(result.study.study, closed_form(450e6, 100e-6));
  const Table table = axis_effect_table(result);
  ASSERT_EQ(table.rows.size(), 3u);  // pressure, crack radius, and that below the flaw size of 1 mm
  // Among values at one crack radius: the largest difference of closed forms over the pressures.
  double most = 0.0;
  for (std::size_t crack = 0; crack < 6; ++crack) {
    double least = HUGE_VAL, largest = -HUGE_VAL;
    for (std::size_t pressure = 0; pressure < 6; ++pressure) {
      const study::CaseAnswer& answer = result.answers[6 * pressure + crack];
      if (answer.critical.kind != study::CriticalGapKind::value) continue;
      least = std::min(least, answer.critical.value);
      largest = std::max(largest, answer.critical.value);
    }
    most = std::max(most, largest - least);
  }
  EXPECT_NEAR(std::get<double>(cell(table, 0, "critical_gap_change_cm")), 100.0 * most, 1e-12);
  EXPECT_NE(to_markdown(report_of(result)).find("What each axis changes"), std::string::npos);
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

TEST(SweepReport, ABoundIsNeverANumberAmongTheValues) {
  CriticalGapResult result = made_sweep();
  // Even if someone had left a number in it.
  for (study::CaseAnswer& answer : result.answers) {
    if (answer.critical.kind != study::CriticalGapKind::value) answer.critical.value = 0.00077;
  }
  const Table table = critical_gap_table(result);
  std::size_t bounds = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (shown_text(cell(table, row, "critical_gap_kind")) == "value") continue;
    ++bounds;
    EXPECT_TRUE(is_empty(cell(table, row, "critical_gap_cm")));
  }
  EXPECT_EQ(bounds, 5u);
  EXPECT_EQ(shown_text(cell(table, 0, "critical_gap_reads_as")), "> 0.1 cm");
  EXPECT_EQ(shown_text(cell(table, 35, "critical_gap_reads_as")), "ignites without a gap");
  EXPECT_EQ(shown_text(cell(table, 16, "critical_gap_reads_as")), "indeterminate");
  const auto json = json_of(result);
  EXPECT_EQ(json.dump().find("0.077"), std::string::npos);
  EXPECT_TRUE(json["cases"][0]["critical_gap_cm"].is_null());
  EXPECT_EQ(json["cases"][0]["critical_gap_kind"], "all-safe");
  EXPECT_EQ(answer(result).find("0.077"), std::string::npos);
}

TEST(SweepReport, AFailedCaseHasItsReasonAndNoNumbers) {
  const Table table = critical_gap_table(made_sweep());
  EXPECT_EQ(shown_text(cell(table, 16, "status")), "energy drift");
  EXPECT_EQ(shown_text(cell(table, 16, "reason")), "energy drift 0.2 at 3 ms");
  EXPECT_TRUE(is_empty(cell(table, 16, "temperature_max_smallest_gap_K")));
  EXPECT_TRUE(is_empty(cell(table, 16, "energy_drift")));
}

TEST(SweepReport, EveryCaseSaysUpToWhichGapAVerdictHolds) {
  const Table table = critical_gap_table(made_sweep());
  EXPECT_EQ(shown_text(cell(table, 16, "verdicts")), "INDET. to 0.04");
  EXPECT_EQ(shown_text(cell(table, 0, "verdicts")), "SAFE to 0.04");
  EXPECT_EQ(shown_text(cell(table, 35, "verdicts")), "UNSAFE from 0");
  CriticalGapResult mixed = made_sweep();
  for (std::size_t i = 0; i < mixed.answers[0].verdicts.size(); ++i)
    mixed.answers[0].verdicts[i].judgement.verdict = i == 0   ? Verdict::safe
                                                     : i == 2 ? Verdict::unsafe
                                                              : Verdict::indeterminate;
  EXPECT_EQ(shown_text(cell(critical_gap_table(mixed), 0, "verdicts")),
            "SAFE to 0, INDET. to 0.01, UNSAFE from 0.02, INDET. to 0.04");
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

TEST(SweepReport, TheAnswerCountsAndNames) {
  const std::string text = answer(made_sweep());
  EXPECT_TRUE(
      in_order(text, {"36 cases", "peak pressure (350, 400, 450, 496, 550, 600 MPa)", "crack radius"}));
  EXPECT_TRUE(in_order(text, {"31 cases", "0.1 cm", "3 cases", "indeterminate in 1 case"}));
  EXPECT_NE(text.find("at 550 MPa, 200 µm"), std::string::npos) << "the smallest value";
  EXPECT_NE(text.find("at 600 MPa, 200 µm"), std::string::npos) << "no gap is safe";
  EXPECT_NE(text.find("130 SAFE, 45 UNSAFE, 5 INDETERMINATE"), std::string::npos);
  EXPECT_NE(text.find("450 MPa, 100 µm (energy drift 0.2 at 3 ms)"), std::string::npos);
  EXPECT_TRUE(in_order(text, {"5 cases", "crack bound 60"}));
  EXPECT_EQ(text.find("assumed"), std::string::npos);
  CriticalGapResult assumed = made_sweep();
  assumed.study.cases.complete_with([](study::StudyCase& made) { made.numerical_uncertainty = 60; });
  EXPECT_NE(answer(assumed).find("60 K for mesh, step and scaling, assumed"), std::string::npos);
}

TEST(SweepReport, AnUncertaintyStatedByHandIsToldWithItsSource) {
  CriticalGapResult stated = made_sweep();
  stated.study.study.stated = {{"fit_uncertainty", 2.0, "five rows held out"}};
  EXPECT_NE(answer(stated).find("Stated by hand: fit_uncertainty 2 K, because five rows held out."),
            std::string::npos);
  const auto json = nlohmann::json::parse(report_of(stated).json);
  EXPECT_EQ(json["stated_by_hand"][0]["K"], 2.0);
  EXPECT_EQ(json["stated_by_hand"][0]["because"], "five rows held out");
}

TEST(SweepReport, ManyFailuresAreNotAllListed) {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
  file.study.axes = {axis(file, "load.steepness", "load.steepness", {8, 9, 10, 11, 12, 13})};
  const CriticalGapResult result = swept(
      std::move(file), [](const study::Study& study, const auto&) { return broken_answer(study, "broken"); });
  EXPECT_NE(answer(result).find("load.steepness 8 (broken)"), std::string::npos) << answer(result);
  EXPECT_NE(answer(result).find("and 3 more"), std::string::npos);
  EXPECT_EQ(keys_of(critical_gap_table(result)).front(), "load_steepness");
}

TEST(SweepReport, TheAxesTakeTheUnitInWhichTheirValuesReadBest) {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
  const auto key_of = [&](const std::string& key, std::vector<double> values) {
    study::StudyFile one = file;
    one.study.axes = {axis(file, key, key, std::move(values))};
    return keys_of(critical_gap_table(swept(
                       one, [](const study::Study& study, const auto&) { return all_safe_answer(study); })))
        .front();
  };
  EXPECT_EQ(key_of("charge.flaw_size", {0.5e-3, 1e-3, 2e-3}), "charge_flaw_size_mm");
  EXPECT_EQ(key_of("charge.flaw_size", {1e-3, 2e-3, 4e-3}), "charge_flaw_size_mm");
  EXPECT_EQ(key_of("charge.crack_radius", {10e-6, 30e-6, 100e-6}), "charge_crack_radius_um");
  EXPECT_EQ(key_of("load.peak", {500e6, 1000e6, 1500e6}), "load_peak_MPa");
  EXPECT_EQ(key_of("gap.exchange_time", {0.24e-3, 0.36e-3}), "gap_exchange_time_ms");
  EXPECT_EQ(key_of("numerics.cell_size", {2.5e-3, 1.25e-3}), "numerics_cell_size_mm");
  EXPECT_EQ(key_of("load.duration", {10e-3, 18e-3}), "load_duration_ms");
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
  EXPECT_NEAR(second["temperature_max_inert_K"].get<double>(), 443.1, 1e-9);
  EXPECT_TRUE(json["verdicts"][16 * 5]["temperature_max_K"].is_null());
}

// --- pictures ---

// Six pressures and six crack radii: a line a radius, and its lower bound.
TEST(SweepPictures, TwoAxesMakeALineForEachValueOfTheShorterOne) {
  const GapPictures made = gap_pictures(made_sweep());
  ASSERT_EQ(made.pictures.size(), 1u);
  EXPECT_EQ(made.pictures[0].file, "critical_gap.svg");
  const Plot& plot = made.pictures[0].plot;
  EXPECT_EQ(plot.x.label, "peak pressure [MPa]");
  EXPECT_EQ(plot.y.label, "critical gap [cm]");
  EXPECT_EQ(plot.x.scale, Scale::linear);
  const Series &value = plot.series[2],
               &lower = *std::ranges::find(plot.series, "lower bound, 30 µm", &Series::label);
  EXPECT_EQ(value.label, "crack radius 30 µm");
  EXPECT_NEAR(value.y[3], 0.0395, 1e-12);
  EXPECT_NEAR(lower.y[3], 0.0395 - 0.0004, 1e-12);
  EXPECT_EQ(lower.style, Style::dashed_line);
  EXPECT_EQ(lower.colour, value.colour) << "one colour a line";
}

TEST(SweepPictures, WhatIsNoValueIsAMarkByItsReasonAndBreaksItsLine) {
  const Plot plot = gap_pictures(made_sweep()).pictures.front().plot;
  std::size_t values = 0;
  for (std::size_t line = 0; line < 6; ++line)
    for (const double value : plot.series[line].y) values += std::isfinite(value) ? 1 : 0;
  EXPECT_EQ(values, 31u);
  const auto named = [&](const std::string& label) -> const Series& {
    return *std::ranges::find(plot.series, label, &Series::label);
  };
  EXPECT_EQ(named("10, 20 µm: no ignition up to here").x.size(), 2u) << "of three, two at one place";
  EXPECT_TRUE(plot.subtitle.ends_with("; not drawn: 1 case indeterminate or failed")) << plot.subtitle;
  EXPECT_TRUE(std::isnan(plot.series[4].y[2]));
}

// By hand: case 15 alone has numerics of which no record speaks.
TEST(SweepPictures, WhereAShareIsAssumedTheLowerBoundIsOpenAndTheRowSaysWhich) {
  CriticalGapResult result = made_sweep();
  const auto drawn = [&] { return gap_pictures(result).pictures.front().plot; };
  const auto marks = [&](Mark mark) {
    std::vector<double> at;
    for (const Series& each : drawn().series)
      if (each.mark == mark) at.insert(at.end(), each.x.begin(), each.x.end());
    return at;
  };
  EXPECT_EQ(drawn().subtitle.find("squares: lower bounds, open where model form is assumed; "), 0u)
      << drawn().subtitle;
  EXPECT_EQ(marks(Mark::open_square).size(), 31u) << "of values";
  result.study.study.model_form_uncertainty = 1.0;
  EXPECT_TRUE(marks(Mark::open_square).empty());
  EXPECT_EQ(drawn().subtitle.find("assumed"), std::string::npos);
  result.study.cases.complete_with([](study::StudyCase& made) {
    if (made.label == "case 16") made.numerical_uncertainty_assumed = true;
  });
  EXPECT_NE(drawn().subtitle.find("open where computation is assumed"), std::string::npos);
  EXPECT_EQ(marks(Mark::open_square), std::vector<double>{450}) << "the third of six";
  EXPECT_EQ(marks(Mark::square).size(), 30u) << "of 31 values";
  const Plot plot = drawn();
  const auto dashes = std::ranges::find(plot.series, "lower bound, 50 µm", &Series::label);
  ASSERT_NE(dashes, plot.series.end());
  std::size_t breaks = 0;
  for (const double y : dashes->y) breaks += std::isnan(y) ? 1 : 0;
  EXPECT_EQ(breaks, 2u) << "no dashes from a bound where a share is assumed to one where none is";
  const Table table = critical_gap_table(result);
  EXPECT_EQ(shown_text(cell(table, 15, "assumed_shares")), "computation");
  EXPECT_EQ(shown_text(cell(table, 14, "assumed_shares")), "");
  result.study.study.model_form_uncertainty = study::not_a_number;
  EXPECT_EQ(shown_text(cell(critical_gap_table(result), 15, "assumed_shares")), "computation, model form");
  EXPECT_NE(drawn().subtitle.find("computation or model form is assumed"), std::string::npos);
}

/// Of two axes, peak pressure and crack radius.
study::StudyFile pressures_and_cracks() {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
  file.study.axes = {axis(file, "peak_pressure", "load.peak", {400e6, 450e6, 500e6}),
                     axis(file, "crack_radius", "charge.crack_radius", {1e-5, 3e-5})};
  return file;
}

// By hand: at 10 um the bound is 0 from 450 MPa on, at 30 um everywhere.
TEST(SweepPictures, LowerBoundsOfZeroAreSaidAndNotDrawn) {
  const Plot plot = gap_pictures(swept(pressures_and_cracks(),
                                       [](const study::Study& study, const std::vector<double>& at) {
                                         study::CaseAnswer answer =
                                             value_answer(study, 4e-4 - 1e-12 * (at[0] - 400e6) - at[1]);
                                         if (at[0] > 401e6 || at[1] > 2e-5)
                                           answer.critical.bounds.at_least = 0.0;
                                         return answer;
                                       }))
                        .pictures.at(0)
                        .plot;
  EXPECT_TRUE(plot.subtitle.ends_with("; nothing shown safe at 10 µm from 450 MPa on, at 30 µm at all"))
      << plot.subtitle;
  for (const Series& each : plot.series)
    for (const double gap : each.y) EXPECT_FALSE(gap <= 0.0) << each.label;
}

TEST(SweepPictures, WhatDiffersByLessThanItIsKnownToIsNotDrawn) {
  const auto pictures_of = [](double difference) {
    study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
    file.study.axes = {axis(file, "peak_pressure", "load.peak", {400e6, 450e6, 500e6})};
    return gap_pictures(swept(std::move(file),
                              [=](const study::Study& study, const std::vector<double>& at) {
                                return value_answer(study, 4e-4 + difference * (at[0] > 401e6));
                              }))
        .pictures.size();
  };
  EXPECT_EQ(pictures_of(3.9e-6), 0u) << "of lower bounds that are 4 um below";
  EXPECT_EQ(pictures_of(4.1e-6), 1u);
}

TEST(SweepPictures, TheTitleTellsOfOneLineAndWhatDoesNotVary) {
  const auto made = gap_pictures(made_sweep({0.5e-3}, "charge.flaw_size"));
  ASSERT_EQ(made.pictures.size(), 1u);
  // Of six lines the lowest of those with most values.
  const auto& drawn = made.pictures[0].plot.series;
  const Series* lowest = nullptr;
  for (std::size_t i = 0; i < 6; ++i)
    if (std::ranges::all_of(drawn[i].y, [](double y) { return std::isfinite(y); }) &&
        (lowest == nullptr || drawn[i].y[0] < lowest->y[0]))
      lowest = &drawn[i];
  ASSERT_NE(lowest, nullptr);
  EXPECT_EQ(made.pictures[0].plot.title,
            fmt::format("Critical gap falls from {} cm at 350 MPa to {} cm at 600 MPa, {}, flaw size 0.5 mm",
                        report::significant(lowest->y.front(), 2), report::significant(lowest->y.back(), 2),
                        lowest->label));
}

TEST(SweepPictures, MoreThanTwoAxesMakeNoPicture) {
  EXPECT_TRUE(gap_pictures(made_sweep({0.5e-3, 1e-3}, "charge.flaw_size")).pictures.empty());
}

// By hand: the gaps of 10 and 30 um are alike, their lower bounds are not.
TEST(SweepPictures, LinesOnEachOtherAreOneWithTheNamesOfAll) {
  const Plot plot = gap_pictures(swept(pressures_and_cracks(),
                                       [](const study::Study& study, const std::vector<double>& at) {
                                         study::CaseAnswer answer =
                                             value_answer(study, 4e-4 - 1e-12 * (at[0] - 400e6));
                                         if (at[1] > 2e-5) answer.critical.bounds.at_least -= 1e-4;
                                         return answer;
                                       }))
                        .pictures.at(0)
                        .plot;
  std::vector<std::string> names;
  for (const Series& each : plot.series)
    if (each.style <= Style::line_and_points && each.style != Style::points &&
        std::ranges::any_of(each.y, [](double y) { return std::isfinite(y); }))
      names.push_back(each.label);
  EXPECT_EQ(names,
            (std::vector<std::string>{"crack radius 10, 30 µm", "lower bound, 10 µm", "lower bound, 30 µm"}));
}

TEST(SweepPictures, OneAxisMakesOneLineWithItsLowerBoundAndMarks) {
  const GapPictures made = gap_pictures(one_axis());
  ASSERT_EQ(made.pictures.size(), 1u);
  EXPECT_EQ(made.pictures[0].file, "critical_gap.svg");
  const Plot& curve = made.pictures[0].plot;
  EXPECT_TRUE(curve.title.ends_with(", flaw size 1 mm")) << curve.title;
  EXPECT_EQ(curve.x.scale, Scale::logarithmic);
  EXPECT_TRUE(std::isnan(curve.series[0].y[2])) << "the line breaks at the failure";
  EXPECT_NEAR(curve.series[0].y[1] - curve.series[1].y[1], 4e-4, 1e-12);
  const auto bound = std::ranges::find(curve.series, "no ignition up to here", &Series::label);
  ASSERT_NE(bound, curve.series.end());
  EXPECT_EQ(bound->mark, Mark::up_triangle);
  EXPECT_EQ(bound->y, std::vector<double>{0.1});
}

TEST(SweepPictures, SingleValuesMakeNoPicture) {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0});
  file.study.axes = {axis(file, "peak_pressure", "load.peak", {496e6})};
  const CriticalGapResult result = swept(
      std::move(file), [](const study::Study& study, const auto&) { return value_answer(study, 4e-4); });
  const GapPictures made = gap_pictures(result);
  EXPECT_TRUE(made.pictures.empty());
  EXPECT_TRUE(render_report(report_of(result)).remarks.empty());
}

// By hand: along the pressure, the longer axis, all but one value are unknown.
TEST(SweepPictures, WhereNoLineJoinsTwoValuesAnotherAxisIsDrawn) {
  const GapPictures made = gap_pictures(
      swept(pressures_and_cracks(), [](const study::Study& study, const std::vector<double>& at) {
        study::CaseAnswer answer = value_answer(study, at[1] < 2e-5 ? 4e-4 : 3e-4);
        if (at[0] > 401e6) answer.critical.kind = study::CriticalGapKind::indeterminate;
        return answer;
      }));
  ASSERT_EQ(made.pictures.size(), 1u);
  EXPECT_EQ(made.pictures[0].plot.x.label, "crack radius [µm]");
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
  EXPECT_TRUE(page.starts_with("# A made study\n\nThe shot leaves the barrel with 773.9 m/s"))
      << page.substr(0, 100);
  EXPECT_NE(page.find("launchsafe study studies/made.toml -o DIR"), std::string::npos);
  EXPECT_NE(page.find("`load.peak` is varied: 350, 400, 450, 496, 550, 600 MPa"), std::string::npos);
  EXPECT_EQ(page.find("`load.peak` = "), std::string::npos) << "the scene's own value was not run";
}

TEST(SweepReport, NothingInTheFilesDependsOnTheRun) {
  CriticalGapResult result = made_sweep();
  const auto first = render_report(report_of(result)).files;
  result.timing = {99.0, 7, 29, 3e9, 88.0, 16};
  EXPECT_EQ(first, render_report(report_of(result)).files);
}

/// 15 pressures and 14 crack radii on 100 gaps.
CriticalGapResult large_sweep() {
  std::vector<double> gaps, first, second;
  for (int i = 0; i < 100; ++i) gaps.push_back(1e-5 * i);
  for (int i = 0; i < 15; ++i) first.push_back(300e6 + 10e6 * i);
  for (int i = 0; i < 14; ++i) second.push_back(10e-6 + 5e-6 * i);
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), gaps);
  file.study.axes = {axis(file, "peak_pressure", "load.peak", first),
                     axis(file, "crack_radius", "charge.crack_radius", second)};
  return swept(std::move(file), [](const study::Study& study, const std::vector<double>& place) {
    return value_answer(study, closed_form(place[0], place[1]));
  });
}

TEST(SweepReport, LongTablesAreCutOnThePage) {
  const CriticalGapResult result = large_sweep();
  const std::string page = to_markdown(report_of(result));
  EXPECT_TRUE(in_order(page, {"200 of 210 rows", "critical\\_gaps.csv"}));
  EXPECT_LT(page.size(), 200'000u);
}

}  // namespace
}  // namespace launchsafe::kinds

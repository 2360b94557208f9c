// The page, the picture and the files of a critical-gap study.
#include "launchsafe/report/critical_gap_report.hpp"

#include "launchsafe/report/interface_table.hpp"
#include "launchsafe/report/number.hpp"
#include "study_text.hpp"
#include "verdict_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

using study::CaseOutcome, study::CriticalGapKind, study::CriticalGapResult;

std::string answer_of(const CaseOutcome& outcome) {
  const study::CriticalGap& gap = outcome.critical;
  const std::string remark = gap.reason.empty() ? "" : " (" + gap.reason + ")";
  switch (gap.kind) {
    case CriticalGapKind::value: {
      const bool confirmed = !outcome.confirmations.empty();
      return fmt::format(
          "the critical gap is {}{}: {} does not ignite, {} does{}{}.", detail::centimetres(gap.value),
          std::isfinite(gap.uncertainty)
              ? fmt::format(", uncertain by {} cm", significant(100.0 * gap.uncertainty, 2))
              : std::string{},
          detail::centimetres(gap.lower), detail::centimetres(gap.upper),
          confirmed ? "; complete coupled runs on both sides agree" : "; not confirmed by coupled runs",
          remark);
    }
    case CriticalGapKind::all_safe:
      return fmt::format("the critical gap is more than {}: {}.", detail::centimetres(gap.lower), gap.reason);
    case CriticalGapKind::all_ignite:
      return fmt::format("no gap is safe: {}.", gap.reason);
    case CriticalGapKind::indeterminate:
      break;
  }
  return fmt::format("the critical gap is indeterminate: {}.", gap.reason);
}

std::string uncertainty_text(const CriticalGapResult& result) {
  std::string text = detail::uncertainty_remark(result.study);
  for (const CaseOutcome& outcome : result.cases) {
    for (const study::Confirmation& each : outcome.confirmations) {
      if (!std::isfinite(each.difference)) continue;
      text += fmt::format(" Coupled minus traced at {} ({}): {} K.", detail::centimetres(each.gap),
                          outcome.input.label, scientific(each.difference, 1));
    }
  }
  return text + "\n";
}

/// What would make one share of a row's uncertainty smaller.
struct Remedy {
  const char* share;
  double size;  ///< K
  const char* how;
};

/// K that a share may be for the margin to exceed the uncertainty, the others as they are; NaN where none
/// may.
double allowed_share(const study::GapVerdict& row, double share) {
  const study::Uncertainty& u = row.uncertainty;
  const double left = row.margin - u.model_form;
  const double others = std::pow(u.total() - u.model_form, 2) - share * share;
  return left > 0.0 ? std::sqrt(left * left - others) : study::not_a_number;
}

bool is_within_uncertainty(const CaseOutcome& outcome, const study::GapVerdict& row) {
  return row.judgement.verdict == study::Verdict::indeterminate && !row.ignition && outcome.completed() &&
         row.evidence.doubt.empty() && row.margin > 0.0;
}

std::string undecided_row(const study::GapVerdict& row) {
  const study::Uncertainty& u = row.uncertainty;
  const Remedy largest = std::max(
      {Remedy{"the computation", u.computed(), "a finer setting, or a record of its accuracy"},
       Remedy{"the fit", u.fit, "more measured temperatures to calibrate on"},
       Remedy{"the inputs", u.inputs(), "a measured spread of peak pressure and initial temperature"},
       Remedy{"the model form", u.model_form, "measurements of how the shell holds the charge"}},
      [](const Remedy& a, const Remedy& b) { return a.size < b.size; });
  const double allowed = allowed_share(row, largest.size);
  return fmt::format(
      "{}: a margin of {} K against shares of {} K (computation), {} K (fit), {} K (inputs) and {} K (model "
      "form). "
      "The largest is that of {}; {} would reduce it, {}.\n",
      detail::centimetres(row.gap), significant(row.margin, 3), significant(u.computed(), 2),
      significant(u.fit, 2), significant(u.inputs(), 2), significant(u.model_form, 2), largest.share,
      largest.how,
      std::isfinite(allowed) ? fmt::format("and below {} K the row is decided", significant(allowed, 3))
                             : std::string("and the others have to shrink too"));
}

/// Which share keeps each row that did not ignite from a verdict, and what would reduce it; empty where none
/// does.
std::string undecided_text(const CriticalGapResult& result) {
  std::string text;
  for (const CaseOutcome& outcome : result.cases) {
    for (const study::GapVerdict& row : outcome.verdicts) {
      if (!is_within_uncertainty(outcome, row)) continue;
      text +=
          "- " + (result.cases.size() > 1 ? outcome.input.label + ", " : std::string{}) + undecided_row(row);
    }
  }
  return text.empty() ? text : "## What keeps rows undecided\n\n" + text;
}

/// What every page must say when bounds within the models were reached.
std::string limiter_remark(const CriticalGapResult& result) {
  std::string text;
  for (const CaseOutcome& outcome : result.cases) {
    const run::LimiterCounts& limiters = outcome.result.mechanics.limiters;
    if (!detail::acted(limiters)) continue;
    text += fmt::format("Limiters acted in {} ({} particle steps); its verdicts rest on them too.\n",
                        outcome.input.label, detail::limiters_text(limiters));
  }
  return text;
}

}  // namespace

std::string answer(const CriticalGapResult& result) {
  if (result.cases.size() == 1) {
    std::string text = answer_of(result.cases.front());
    text.front() = 'T';
    if (!text.starts_with("The")) text.front() = 'N';
    return text;
  }
  std::string text;
  for (const CaseOutcome& outcome : result.cases)
    text += (text.empty() ? "" : "\n") + outcome.input.label + ": " + answer_of(outcome);
  return text;
}

std::string to_markdown(const CriticalGapResult& result, const std::string& picture) {
  std::string text = fmt::format("# {}\n\n{}\n\n", result.study.study.title, answer(result));
  text += fmt::format("    {}\n\n", detail::remaking_command(result.study));
  text += to_markdown(verdict_table(result)) + "\n";
  if (!picture.empty()) text += fmt::format("![T max against gap]({})\n\n", picture);
  if (const Table table = comparison_table(result); !table.rows.empty()) text += to_markdown(table) + "\n";
  text += to_markdown(critical_gap_table(result)) + "\n";
  if (const Table table = cited_limit_table(result); !table.rows.empty()) text += to_markdown(table) + "\n";
  if (const Table table = air_model_table(result); !table.rows.empty()) text += to_markdown(table) + "\n";
  if (const Table table = air_energy_table(result); !table.rows.empty()) text += to_markdown(table) + "\n";
  for (const CaseOutcome& outcome : result.cases) {
    if (outcome.fit) text += to_markdown(fit_table(outcome)) + "\n";
  }
  if (const std::string undecided = undecided_text(result); !undecided.empty()) text += undecided + "\n";
  text += "## What it rests on\n\n" + detail::friction_remark(result.study) + "\n";
  text += uncertainty_text(result) + "\n";
  if (const std::string remark = limiter_remark(result); !remark.empty()) text += remark + "\n";
  text += "## Setup\n\n" + detail::setup_text(result.study) + "\n";
  for (const CaseOutcome& outcome : result.cases) {
    Table faces = interface_table(outcome.result.mechanics);
    if (faces.rows.empty()) continue;
    if (result.cases.size() > 1) faces.title += ", " + outcome.input.label;
    text += to_markdown(faces) + "\n";
  }
  text += to_markdown(run_table(result)) + "\n" + detail::timing_text(result.timing) + "\n";
  return text;
}

Plot temperature_plot(const CriticalGapResult& result) {
  Plot plot;
  plot.title = "Highest temperature of the charge bottom";
  plot.x.label = "gap [cm]";
  plot.y.label = "T max [K]";
  Series published{"published", {}, {}, Style::points};
  published.mark = Mark::open_square;
  for (const CaseOutcome& outcome : result.cases) {
    Series series{result.cases.size() == 1 ? "computed" : outcome.input.label, {}, {}, Style::points};
    for (const study::GapVerdict& row : outcome.verdicts) {
      series.x.push_back(100.0 * row.gap);
      series.y.push_back(row.maximum.temperature);
    }
    plot.series.push_back(std::move(series));
    if (outcome.fit && result.cases.size() == 1) {
      Series line{"least squares", {}, {}, Style::line};
      for (const double gap : outcome.fit->gaps) {
        line.x.push_back(100.0 * gap);
        line.y.push_back(outcome.fit->ordinary.intercept + outcome.fit->ordinary.slope * 100.0 * gap);
      }
      plot.series.push_back(std::move(line));
    }
    if (outcome.critical.kind == CriticalGapKind::value)
      plot.vertical_lines.push_back(
          {100.0 * outcome.critical.value,
           fmt::format("critical gap{}: {} cm", result.cases.size() == 1 ? "" : " of " + outcome.input.label,
                       significant(100.0 * outcome.critical.value, 3))});
  }
  for (const study::Reference& reference : result.study.study.references) {
    published.x.push_back(100.0 * reference.gap);
    published.y.push_back(reference.maximum_temperature);
  }
  if (!published.x.empty()) plot.series.push_back(std::move(published));
  const double ignition = result.study.scene.scene.charge().kinetics.ignition_temperature;
  plot.horizontal_lines.push_back(
      {ignition, fmt::format("ignition temperature: {} K", significant(ignition, 4))});
  return plot;
}

store::Result<WrittenFiles> write_report(const CriticalGapResult& result, const std::filesystem::path& folder,
                                         const DrawingLimits& limits) {
  WrittenFiles written;
  const Table verdicts = verdict_table(result);
  if (auto error = detail::write_texts(
          folder, {{"verdicts.csv", to_csv(verdicts)}, {"verdicts.md", to_markdown(verdicts)}}, written)) {
    return *error;
  }
  for (const CaseOutcome& outcome : result.cases) {
    if (outcome.result.mechanics.trace.samples() == 0) continue;
    if (auto error = detail::write_case(folder, outcome.input, outcome.result, outcome.start_time, written))
      return *error;
  }
  const auto picture =
      detail::write_picture(temperature_plot(result), folder, "temperature.svg", written, limits);
  if (!picture) return picture.error();
  const std::string page = to_markdown(result, *picture) + detail::missing_picture_text(*picture);
  if (auto error = detail::write_texts(
          folder, {{"report.md", page}, {"study.json", detail::json_file_text(to_json(result))}}, written)) {
    return *error;
  }
  return written;
}

}  // namespace launchsafe::report

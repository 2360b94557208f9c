#include "sensitivity_parts.hpp"

namespace launchsafe::kinds {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double ignition_level = 0.95;
/// The shares of the draws at which quantiles are told.
constexpr std::array quantile_shares{0.025, 0.05, 0.5, 0.95, 0.975};

/// Its place in the order of the draws; NaN where nothing is known.
double ranked(const OutputSensitivity& output, const CaseAnswer& answer, double value) {
  if (output.output != SensitivityOutput::critical_gap || !answer.completed()) return value;
  if (answer.critical.kind == CriticalGapKind::all_ignite) return -infinite;
  return answer.critical.kind == CriticalGapKind::all_safe ? infinite : value;
}

struct OutputSample {
  /// SI, ascending. A critical gap that is no number is minus infinity where the launch ignites without a
  /// gap, and infinity where nothing ignites up to the end of the search: it has a rank and no value.
  std::vector<double> values;
  std::size_t missing = 0;  ///< draws of which nothing is known
  bool all_known = true;    ///< something is known of every evaluation; else there are no quantiles
  std::size_t count(double value) const {
    return static_cast<std::size_t>(std::ranges::count(values, value));
  }
  std::size_t ignites_at_zero() const { return count(-infinite); }
  std::size_t none_ignites() const { return count(infinite); }
  /// The smallest draw that at least this share (0 to 1) of them does not exceed; NaN where there is none.
  double quantile(double share) const {
    if (!all_known || values.empty()) return not_a_number;
    constexpr double round_off = 1e-9;
    const auto size = static_cast<double>(values.size());
    const double rank = std::clamp(std::ceil(share * size - round_off), 1.0, size);
    return values[static_cast<std::size_t>(rank) - 1];
  }
};

/// `most`: of so many draws, the first of all.
OutputSample sample_of(const SensitivityResult& result, const OutputSensitivity& output,
                       std::size_t most = std::numeric_limits<std::size_t>::max()) {
  OutputSample sample;
  for (std::size_t i = 0; i < output.values.size(); ++i) {
    const double value = ranked(output, result.answers[i], output.values[i]);
    sample.all_known = sample.all_known && !std::isnan(value);
    if (!samples_inputs(result.study.study, i) || sample.values.size() >= most) continue;
    if (std::isnan(value))
      ++sample.missing;
    else
      sample.values.push_back(value);
  }
  std::ranges::sort(sample.values);
  return sample;
}

const OutputSensitivity* output_of(const SensitivityResult& result, SensitivityOutput which) {
  const auto found = std::ranges::find(result.outputs, which, &OutputSensitivity::output);
  return found == result.outputs.end() ? nullptr : &*found;
}

/// The outputs whose distribution is told: the margin's is that of T max and of the trigger.
std::vector<const OutputSensitivity*> told_outputs(const SensitivityResult& result) {
  std::vector<const OutputSensitivity*> told;
  for (const auto which : {SensitivityOutput::critical_gap, SensitivityOutput::maximum_temperature})
    if (const OutputSensitivity* output = output_of(result, which)) told.push_back(output);
  return told;
}

/// "0.0278 cm", "ignites without a gap", "> 0.4 cm".
std::string quantile_text(const SensitivityResult& result, double gap) {
  if (std::isnan(gap)) return {};
  if (std::isfinite(gap)) return in_words(gap, significant(3, centimetre));
  return gap < 0 ? "ignites without a gap" : "> " + centimetres(result.study.study.largest_gap);
}

std::string title_of(const SensitivityResult& result, const OutputSensitivity& output) {
  return shown_output(output.output).column.heading + (output.inert ? " without reaction" : "") +
         at_gap(result.study.study, output.output);
}

/// What is to be known of the numbers of an output.
std::string sample_note(const SensitivityResult& result, const OutputSensitivity& output) {
  const OutputSample sample = sample_of(result, output);
  return said("sensitivity.sample", {{"title", title_of(result, output)},
                                     {"draws", sample.values.size()},
                                     {"at_zero", sample.ignites_at_zero()},
                                     {"none", sample.none_ignites()},
                                     {"largest", centimetres(result.study.study.largest_gap)},
                                     {"missing", sample.missing}})
      .front();
}

// --- histogram ---

/// Intervals of equal width; all in the unit shown.
struct Histogram {
  double first = 0, width = 0;       ///< the first interval is the one of that number, counted from 0
  std::vector<std::int64_t> counts;  ///< none where there are no two different numbers
  double edge(std::size_t i) const { return width * (first + static_cast<double>(i)); }
};

Histogram histogram_of(const OutputSample& sample, const ShownOutput& shown) {
  constexpr double most_intervals = 20.0;
  std::vector<double> values;
  for (const double value : sample.values)
    if (std::isfinite(value)) values.push_back(shown.value(value));
  Histogram histogram;
  if (values.empty() || !(values.back() > values.front())) return histogram;
  histogram.width = report::round_distance((values.back() - values.front()) / most_intervals);
  histogram.first = std::floor(values.front() / histogram.width);
  const auto place_of = [&](double value) {
    return static_cast<std::size_t>(std::max(0.0, std::floor(value / histogram.width) - histogram.first));
  };
  histogram.counts.resize(place_of(values.back()) + 1, 0);
  for (const double value : values) ++histogram.counts[place_of(value)];
  return histogram;
}

Plot plot_of(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput& shown = shown_output(output.output);
  const OutputSample sample = sample_of(result, output);
  const Histogram histogram = histogram_of(sample, shown);
  Plot plot{.title = title_of(result, output),
            .x = {.label = shown.column.label()},
            .y = {.label = "draws", .minimum = 0.0},
            .named_in_place = true};
  if (histogram.counts.empty() || !sample.all_known) return plot;
  const double low = shown.value(sample.quantile(quantile_shares.front())),
               high = shown.value(sample.quantile(quantile_shares.back()));
  const std::string unit = " " + shown.column.form.unit;
  if (std::isfinite(low) && std::isfinite(high)) {
    plot.title +=
        fmt::format(": {} to {}{} in 95 %", report::significant(low, 3), report::significant(high, 3), unit);
    plot.vertical_bands = {{low, high, "95 % of the draws"}};
  }
  plot.subtitle = fmt::format("{} draws", sample.values.size());
  if (const std::size_t count = sample.ignites_at_zero())
    plot.subtitle += fmt::format("; {} ignite without a gap", count);
  if (const std::size_t count = sample.none_ignites())
    plot.subtitle += fmt::format("; {} ignite at no gap", count);
  Series steps{.style = Style::steps, .colour = 0};
  steps.add(histogram.edge(0), 0.0);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i)
    steps.add(histogram.edge(i), static_cast<double>(histogram.counts[i]));
  steps.add(histogram.edge(histogram.counts.size()), 0.0);
  plot.series = {std::move(steps)};
  const double half = shown.value(sample.quantile(0.5));
  if (std::isfinite(half)) {
    plot.vertical_lines.push_back({half, "median: " + report::significant(half, 3) + unit});
    // Whether more draws would change it.
    const std::size_t all = sample.values.size();
    if (const double before = shown.value(sample_of(result, output, all / 2).quantile(0.5));
        std::isfinite(before))
      plot.subtitle += fmt::format("; the last {} moved the median by {}{}", all - all / 2,
                                   report::significant(std::abs(half - before), 2), unit);
  }
  if (output.output == SensitivityOutput::critical_gap)
    plot.vertical_lines.push_back({shown_gap(result.study.study.gaps.front()),
                                   "the gap asked for: " + centimetres(result.study.study.gaps.front())});
  return plot;
}

/// What a share of the draws is at or below.
struct QuantileRow {
  double share;
  double gap;  ///< m; infinite where it is a bound
  std::string gap_reads_as;
  double temperature;  ///< K
};

const Quantities<QuantileRow> quantile_quantities{
    {"share", "share at or below", significant(3, percent), "Share of the draws.", &QuantileRow::share},
    {for_programs(quantity::critical_gap), &QuantileRow::gap},
    {quantity::critical_gap_reads_as, &QuantileRow::gap_reads_as},
    {quantity::temperature_max, [](const QuantileRow& row) { return report::known(row.temperature); }}};

/// An interval of a histogram, or what has no number; numbers are in the unit of the row.
struct HistogramRow {
  const ShownOutput* shown;
  double from, to;
  std::string reads_as;
  std::int64_t draws;
};

const Quantities<HistogramRow> histogram_quantities{
    {quantity::output, &HistogramRow::shown, &ShownOutput::column, &Column::name},
    {quantity::unit, &HistogramRow::shown, &ShownOutput::column, &Column::form, &Form::unit},
    {"from", "from", significant(6), "Begin of the interval.", &HistogramRow::from},
    {"to", "to", significant(6), "End of the interval.", &HistogramRow::to},
    {"reads_as", "without a number", text(), "What those have that have no number.", &HistogramRow::reads_as},
    {"draws", "draws", count(), "Draws of the interval.", &HistogramRow::draws}};

}  // namespace

Row ignition_json(const SensitivityResult& result) {
  std::size_t igniting = 0, sound = 0, unsound = 0;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const CaseAnswer& answer = result.answers[i];
    if (!samples_inputs(result.study.study, i)) continue;
    // One with a validity warning may ignite, whatever it computed, as one that failed.
    const bool is_sound = answer.completed() && answer.validity_warnings.empty();
    ++(is_sound ? sound : unsound);
    igniting += is_sound && answer.verdicts.front().ignition;
  }
  const std::size_t all = sound + unsound;
  const auto interval = [&](std::size_t count) {
    return all == 0 ? math::Interval{not_a_number, not_a_number}
                    : math::clopper_pearson(count, all, ignition_level);
  };
  return {{"igniting", igniting},
          {"sound", sound},
          {"unsound", unsound},
          {"confidence", ignition_level},
          {"probability_from", report::number(interval(igniting).lower)},
          {"probability_to", report::number(interval(igniting + unsound).upper)}};
}

std::string samples_text(const SensitivityResult& result) {
  Row facts = ignition_json(result);
  if (facts["sound"] == 0 && facts["unsound"] == 0) return {};
  facts["gap"] = centimetres(result.study.study.gaps.front());
  if (const OutputSensitivity* gap = output_of(result, SensitivityOutput::critical_gap)) {
    const OutputSample sample = sample_of(result, *gap);
    for (const auto& [name, share] : {std::pair{"lowest", 0.025}, {"low", 0.05}, {"half", 0.5}})
      if (sample.all_known && !sample.values.empty())
        facts["quantiles"][name] = quantile_text(result, sample.quantile(share));
  }
  return said("sensitivity.samples", facts).front();
}

Table quantile_table(const SensitivityResult& result) {
  const OutputSensitivity* gap = output_of(result, SensitivityOutput::critical_gap);
  const OutputSensitivity* temperature = output_of(result, SensitivityOutput::maximum_temperature);
  std::vector<QuantileRow> rows;
  for (const double share : quantile_shares) {
    if (gap == nullptr || temperature == nullptr) continue;
    const double critical = sample_of(result, *gap).quantile(share);
    rows.push_back(
        {share, critical, quantile_text(result, critical), sample_of(result, *temperature).quantile(share)});
  }
  std::vector<std::string> notes = said("sensitivity.draws", {{"is_fit", is_by_fit(result.study.study)}});
  if (!rows.empty())
    notes.insert(notes.begin(), {sample_note(result, *gap), sample_note(result, *temperature)});
  return table_of("Quantiles over the draws from the inputs", quantile_quantities, rows, notes);
}

Table histogram_table(const SensitivityResult& result) {
  std::vector<HistogramRow> rows;
  for (const OutputSensitivity* output : told_outputs(result)) {
    const ShownOutput& shown = shown_output(output->output);
    const OutputSample sample = sample_of(result, *output);
    const auto without_number = [&](std::size_t count, std::string text) {
      if (count > 0)
        rows.push_back(
            {&shown, not_a_number, not_a_number, std::move(text), static_cast<std::int64_t>(count)});
    };
    without_number(sample.ignites_at_zero(), quantile_text(result, -infinite));
    const Histogram histogram = histogram_of(sample, shown);
    for (std::size_t i = 0; i < histogram.counts.size(); ++i)
      rows.push_back({&shown, histogram.edge(i), histogram.edge(i + 1), {}, histogram.counts[i]});
    without_number(sample.none_ignites(), quantile_text(result, infinite));
    without_number(sample.missing, "not known");
  }
  return table_of("Histogram of the draws", histogram_quantities, rows);
}

Plot histogram_plot(const SensitivityResult& result) {
  const Row ignition = ignition_json(result);
  // That of T max is in histogram.csv; it is drawn where the critical gap has none.
  for (const OutputSensitivity* output : told_outputs(result)) {
    Plot plot = plot_of(result, *output);
    if (plot.series.empty()) continue;
    plot.title += fmt::format("; at {} {} of {} draws ignite", centimetres(result.study.study.gaps.front()),
                              ignition["igniting"].get<std::size_t>(), ignition["sound"].get<std::size_t>());
    plot.title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title.front())));
    return plot;
  }
  return {};
}

}  // namespace launchsafe::kinds

#include "launchsafe/study/surrogate.hpp"

#include "launchsafe/study/record_reader.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {
namespace {

using Kind = math::Distribution::Kind;

// --- The record as JSON, read with distrust. ---

constexpr RecordFormat surrogate_format{
    "launchsafe surrogate 3", "surrogate.json",
    "a study of kind sensitivity with method = \"polynomial-chaos\", or a sweep with surrogate = true"};
constexpr std::size_t most_inputs = 100, most_launches = 10000, most_terms = 5000;
const scene::Limits any_number = scene::between(-1e30, 1e30);
const std::vector<std::string> kinds{"uniform", "log-uniform", "normal", "log-normal"};

/// Infinite ends are null.
void describe_end(RecordObject& object, const char* key, double& end, double without) {
  double number = std::isfinite(end) ? end : math::not_a_number;
  object.value(key, number, OrNone{any_number});
  end = std::isnan(number) ? without : number;
}

/// One input: its key and its distribution.
struct Input {
  std::string key;
  math::Distribution distribution;
};

void describe_input(RecordObject& object, Input& input) {
  math::Distribution& distribution = input.distribution;
  object.value("key", input.key);
  std::string kind = kinds[static_cast<std::size_t>(distribution.kind)];
  object.value("distribution", kind);
  const auto found = std::ranges::find(kinds, kind);
  if (found != kinds.end()) distribution.kind = static_cast<math::Distribution::Kind>(found - kinds.begin());
  describe_end(object, "lower", distribution.lower, -math::infinity);
  describe_end(object, "upper", distribution.upper, math::infinity);
  object.value("centre", distribution.centre, OrNone{any_number});
  object.value("deviation", distribution.deviation, OrNone{any_number});
  if (!object.reading()) return;
  if (found == kinds.end()) object.refuse("distribution", study::quoted(kind), scene::quoted_list(kinds));
  if (!math::is_valid(distribution))
    object.refuse("distribution", "numbers that make no " + kind + " distribution", "those of the study");
}

void describe_inputs(RecordObject& object, SurrogateRecord& record) {
  std::vector<Input> inputs;
  for (std::size_t i = 0; i < record.keys.size(); ++i)
    inputs.push_back({record.keys[i], record.inputs.distributions[i]});
  object.list("inputs", inputs, 1, most_inputs, "an array of 1 to 100 inputs", describe_input);
  record.keys.clear();
  record.inputs.distributions.clear();
  for (Input& each : inputs) {
    record.keys.push_back(std::move(each.key));
    record.inputs.distributions.push_back(each.distribution);
  }
}

/// Those that vary together; none of them is a count of 0.
void describe_correlated(RecordObject& object, SurrogateRecord& record) {
  CorrelatedInputs together = record.inputs.correlated.value_or(CorrelatedInputs{});
  int first = static_cast<int>(together.first), count = static_cast<int>(together.count);
  const int inputs = static_cast<int>(record.keys.size());
  object.value("first", first, 0, inputs);
  object.value("count", count, 0, inputs - first);
  const std::size_t entries = static_cast<std::size_t>(count) * static_cast<std::size_t>(count);
  object.value("covariance_factor", together.factor, any_number, entries, entries);
  if (!object.reading() || count == 0) return;
  together.first = static_cast<std::size_t>(first);
  together.count = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < together.count; ++i)
    if (!(together.factor[i * together.count + i] > 0.0) ||
        record.inputs.distributions[together.first + i].kind != math::Distribution::Kind::log_normal)
      object.refuse("covariance_factor", "no factor of log-normal inputs", "that of the study");
  record.inputs.correlated = std::move(together);
}

/// Of all coordinates, or none.
void describe_correlation(RecordObject& object, SurrogateRecord& record) {
  std::vector<double>& correlation = record.inputs.correlation;
  const std::size_t inputs = record.keys.size();
  object.value("correlation", correlation, scene::between(-1, 1), 0, inputs * inputs);
  if (!object.reading() || correlation.empty()) return;
  bool possible =
      correlation.size() == inputs * inputs && math::covariance_factor(correlation, inputs).has_value();
  for (std::size_t i = 0; possible && i < inputs; ++i) possible = correlation[i * inputs + i] == 1.0;
  if (!possible) object.refuse("correlation", "no matrix of correlations", "that of the study");
}

void describe_term(RecordObject& object, math::ChaosTerm& term, std::size_t inputs, int degree) {
  std::vector<double> degrees(term.degrees.begin(), term.degrees.end());
  object.value("degrees", degrees, scene::between(0, degree), inputs, inputs);
  term.degrees.assign(degrees.begin(), degrees.end());
  object.value("coefficient", term.coefficient, any_number);
}

void describe_chaos(RecordObject& object, math::PolynomialChaos& chaos, std::size_t inputs) {
  object.value("degree", chaos.degree, 0, math::highest_chaos_degree);
  object.value("leave_one_out", chaos.leave_one_out, OrNone{any_number});
  object.list(
      "terms", chaos.terms, 0, most_terms, "terms of a polynomial",
      [&](RecordObject& own, math::ChaosTerm& term) { describe_term(own, term, inputs, chaos.degree); });
}

/// Without a reason there is one.
void describe_process(RecordObject& object, math::GaussianProcess& process, std::size_t inputs) {
  object.value("reason", process.reason);
  object.value("lengths", process.lengths, scene::between(1e-6, 1e6), process.reason.empty() ? inputs : 0,
               inputs);
  object.value("nugget", process.nugget, scene::between(process.reason.empty() ? 1e-9 : 0.0, 1));
  object.value("leave_one_out", process.leave_one_out, OrNone{any_number});
}

void describe_output(RecordObject& object, SurrogateOutput& output, const SurrogateRecord& record) {
  const std::size_t inputs = record.keys.size();
  object.value("name", output.name);
  object.value("gap_m", output.gap, scene::between(0, 0.01));
  object.value("inert", output.inert);
  object.value("reason", output.reason);
  const std::size_t launches = record.points.size() / inputs;
  object.value("values", output.values, OrNone{any_number}, launches, launches);
  auto& [chaos, process] = output.fit;
  chaos.inputs = process.inputs = record.inputs.bases();
  object.part("polynomial", chaos,
              [&](RecordObject& own, math::PolynomialChaos& part) { describe_chaos(own, part, inputs); });
  object.part("process", process,
              [&](RecordObject& own, math::GaussianProcess& part) { describe_process(own, part, inputs); });
  if (!object.reading() || !output.reason.empty()) return;
  const auto rows = record.fitted_rows(output.values);
  const std::size_t known = math::finite_rows(inputs, rows.points, rows.values).values.size();
  const bool enough =
      output.fit.by_process() ? known > inputs + 1 : known > chaos.terms.size() && !chaos.terms.empty();
  const auto tell =
      std::ranges::count_if(record.held_out, [&](auto row) { return std::isfinite(output.values[row]); });
  if (!enough || static_cast<std::size_t>(tell) < fewest_held_out)
    object.refuse("values", "too few numbers for its fit and the error of that", "those of the study");
}

/// As numbers, of launches that there are.
void describe_held_out(RecordObject& object, SurrogateRecord& record) {
  const std::size_t launches = record.points.size() / std::max<std::size_t>(record.keys.size(), 1);
  std::vector<double> rows(record.held_out.begin(), record.held_out.end());
  object.value("held_out", rows,
               scene::between(0, static_cast<double>(std::max<std::size_t>(launches, 1) - 1)), 0, launches);
  record.held_out.clear();
  for (const double row : rows) record.held_out.push_back(static_cast<std::size_t>(row));
  if (object.reading() &&
      std::ranges::adjacent_find(record.held_out, std::greater_equal{}) != record.held_out.end())
    object.refuse("held_out", "launches out of their order", "each once, ascending");
}

/// Whole rows of the cube, whose normal inputs are no end of it.
void check_points(RecordObject& object, const SurrogateRecord& record) {
  if (!object.reading()) return;
  const std::vector<math::ChaosBasis> bases = record.inputs.bases();
  bool possible = record.points.size() % bases.size() == 0;
  for (std::size_t i = 0; i < record.points.size(); ++i)
    possible = possible && (bases[i % bases.size()] == math::ChaosBasis::legendre ||
                            (record.points[i] > 0.0 && record.points[i] < 1.0));
  if (!possible) object.refuse("points", "points that are none of the unit cube", "one for every launch");
}

void describe_surrogate(RecordObject& object, SurrogateRecord& record) {
  object.model_version("run the study anew");
  object.scene(record.scene, "the scene of the study");
  object.value("gap_m", record.gap, scene::between(0, 0.01));
  describe_inputs(object, record);
  object.part("correlated", record, describe_correlated);
  describe_correlation(object, record);
  object.value("drawn", record.drawn);
  const std::size_t inputs = record.keys.size();
  object.value("points", record.points, scene::between(0.0, 1.0), inputs, inputs * most_launches);
  check_points(object, record);
  describe_held_out(object, record);
  object.list("outputs", record.outputs, 0, 100, "an array of at most 100 outputs",
              [&](RecordObject& own, SurrogateOutput& output) { describe_output(own, output, record); });
}

// ---

const math::Distribution& standard_normal() {
  static const auto normal = math::Distribution::normal(0.0, 1.0);
  return normal;
}

/// The launches that were fitted and have a number, by what was chosen.
std::variant<math::FittedChaos, math::FittedProcess> fitted(const SurrogateRecord& record,
                                                            const SurrogateOutput& output) {
  const math::FiniteRows all = record.fitted_rows(output.values);
  const math::FiniteRows rows = math::finite_rows(record.keys.size(), all.points, all.values);
  if (output.fit.by_process()) return math::FittedProcess(output.fit.process, rows.points, rows.values);
  return math::FittedChaos(output.fit.chaos, rows.points);
}

}  // namespace

std::vector<double> UncertainInputs::values_at(const std::vector<double>& point) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < distributions.size(); ++i)
    values.push_back(math::quantile(distributions[i], point[i]));
  if (!correlated) return values;
  for (std::size_t i = 0; i < correlated->count; ++i) {
    double logarithm = 0.0;
    for (std::size_t j = 0; j <= i; ++j)
      logarithm += correlated->factor[i * correlated->count + j] *
                   math::quantile(standard_normal(), point[correlated->first + j]);
    values[correlated->first + i] = distributions[correlated->first + i].centre * std::exp(logarithm);
  }
  return values;
}

std::vector<double> UncertainInputs::point_of(const std::vector<double>& values) const {
  std::vector<double> point;
  for (std::size_t i = 0; i < distributions.size(); ++i)
    point.push_back(math::cumulative(distributions[i], values[i]));
  if (!correlated) return point;
  // The factor is triangular.
  std::vector<double> normal;
  for (std::size_t i = 0; i < correlated->count; ++i) {
    const std::size_t input = correlated->first + i;
    double rest = std::log(values[input] / distributions[input].centre);
    for (std::size_t j = 0; j < i; ++j) rest -= correlated->factor[i * correlated->count + j] * normal[j];
    normal.push_back(rest / correlated->factor[i * correlated->count + i]);
    point[input] = math::cumulative(standard_normal(), normal.back());
  }
  return point;
}

std::vector<math::ChaosBasis> UncertainInputs::bases() const {
  return of_each(distributions, [](const math::Distribution& each) {
    const bool is_normal = each.kind == Kind::normal || each.kind == Kind::log_normal;
    return is_normal ? math::ChaosBasis::hermite : math::ChaosBasis::legendre;
  });
}

math::FiniteRows SurrogateRecord::fitted_rows(const std::vector<double>& values) const {
  math::FiniteRows rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::ranges::binary_search(held_out, row)) continue;
    const auto point = math::point_of_row(points, row, keys.size());
    rows.points.insert(rows.points.end(), point.begin(), point.end());
    rows.values.push_back(values[row]);
  }
  return rows;
}

const SurrogateOutput* SurrogateRecord::predicted(const std::string& name) const {
  const auto found = std::ranges::find(outputs, name, &SurrogateOutput::name);
  return found == outputs.end() || !found->reason.empty() ? nullptr : &*found;
}

void fit_output(const SurrogateRecord& record, SurrogateOutput& output) {
  constexpr double most_unexplained = 0.1;
  const math::FiniteRows rows = record.fitted_rows(output.values);
  output.fit = {math::fit_chaos(record.inputs.bases(), rows.points, rows.values),
                math::fit_process(record.inputs.bases(), rows.points, rows.values)};
  output.error = {};
  output.reason = output.fit.chaos.reason;
  if (!output.reason.empty()) return;
  const std::vector<double> misses = Surrogate(record, output).misses();
  HeldOutError& error = output.error;
  error.launches = misses.size();
  if (error.launches < fewest_held_out) {
    output.reason =
        fmt::format("only {} evaluations that were not fitted have a number, at least {} are needed",
                    error.launches, fewest_held_out);
    return;
  }
  const math::FiniteRows known = math::finite_rows(record.keys.size(), rows.points, rows.values);
  const double mean_square = math::sum_of_squares(misses) / static_cast<double>(misses.size());
  error.root_mean_square = std::sqrt(mean_square);
  error.largest = std::ranges::max(misses);
  error.unexplained =
      mean_square * static_cast<double>(known.values.size()) / math::moments_of(known.values).squares;
  if (!(error.unexplained <= most_unexplained))
    output.reason = fmt::format("the fit misses {:.2g} % of the variance at evaluations that it has not seen",
                                100.0 * error.unexplained);
}

Surrogate::Surrogate(const SurrogateRecord& record, const SurrogateOutput& output)
    : fit_(fitted(record, output)) {
  constexpr double share = 0.99, confidence = 0.95;
  double sum = 0.0, largest = 0.0;
  for (const std::size_t row : record.held_out) {
    if (!std::isfinite(output.values[row])) continue;
    const auto [value, leverage] = fitted_at(math::point_of_row(record.points, row, record.keys.size()));
    misses_.push_back(std::abs(value - output.values[row]));
    const double miss = misses_.back() / std::sqrt(1.0 + leverage);
    sum += miss;
    largest = std::max(largest, miss);
    largest_leverage_ = std::max(largest_leverage_, leverage);
  }
  const int launches = static_cast<int>(misses_.size());
  error_ =
      std::max(largest, math::exponential_tolerance_factor(launches, share, confidence) * sum / launches);
}

math::FitValue Surrogate::fitted_at(const std::vector<double>& point) const {
  return std::visit([&point](const auto& fit) { return fit.at(point); }, fit_);
}

Prediction Surrogate::at(const std::vector<double>& point) const {
  const auto [value, leverage] = fitted_at(point);
  return {value, error_ * std::sqrt(1.0 + leverage), leverage <= largest_leverage_};
}

double Surrogate::largest_error() const { return error_ * std::sqrt(1.0 + largest_leverage_); }

std::string to_json_text(const SurrogateRecord& record) {
  return record_text(content_by(surrogate_format, describe_surrogate, record));
}

scene::Expected<SurrogateRecord> parse_surrogate(const std::string& text, const std::string& file) {
  return parse_record<SurrogateRecord>(text, file, surrogate_format, describe_surrogate);
}

std::vector<double> least_sure_points(SurrogateRecord record, SurrogateOutput output, std::size_t count,
                                      std::uint64_t seed) {
  constexpr std::size_t draws = 512;
  const std::size_t inputs = record.keys.size();
  const std::vector<double> candidates = math::unit_points(math::Design::monte_carlo, draws, inputs, seed);
  const math::CopulaDraws drawn = record.inputs.draws();
  std::vector<double> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    const Surrogate surrogate(record, output);
    std::vector<double> worst;
    Prediction there{0.0, -1.0};
    for (std::size_t row = 0; row < draws; ++row) {
      const auto point = drawn.at(math::point_of_row(candidates, row, inputs));
      const Prediction prediction = surrogate.at(point);
      if (prediction.error <= there.error) continue;
      there = prediction;
      worst = point;
    }
    for (std::vector<double>* points : {&chosen, &record.points})
      points->insert(points->end(), worst.begin(), worst.end());
    output.values.push_back(there.value);
  }
  return chosen;
}

std::vector<math::Interval> ranges_of(const SurrogateRecord& record) {
  const std::size_t inputs = record.keys.size();
  std::vector<math::Interval> ranges(inputs, {math::infinity, -math::infinity});
  for (std::size_t row = 0; row < record.points.size() / inputs; ++row) {
    if (std::ranges::binary_search(record.held_out, row)) continue;
    const auto values = record.inputs.values_at(math::point_of_row(record.points, row, inputs));
    for (std::size_t i = 0; i < inputs; ++i)
      ranges[i] = {std::min(ranges[i].lower, values[i]), std::max(ranges[i].upper, values[i])};
  }
  const std::vector<math::ChaosBasis> bases = record.inputs.bases();
  for (std::size_t i = 0; i < inputs; ++i)
    if (bases[i] == math::ChaosBasis::legendre)
      ranges[i] = {record.inputs.distributions[i].lower, record.inputs.distributions[i].upper};
  return ranges;
}

PredictedIgnitions ignitions_of(const std::vector<Prediction>& critical_gaps, double gap) {
  PredictedIgnitions ignitions{.draws = critical_gaps.size()};
  for (const Prediction& each : critical_gaps) {
    const long long above = nanometres(gap) - nanometres(each.value), error = nanometres(each.error);
    ignitions.at_least += each.covered && above >= error;
    ignitions.predicted += above >= 0;
    ignitions.at_most += !each.covered || above >= -error;
    ignitions.uncovered += !each.covered;
  }
  return ignitions;
}

std::vector<Prediction> drawn_critical_gaps(const SurrogateRecord& record,
                                            const std::vector<std::optional<double>>& fixed) {
  constexpr std::size_t draws = 4096;
  constexpr std::uint64_t seed = 1;
  const Surrogate critical_gap(record, *record.predicted("critical_gap"));
  const std::size_t inputs = record.keys.size();
  const std::vector<double> points = math::unit_points(math::Design::scrambled_sobol, draws, inputs, seed);
  const math::CopulaDraws drawn = fixed.empty() ? record.inputs.draws() : record.inputs.draws(fixed);
  std::vector<Prediction> critical_gaps;
  for (std::size_t row = 0; row < draws; ++row)
    critical_gaps.push_back(critical_gap.at(drawn.at(math::point_of_row(points, row, inputs))));
  return critical_gaps;
}

}  // namespace launchsafe::study

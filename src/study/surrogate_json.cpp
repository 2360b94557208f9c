// The record of a surrogate as JSON, read with distrust.
#include "launchsafe/study/record_reader.hpp"
#include "launchsafe/study/surrogate.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

constexpr RecordFormat surrogate_format{
    "launchsafe surrogate 2", "surrogate.json",
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
  if (!object.reading() || object.reader().fault()) return;
  if (found == kinds.end())
    object.reader().refuse(object.path_of("distribution"), study::quoted(kind), scene::quoted_list(kinds));
  else if (!math::is_valid(distribution))
    object.reader().refuse(object.path_of("distribution"), "numbers that make no " + kind + " distribution",
                           "those of the study");
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
  if (!object.reading() || object.reader().fault() || count == 0) return;
  together.first = static_cast<std::size_t>(first);
  together.count = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < together.count; ++i)
    if (!(together.factor[i * together.count + i] > 0.0) ||
        record.inputs.distributions[together.first + i].kind != math::Distribution::Kind::log_normal)
      object.reader().refuse(object.path_of("covariance_factor"), "no factor of log-normal inputs",
                             "that of the study");
  record.inputs.correlated = std::move(together);
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
  object.numbers("values", output.values, record.points.size() / inputs, "a value for every launch",
                 any_number);
  auto& [chaos, process] = output.fit;
  chaos.inputs = process.inputs = record.inputs.bases();
  object.part("polynomial", chaos,
              [&](RecordObject& own, math::PolynomialChaos& part) { describe_chaos(own, part, inputs); });
  object.part("process", process,
              [&](RecordObject& own, math::GaussianProcess& part) { describe_process(own, part, inputs); });
  if (!object.reading() || object.reader().fault() || !output.reason.empty()) return;
  const auto rows = record.fitted_rows(output.values);
  const std::size_t known = math::finite_rows(inputs, rows.points, rows.values).values.size();
  const bool enough =
      output.fit.by_process() ? known > inputs + 1 : known > chaos.terms.size() && !chaos.terms.empty();
  if (!enough || std::ranges::none_of(record.held_out,
                                      [&](std::size_t row) { return std::isfinite(output.values[row]); }))
    object.reader().refuse(object.path_of("values"), "too few numbers for its fit and the error of that",
                           "those of the study");
}

/// As numbers, of launches that there are.
void describe_held_out(RecordObject& object, SurrogateRecord& record) {
  const std::size_t launches = record.points.size() / std::max<std::size_t>(record.keys.size(), 1);
  std::vector<double> rows(record.held_out.begin(), record.held_out.end());
  object.value("held_out", rows,
               scene::between(0, static_cast<double>(std::max<std::size_t>(launches, 1) - 1)), 0, launches);
  record.held_out.clear();
  for (const double row : rows) record.held_out.push_back(static_cast<std::size_t>(row));
  if (object.reading() && !object.reader().fault() &&
      std::ranges::adjacent_find(record.held_out, std::greater_equal{}) != record.held_out.end())
    object.reader().refuse("held_out", "launches out of their order", "each once, ascending");
}

/// Whole rows of the cube, whose normal inputs are no end of it.
void check_points(RecordObject& object, const SurrogateRecord& record) {
  if (!object.reading() || object.reader().fault()) return;
  const std::vector<math::ChaosBasis> bases = record.inputs.bases();
  bool possible = record.points.size() % bases.size() == 0;
  for (std::size_t i = 0; i < record.points.size(); ++i)
    possible = possible && (bases[i % bases.size()] == math::ChaosBasis::legendre ||
                            (record.points[i] > 0.0 && record.points[i] < 1.0));
  if (!possible)
    object.reader().refuse("points", "points that are none of the unit cube", "one for every launch");
}

void describe_surrogate(RecordObject& object, SurrogateRecord& record) {
  object.model_version("run the study anew");
  object.scene(record.scene, "the scene of the study");
  object.value("gap_m", record.gap, scene::between(0, 0.01));
  describe_inputs(object, record);
  if (object.reading() && object.reader().fault()) return;
  object.part("correlated", record, describe_correlated);
  object.value("drawn", record.drawn);
  const std::size_t inputs = record.keys.size();
  object.value("points", record.points, scene::between(0.0, 1.0), inputs, inputs * most_launches);
  check_points(object, record);
  if (object.reading() && object.reader().fault()) return;
  describe_held_out(object, record);
  if (object.reading() && object.reader().fault()) return;
  object.list("outputs", record.outputs, 0, 100, "an array of at most 100 outputs",
              [&](RecordObject& own, SurrogateOutput& output) { describe_output(own, output, record); });
}

}  // namespace

std::string to_json_text(const SurrogateRecord& record) {
  return record_text(content_by(surrogate_format, describe_surrogate, record));
}

scene::Expected<SurrogateRecord> parse_surrogate(const std::string& text, const std::string& file) {
  return parse_record<SurrogateRecord>(text, file, surrogate_format, describe_surrogate);
}

}  // namespace launchsafe::study

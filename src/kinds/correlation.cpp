// [[correlation]]: inputs that vary together as the study file states it. Their normal scores are correlated,
// a Gaussian copula, and each keeps its own distribution.
#include "launchsafe/kinds/sensitivity.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

namespace {

constexpr const char* correlation_table_name = "correlation";

struct CorrelationText {
  std::string between;  ///< "load.peak, initial_temperature"
  double coefficient = 0;
};

const std::vector<Key<CorrelationText>> correlation_keys{
    text_key("between", Standing::input,
             "Keys of two inputs that vary together, for indices one input; each keeps its distribution.",
             R"("load.peak", "initial_temperature")", &CorrelationText::between) |
        [](KeyDescription& key) { key.list_length = 2; } | required(),
    number_key("coefficient", Dimension::number,
               {.lowest = -1, .highest = 1, .lowest_allowed = false, .highest_allowed = false},
               Standing::input, "Correlation of their normal scores: a Gaussian copula.",
               &CorrelationText::coefficient) |
        required()};

/// The key of the study file by which places and faults of an entry are kept.
std::string study_key(std::size_t entry, const std::string& key) {
  return fmt::format("{}.{}.{}", correlation_table_name, entry, key);
}

/// What is stated of two axes.
double& stated_of(Study& study, std::size_t one, std::size_t other) {
  return settings_of<SensitivitySettings>(study).correlation[one * study.axes.size() + other];
}

/// The axis of that key, by its short or full name; the fault is that of an entry.
std::size_t axis_named(const StudyFile& study, const std::string& name, std::size_t entry) {
  const auto& axes = study.study.axes;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name == name || axes[i].key.name == name) return i;
  const auto names = of_each(axes, [](const Axis& axis) { return axis.key.name; });
  refuse_at(study, study_key(entry, "between"), fmt::format("\"{}\", which the study does not sample", name),
            "keys of [[vary]]: " + scene::quoted_list(names), scene::nearest_of(name, names));
}

void read_entry(StudyFile& study, const toml::table& table, std::size_t entry) {
  CorrelationText text;
  for (const auto& [key, place] :
       taken(scene::read_table(table, correlation_keys, {}, study.file, text), correlation_table_name))
    study.places[study_key(entry, key)] = place;
  const std::size_t comma = text.between.find(", ");
  const std::size_t one = axis_named(study, text.between.substr(0, comma), entry),
                    other = axis_named(study, text.between.substr(comma + 2), entry);
  auto& own = settings_of<SensitivitySettings>(study.study);
  StatedCorrelation stated{study.study.axes[one].key.name, study.study.axes[other].key.name,
                           text.coefficient};
  const auto refuse = [&](const std::string& found, const char* allowed) {
    refuse_at(study, study_key(entry, "between"), found, allowed);
  };
  if (one == other) refuse(stated.one + " twice", "two inputs");
  const std::string both = stated.one + " and " + stated.other;
  for (const StatedCorrelation& each : own.stated)
    if (std::minmax(each.one, each.other) == std::minmax(stated.one, stated.other))
      refuse(both + " a second time", "each pair once");
  if (own.correlated && own.correlated->has(one) && own.correlated->has(other))
    refuse(both + ", whose correlation the record of the calibration has",
           "pairs of which one at the most is a constant of that record");
  stated_of(study.study, one, other) = stated_of(study.study, other, one) = text.coefficient;
  study.scene.notes.push_back(
      fmt::format("{} vary together, with a coefficient of {:g}", both, text.coefficient));
  own.stated.push_back(std::move(stated));
}

/// Brings axes that vary together, directly or through others, next to each other.
void order_axes(Study& study) {
  auto& own = settings_of<SensitivitySettings>(study);
  const std::size_t axes = study.axes.size();
  std::vector<std::size_t> order;
  const auto add_new = [&](std::size_t axis) {
    if (std::ranges::find(order, axis) == order.end()) order.push_back(axis);
  };
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::size_t begin = order.size();
    add_new(axis);
    for (std::size_t k = begin; k < order.size(); ++k)
      for (std::size_t other = 0; other < axes; ++other)
        if (own.vary_together(order[k], other, axes)) add_new(other);
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end());
  }
  std::vector<double> correlation;
  for (const std::size_t i : order)
    for (const std::size_t j : order) correlation.push_back(stated_of(study, i, j));
  own.correlation = std::move(correlation);
  study.axes = of_each(order, [&](std::size_t axis) { return study.axes[axis]; });
  if (auto& recorded = own.correlated)
    recorded->first = static_cast<std::size_t>(std::ranges::find(order, recorded->first) - order.begin());
}

/// From scores of inputs to those of coordinates, which make the constants of a record by its factor and are
/// independent of each other.
void take_coordinates(Study& study) {
  const auto& recorded = settings_of<SensitivitySettings>(study).correlated;
  if (!recorded) return;
  const auto& [first, count, factor] = *recorded;
  for (std::size_t other = 0; other < study.axes.size(); ++other)
    for (std::size_t i = 0; i < count && !recorded->has(other); ++i) {
      double rest = stated_of(study, other, first + i) * study.axes[first + i].distribution->deviation;
      for (std::size_t j = 0; j < i; ++j) rest -= factor[i * count + j] * stated_of(study, other, first + j);
      stated_of(study, first + i, other) = stated_of(study, other, first + i) = rest / factor[i * count + i];
    }
}

/// Refuses correlations that no draws can have, at the last entry about them; and inputs of which one follows
/// from the others but for a tenth of its deviation: launches do not tell a fit apart what each of them does,
/// and off their line it would be wrong by more than it says.
void check_matrix(StudyFile& study) {
  constexpr double least = 0.01;  // two inputs have it with a coefficient of 0.99
  for (const SensitivityInput& input : inputs_of(study.study)) {
    std::vector<double> part;
    std::vector<std::string> names;
    for (std::size_t i = input.first; i < input.first + input.count; ++i) {
      names.push_back(study.study.axes[i].key.name);
      for (std::size_t j = input.first; j < input.first + input.count; ++j)
        part.push_back(stated_of(study.study, i, j));
    }
    const double eigenvalue = math::smallest_eigenvalue(part, input.count);
    if (eigenvalue >= least * (1.0 - 1e-9)) continue;
    const auto& stated = settings_of<SensitivitySettings>(study).stated;
    std::size_t entry = stated.size() - 1;
    while (std::ranges::find(names, stated[entry].one) == names.end()) --entry;
    refuse_at(
        study, study_key(entry, "coefficient"),
        fmt::format("correlations of {} that contradict each other, or leave next to nothing of an input "
                    "to itself: the smallest eigenvalue of their matrix is {:.2g}",
                    fmt::join(names, ", "), eigenvalue),
        fmt::format("a smallest eigenvalue of at least {0:g} (of two inputs: a coefficient from -{1:g} to "
                    "{1:g}): coefficients nearer to 0, or one input in place of those that follow from "
                    "each other; what is not stated is 0",
                    least, 1.0 - least));
  }
}

}  // namespace

StudyTable correlation_table() { return study_table_of(correlation_table_name, correlation_keys); }

void read_correlations(const StudySource& source, StudyFile& study) {
  const auto tables = study::tables_of(source.root, correlation_table_name, study, {});
  if (tables.empty()) return;
  const std::size_t axes = study.study.axes.size();
  settings_of<SensitivitySettings>(study.study).correlation.assign(axes * axes, 0.0);
  for (std::size_t i = 0; i < axes; ++i) stated_of(study.study, i, i) = 1.0;
  for (std::size_t entry = 0; entry < tables.size(); ++entry) read_entry(study, *tables[entry], entry);
  order_axes(study.study);
  take_coordinates(study.study);
  check_matrix(study);
}

}  // namespace launchsafe::kinds

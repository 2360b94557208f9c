// The scene keys that a study varies, what is wrong with a study and where, and the limits that it cites.
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {
namespace {

using scene::InputError, scene::KeyDescription, scene::KeyKind, scene::Place;

using Tables = std::vector<const toml::table*>;

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The fault of a name that no scene key and no short name has, or of a scene key that takes no number.
InputError unfit_key(const StudyFile& study, const std::string& name, const std::string& faulty_key,
                     const Place& place, const std::vector<std::string>& short_names) {
  if (const auto any = scene::describe_key(study.scene, name, place)) {
    constexpr std::array takes{"a number", "true or false", "a word", "words", "a text", "a list", "a range"};
    return scene::error_at(
        place, faulty_key,
        fmt::format("{}, which takes {}", name, takes.at(static_cast<std::size_t>(any->kind))),
        "a scene key that takes one number, or " + joined(short_names));
  }
  std::vector<std::string> known = short_names;
  for (const auto& key : scene::scene_keys()) {
    if (key.kind == KeyKind::number) known.push_back(key.name);
  }
  const InputError unknown = scene::unknown_key(place, name, known);
  const std::string allowed =
      unknown.allowed.starts_with("in [")
          ? unknown.allowed
          : joined(short_names) + ", or a scene key that takes one number, such as load.steepness";
  return scene::error_at(place, faulty_key, fmt::format("the unknown key \"{}\"", name), allowed,
                         unknown.suggestion);
}

/// The peak matters under a measured curve that is rescaled to it; the other numbers of the analytic shape
/// never do.
void check_load_axis(const StudyFile& study, const std::string& key, const std::string& scene_key) {
  const auto* known = scene::find_key(scene::scene_keys(), scene_key);
  if (known == nullptr || !known->is_replaced || !known->is_replaced(study.scene.scene)) return;
  if (scene_key == "load.peak")
    refuse_at(study, key, "peak pressures for a measured curve that is not rescaled",
              "peak pressures with load.rescale_to_peak = true in the scene");
  refuse_at(study, key, scene_key + ", which a measured curve does not have",
            "a scene without a measured curve, or a key that has an effect");
}

/// Of so many cases those whose peak pressure is nearest to one (Pa): the ones that have the defect of the
/// study's scene, or all where none has.
std::vector<std::size_t> nearest_cases(const StudyFile& study, std::size_t count, double peak_pressure) {
  const materials::ViscoScramParameters& own = study.scene.scene.charge().strength;
  std::vector<std::size_t> nearest, of_own_defect;
  double least = math::infinity;
  for (std::size_t i = 0; i < count; ++i) {
    const StudyCase each = study.cases[i];
    const double distance = std::abs(each.peak_pressure - peak_pressure), slack = 1e-9 * peak_pressure;
    if (distance > least + slack) continue;
    if (distance < least - slack) nearest = of_own_defect = {};
    least = std::min(least, distance);
    nearest.push_back(i);
    if (each.has_defect(own)) of_own_defect.push_back(i);
  }
  return of_own_defect.empty() ? nearest : of_own_defect;
}

LimitComparison compare(const StudyFile& study, const std::vector<const CriticalGap*>& critical,
                        const CitedLimit& limit) {
  LimitComparison comparison;
  comparison.limit = limit;
  const double pressure = std::isnan(limit.peak_pressure)
                              ? scene::PressureHistory(study.scene.scene.load).stated_peak()
                              : limit.peak_pressure;
  const std::size_t count = std::min(study.cases.size(), critical.size());
  const std::vector<std::size_t> cases = nearest_cases(study, count, pressure);
  comparison.cases = cases.size();
  if (cases.empty()) return comparison;
  // In the order of the smallest that the critical gap may be.
  const auto smallest = [&](std::size_t i) {
    const GapOrBound gap = gap_or_bound(*critical[i]);
    return std::isnan(gap) ? -1.0 : gap;
  };
  const std::size_t nearest = *std::ranges::min_element(cases, {}, smallest);
  comparison.nearest = nearest;
  const double off = std::abs(study.cases[nearest].peak_pressure - pressure);
  if (critical[nearest]->kind == CriticalGapKind::value && off <= pressure_slack * pressure)
    comparison.difference = critical[nearest]->value - limit.gap;
  return comparison;
}

}  // namespace

Tables tables_of(const toml::table& root, const std::string& name, const StudyFile& study,
                 const std::string& needed) {
  const std::string allowed = needed.empty()
                                  ? fmt::format("tables, each written [[{}]]", name)
                                  : fmt::format("at least one table, written [[{}]], {}", name, needed);
  Tables tables = scene::tables_of(root, name, study.file, allowed).or_throw();
  if (tables.empty() && !needed.empty())
    throw scene::error_at(place_of_key(study, root.contains(name) ? name : "kind"), name, "no " + name,
                          allowed);
  return tables;
}

std::string read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                            const std::string& key, const std::string& name, const std::string& wanted) {
  auto text = scene::read_text_file(scene::named_file(folder, name, place_of_key(study, key), key, wanted));
  if (text) return std::move(*text);
  refuse_at(study, key, fmt::format("\"{}\", {}", name, text.error().found),
            wanted + ", by its path from this file's folder");
}

std::vector<Leaf> leaves_as_written(const toml::table& table) {
  std::vector<Leaf> leaves = scene::leaves_as_written(table, {});
  std::erase_if(leaves, [](const Leaf& leaf) { return leaf.node->is_table(); });
  return leaves;
}

std::string name_of_axis(const std::string& scene_key) {
  const auto named = std::ranges::find(named_axes(), scene_key, &NamedAxis::key);
  return named == named_axes().end() ? scene_key : named->name;
}

const std::vector<NamedAxis>& named_axes() {
  static const std::vector<NamedAxis> axes{{"peak_pressure", "load.peak"},
                                           {"crack_radius", "charge.crack_radius"},
                                           {"flaw_size", "charge.flaw_size"}};
  return axes;
}

KeyDescription varied_key(const StudyFile& study, const std::string& name, const std::string& faulty_key,
                          const Place& place) {
  const auto named = std::ranges::find(named_axes(), name, &NamedAxis::name);
  const std::string& wanted = named == named_axes().end() ? name : named->key;
  auto key = scene::describe_key(study.scene, wanted, place);
  if (key && key->kind == KeyKind::number) return std::move(*key);
  throw unfit_key(study, name, faulty_key, place, of_each(named_axes(), &NamedAxis::name));
}

double number_in(const scene::SceneFile& file, const std::string& key) {
  return std::get<double>(scene::value_in(file, key));
}

std::vector<double> spaced_values(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i + 1 < count; ++i) values.push_back(from + (to - from) / (count - 1) * i);
  values.push_back(to);
  return values;
}

void check_load_axes(const StudyFile& study) {
  for (const Axis& axis : study.study.axes) check_load_axis(study, axis.study_key, axis.key.name);
}

void add_axis(StudyFile& study, const std::string& name, const std::string& study_key,
              std::vector<double> values) {
  if (values.empty()) return;
  KeyDescription key = varied_key(study, name, study_key, place_of_key(study, study_key));
  check_twice(study, study_key, key.dimension, values);
  study.study.axes.push_back({name_of_axis(key.name), study_key, std::move(key), std::move(values)});
}

void check_free(const StudyFile& study, const std::string& scene_key, const Place& place,
                const std::string& faulty_key) {
  if (study.overrides.contains(scene_key))
    throw scene::error_at(place, faulty_key, scene_key + ", which [set] or the calibration fixes",
                          fmt::format("{} either in [[vary]], or in [set] or a calibration", scene_key));
  for (const Axis& other : study.study.axes)
    if (other.key.name == scene_key)
      throw scene::error_at(place, faulty_key,
                            fmt::format("{} a second time, after {}", scene_key, other.name),
                            "each scene key once");
}

void check_twice(const StudyFile& study, const std::string& key, scene::Dimension dimension,
                 std::vector<double> values) {
  std::ranges::sort(values);
  const auto twice = std::adjacent_find(values.begin(), values.end(), [](double a, double b) {
    return b - a <= 1e-9 * std::max(std::abs(b), 1e-6);
  });
  if (twice != values.end())
    refuse_at(study, key, scene::format_quantity(*twice, dimension) + " twice", "each value once");
}

const std::vector<scene::Key<CitedLimit>>& cited_limit_keys() {
  static const std::vector<scene::Key<CitedLimit>> keys{
      scene::number_key("gap", scene::Dimension::length, scene::above(0), scene::Standing::literature,
                        "Largest gap that others allow.", &CitedLimit::gap) |
          scene::required(),
      scene::number_key(
          "peak_pressure", scene::Dimension::pressure, scene::above(0), scene::Standing::literature,
          "Peak pressure that it was found for; absent where none was stated.", &CitedLimit::peak_pressure),
      scene::text_key("source", scene::Standing::literature, "Who found it, and how.",
                      "gun tests of 1998, table 3", &CitedLimit::source) |
          scene::required(),
  };
  return keys;
}

void read_cited_limits(const toml::table& root, StudyFile& study) {
  read_rows(root, "cited_limit", cited_limit_keys(), study.file, study, study.study.cited_limits);
}

std::vector<LimitComparison> compare_with_limits(const StudyFile& study,
                                                 const std::vector<const CriticalGap*>& critical) {
  return of_each(study.study.cited_limits,
                 [&](const CitedLimit& limit) { return compare(study, critical, limit); });
}

}  // namespace launchsafe::study

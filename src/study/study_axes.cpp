// The scene keys that a study varies, and what is wrong with a study and where.
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {
namespace {

using scene::InputError, scene::KeyDescription, scene::KeyKind, scene::Place;

using Tables = std::vector<const toml::table*>;

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The fault of a name that no scene key and no short name has, or of a scene key that takes no number.
InputError unfit_key(const std::string& name, const std::string& faulty_key, const Place& place,
                     std::vector<std::string> known) {
  const std::string allowed =
      joined(known) + ", or a scene key that takes one number, such as load.steepness";
  for (const auto& key : scene::scene_keys())
    if (key.kind == KeyKind::number) known.push_back(key.name);
  return scene::error_at(place, faulty_key, '"' + name + '"', allowed, scene::nearest_of(name, known));
}

/// The peak matters under a measured curve that is rescaled to it; the other numbers of the analytic shape
/// never do.
void check_load_axis(const StudyFile& study, const std::string& key, const std::string& scene_key) {
  const auto* known = scene::find_key(scene::scene_keys(), scene_key);
  if (known == nullptr || !known->is_replaced || !known->is_replaced(study.scene.scene)) return;
  refuse_at(study, key, scene_key + ", which a measured curve does not have",
            "a scene without a measured curve, or a key that has an effect");
}

}  // namespace

Tables tables_of(const toml::table& root, const std::string& name, const StudyFile& study,
                 const std::string& needed) {
  const std::string allowed = needed.empty()
                                  ? fmt::format("tables, each written [[{}]]", name)
                                  : fmt::format("at least one table, written [[{}]], {}", name, needed);
  Tables tables = scene::tables_of(root, name, study.file, allowed);
  if (tables.empty() && !needed.empty())
    throw scene::error_at(place_of_key(study, root.contains(name) ? name : "kind"), name, "no " + name,
                          allowed);
  return tables;
}

std::string read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                            const std::string& key, const std::string& name, const std::string& wanted) {
  const auto file = scene::named_file(folder, name, place_of_key(study, key), key, wanted);
  const auto text = scene::caught([&] { return scene::read_text_file(file); });
  if (text) return *text;
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
                                           {"flaw_size", "charge.flaw_size"},
                                           {"initial_temperature", "initial_temperature"}};
  return axes;
}

KeyDescription varied_key(const StudyFile& study, const std::string& name, const std::string& faulty_key,
                          const Place& place) {
  const auto named = std::ranges::find(named_axes(), name, &NamedAxis::name);
  const std::string& wanted = named == named_axes().end() ? name : named->key;
  auto key = scene::caught([&] { return scene::describe_key(study.scene, wanted, place); });
  if (key && key->kind == KeyKind::number) return std::move(*key);
  throw unfit_key(name, faulty_key, place, of_each(named_axes(), &NamedAxis::name));
}

double number_in(const scene::SceneFile& file, const std::string& key) {
  return std::get<double>(scene::value_in(file, key));
}

void check_load_axes(const StudyFile& study) {
  for (const Axis& axis : study.study.axes) check_load_axis(study, axis.study_key, axis.key.name);
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

}  // namespace launchsafe::study

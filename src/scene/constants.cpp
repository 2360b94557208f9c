#include "launchsafe/scene/constants.hpp"

#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// Faces of the charge by which constants name what holds it.
constexpr const char *front_face = "front", *side_face = "side", *bottom_face = "bottom";
const std::string interface_prefix = "interface.";

/// The face of the charge that a body bears on; empty where it touches no charge.
std::string face_of(const Scene& scene, const Body& body) {
  const double tolerance = length_tolerance(scene);
  for (const Body& charge : scene.bodies) {
    if (!is_charge(scene, charge) || !share_a_face(scene, body, charge)) continue;
    if (std::abs(overlap(body, charge, axis_x)) > tolerance) return side_face;
    return body.x_begin > charge.x_begin ? bottom_face : front_face;
  }
  return {};
}

/// The condition and friction of a face among the values of constants; bonded where they say nothing.
Interface interface_at(const Constants& constants, const std::string& face, const std::string& body) {
  Interface faces{.body = body, .from_constants = true};
  for (const Key<Interface>& key : interface_keys())
    if (const Value* value = find_in(constants.values, interface_prefix + face + "." + key.name))
      key.set(faces, *value);
  return faces;
}

/// Keys of the tables [set], by their names there: those of a scene, and of what holds the three faces.
KeyDescription description_of(const std::string& name, const Place& place) {
  if (const Key<Scene>* key = find_key(scene_keys(), name)) return *key;
  for (const char* face : {front_face, side_face, bottom_face})
    for (const Key<Interface>& key : interface_keys())
      if (name == interface_prefix + face + "." + key.name) {
        KeyDescription described = key;
        described.name = name;
        return described;
      }
  throw unknown_key(place, name, names_of(scene_keys()));
}

const std::vector<Key<FittedNumber>>& row_keys() {
  static const std::vector<Key<FittedNumber>> keys{
      text_key("quantity", Standing::input, "Quantity that was published.", "T at 10 ms",
               &FittedNumber::quantity) |
          required(),
      number_key("gap", Dimension::length, at_least(0), Standing::paper, "Gap of the row.",
                 &FittedNumber::gap),
      number_key("published", Dimension::number, any_number(), Standing::paper, "Published number.",
                 &FittedNumber::published),
      number_key("computed", Dimension::number, any_number(), Standing::derived,
                 "Number that the launch with the constants gives.", &FittedNumber::computed),
      text_key("unit", Standing::input, "Unit of both.", "K", &FittedNumber::unit),
      flag_key("fitted", Standing::input, "Whether the fit used it.", &FittedNumber::is_fitted),
  };
  return keys;
}

/// All of a file but its tables and the launch.
const std::vector<Key<Constants>>& header_keys() {
  static const std::vector<Key<Constants>> keys{
      text_key("title", Standing::input, "Title of the calibration.", "", &Constants::title),
      text_key("command", Standing::input, "Command that writes the file anew.", "", &Constants::command),
      number_key("model_version", Dimension::count, at_least(0), Standing::input,
                 "Version of the model that was fitted.", &Constants::model_version) |
          required(),
      number_key("ignition_lowest", Dimension::temperature, above(0), Standing::calibrated,
                 "Temperature below the ignition temperature.", &Constants::ignition_lowest),
      number_key("ignition_highest", Dimension::temperature, above(0), Standing::calibrated,
                 "Temperature above the ignition temperature.", &Constants::ignition_highest),
      list_key("covariance", Dimension::number, any_number(), Standing::calibrated,
               "Covariance of the logarithms of what was fitted, row by row.", &Constants::covariance) |
          may_be_empty(),
  };
  return keys;
}

/// The keys of a table of the file; none where it has no such table.
std::vector<Leaf> leaves_of(const toml::table& root, const char* name) {
  const toml::table* table = root[name].as_table();
  return table == nullptr ? std::vector<Leaf>{} : leaves_as_written(*table, {});
}

std::string read_interval(const Leaf& leaf, const std::string& file) {
  const Place place = place_of(*leaf.node, file);
  const RangeKey* key = find_named(range_keys(), leaf.name);
  if (key == nullptr) throw unknown_key(place, "range." + leaf.name, names_of(range_keys()));
  KeyDescription interval{"range." + leaf.name, KeyKind::range, key->dimension};
  if (key->dimension == Dimension::share) interval.kind = KeyKind::number;
  read_value(*leaf.node, interval, file);
  return leaf.node->value_or(std::string{});
}

}  // namespace

const std::vector<std::shared_ptr<const Constants>>& shipped_constants() {
  static const auto all = []() noexcept {  // a fault is one of the program itself
    std::vector<std::shared_ptr<const Constants>> read;
    for (const auto& [file, text] : built_in_constants()) {
      Constants constants = parse_constants(text, "the shipped " + file);
      constants.name = std::filesystem::path(file).stem();
      const bool is_default = constants.name == default_constants;
      read.insert(is_default ? read.begin() : read.end(), std::make_shared<Constants>(std::move(constants)));
    }
    return read;
  }();
  return all;
}

Constants parse_constants(const std::string& text, const std::string& file) {
  const toml::table root = parse_toml(text, file);
  Constants constants;
  constants.name = file;
  read_table(root, header_keys(), {"set", "range", "row", "scene", "fitted"}, file, constants);
  if (constants.model_version != model_version)
    throw error_at(place_of(root, file), "model_version", fmt::format("{}", constants.model_version),
                   fmt::format("{}, that of this program; calibrate anew", model_version));
  for (const Leaf& leaf : leaves_of(root, "set"))
    if (!leaf.node->is_table())
      constants.values[leaf.name] =
          read_value(*leaf.node, description_of(leaf.name, place_of(*leaf.node, file)), file);
  const std::string fitted = root["fitted"].value_or(std::string{});
  for (const std::string_view name : parts_of_list(fitted))
    if (!name.empty()) constants.fitted_keys.emplace_back(name);
  const std::size_t count = constants.fitted_keys.size();
  if (constants.covariance.size() != count * count)
    throw error_at(place_of(root, file), "covariance", fmt::format("{} numbers", constants.covariance.size()),
                   fmt::format("{} numbers, a square of the keys that were fitted", count * count));
  for (auto& [row, places] : read_tables(root, "row", row_keys(), file, "tables, each written [[row]]"))
    constants.rows.push_back(std::move(row));
  for (const Leaf& leaf : leaves_of(root, "range")) constants.range[leaf.name] = read_interval(leaf, file);
  constants.scene = parse_scene(root["scene"].value_or(std::string{}), file).scene;
  return constants;
}

std::string to_toml(const Constants& constants) {
  std::string text = fmt::format("# Constants of a launch. Made by: {}\n\n", constants.command);
  text += lines_of("", header_keys(), constants);
  text += fmt::format("fitted = \"{}\"\n", fmt::join(constants.fitted_keys, ", "));
  text += fmt::format("scene = '''\n{}'''\n\n[set]\n", to_toml(constants.scene));
  for (const auto& [name, value] : constants.values)
    text += name + " = " + exact_toml(description_of(name, {}), value) + "\n";
  if (!constants.range.empty()) text += "\n[range]\n";
  for (const auto& [name, interval] : constants.range) text += fmt::format("{} = \"{}\"\n", name, interval);
  for (const FittedNumber& row : constants.rows) text += "\n[[row]]\n" + lines_of("", row_keys(), row);
  return text;
}

std::shared_ptr<const Constants> find_constants(const std::string& name, const std::filesystem::path& folder,
                                                const Place& place, const std::string& key) {
  if (name == no_constants) return nullptr;
  std::vector<std::string> names{no_constants};
  for (const auto& each : shipped_constants()) {
    if (each->name == name) return each;
    names.push_back(each->name);
  }
  const std::string allowed = quoted_list(names) + "; or the path of a constants file, which ends with .toml";
  if (!name.ends_with(".toml"))
    throw error_at(place, key, in_quotes(name), allowed, in_quotes(nearest_of(name, names)));
  const std::filesystem::path path = named_file(folder, name, place, key, "a constants file");
  Constants constants = parse_constants(read_text_file(path), path.string());
  constants.name = name;
  return std::make_shared<Constants>(std::move(constants));
}

std::string key_in_scene(const Scene& scene, const std::string& key) {
  if (!key.starts_with(interface_prefix)) return key;
  const std::size_t end = key.find('.', interface_prefix.size());
  const std::string face = key.substr(interface_prefix.size(), end - interface_prefix.size());
  for (const Body& body : scene.bodies)
    if (!is_charge(scene, body) && face_of(scene, body) == face)
      return interface_prefix + body.name + key.substr(end);
  return {};
}

const Value* constant_of(const SceneFile& file, const std::string& key) {
  if (file.constants == nullptr) return nullptr;
  const Value* value = find_in(file.constants->values, key);
  if (value == nullptr) return nullptr;
  if (key.starts_with("load.") && (file.given.contains("load.curve") || file.given.contains("load.shape")))
    return nullptr;
  if (key.starts_with("steel.") && named_material_of(file, Steel::name) != nullptr) return nullptr;
  const NamedMaterial* charge = named_material_of(file, Charge::name);
  return charge != nullptr && charge->values.contains(key) ? nullptr : value;
}

void hold_by_constants(const SceneFile& file, Scene& scene) {
  std::erase_if(scene.interfaces, [](const Interface& faces) { return faces.from_constants; });
  if (file.constants == nullptr || scene.numerics.formulation == Formulation::updated_lagrangian) return;
  for (const Body& body : scene.bodies) {
    if (is_charge(scene, body) || std::ranges::count(scene.interfaces, body.name, &Interface::body) > 0)
      continue;
    const std::string face = face_of(scene, body);
    if (face.empty()) continue;
    Interface faces = interface_at(*file.constants, face, body.name);
    if (can_slide(faces)) scene.interfaces.push_back(std::move(faces));
  }
}

}  // namespace launchsafe::scene

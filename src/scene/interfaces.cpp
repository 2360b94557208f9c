// The tables [interface.NAME] of a file: how bodies hold the charge.

#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// A fault of one interface, at the first of its keys that the file has.
InputError fault_of(const SceneFile& file, const Interface& faces, const std::string& key, std::string found,
                    std::string allowed, std::string suggestion = {}) {
  const std::string table = "interface." + faces.body, name = key.empty() ? table : table + "." + key;
  Place where{file.file};
  for (const std::string& each : {table, table + ".condition", name})
    if (const auto place = file.places.find(each); place != file.places.end()) where = place->second;
  return error_at(where, name, found, allowed, suggestion);
}

void check_body(const SceneFile& file, const Interface& faces) {
  const Scene& scene = file.scene;
  const std::vector<std::string> touching = bodies_at_the_charge(scene);
  if (contains(touching, faces.body)) return;
  const Body* body = find_named(scene.bodies, faces.body);
  const char* what = body == nullptr           ? "which no body is called"
                     : is_charge(scene, *body) ? "which is a charge itself"
                                               : "which does not touch the charge";
  const std::string nearest = nearest_of(faces.body, touching);
  throw fault_of(file, faces, "", fmt::format("\"{}\", {}", faces.body, what),
                 touching.empty() ? "no interface: no body touches a charge"
                                  : "a body that touches the charge: " + quoted_list(touching),
                 nearest.empty() ? nearest : "interface." + nearest);
}

void check_law(const SceneFile& file, const Interface& faces) {
  const bool slides = faces.condition == Condition::sliding;
  const std::string friction = fmt::format("a friction from 0 (smooth) to {:g}", largest_friction);
  if (slides && !faces.friction)
    throw fault_of(file, faces, "friction", "nothing: faces that slide without their friction", friction);
  if (faces.friction && !slides)
    throw fault_of(file, faces, "friction", fmt::format("{:g} on bonded faces", *faces.friction),
                   "friction with condition = \"sliding\"", "condition = \"sliding\"");
}

}  // namespace

bool share_a_face(const Scene& scene, const Body& a, const Body& b) {
  const double tolerance = length_tolerance(scene);
  const double along_x = overlap(a, b, axis_x), along_r = overlap(a, b, axis_r);
  return (std::abs(along_x) <= tolerance && along_r > tolerance) ||
         (std::abs(along_r) <= tolerance && along_x > tolerance);
}

const std::vector<Key<Interface>>& interface_keys() {
  static const std::vector<Key<Interface>> keys = {
      word_key("condition", Standing::input,
               "How a body and the charge hold each other: bonded, or sliding with friction, "
               "free to part. Bodies without a table are held as the constants say.",
               {{"bonded", Condition::bonded}, {"sliding", Condition::sliding}}, &Interface::condition) |
          required(),
      optional_number_key<Interface>(
          "friction", Dimension::number, between(0, largest_friction),
          "Coulomb's coefficient between the faces; to be given where they can slide, 0 for smooth ones.",
          &Interface::friction),
  };
  return keys;
}

std::vector<std::string> bodies_at_the_charge(const Scene& scene) {
  std::vector<Body> touching = scene.bodies;
  std::erase_if(touching, [&](const Body& body) {
    return is_charge(scene, body) || std::ranges::none_of(scene.bodies, [&](const Body& other) {
             return is_charge(scene, other) && share_a_face(scene, body, other);
           });
  });
  return names_of(touching);
}

void read_interfaces(const toml::table& root, const std::string& file, Scene& scene,
                     std::map<std::string, Place>& places) {
  visit_tables(
      root, "interface", "of the body that touches the charge", file,
      [&](const std::string& body, const toml::table& table) {
        const std::string name = "interface." + body;
        places[name] = place_of(table, file);
        Interface& faces = scene.interfaces.emplace_back(Interface{.body = body});
        within(name, [&] {
          for (const auto& [key, place] : read_table(table, interface_keys(), {}, file, faces).or_throw())
            places[name + "." + key] = place;
        });
      });
}

void check_interfaces(const SceneFile& file) {
  for (const Interface& faces : file.scene.interfaces) {
    check_body(file, faces);
    check_law(file, faces);
    if (!can_slide(faces) || file.scene.numerics.formulation == Formulation::total_lagrangian) continue;
    throw fault_of(file, faces, "condition", "faces that can slide with formulation \"updated-lagrangian\"",
                   "bonded faces with \"updated-lagrangian\", which has one velocity a "
                   "place; sliding with numerics.formulation = \"total-lagrangian\"",
                   "formulation = \"total-lagrangian\"");
  }
}

std::vector<InterfaceText> describe_interfaces(const Scene& scene) {
  std::vector<InterfaceText> described;
  for (const std::string& body : bodies_at_the_charge(scene)) {
    const auto faces = std::ranges::find(scene.interfaces, body, &Interface::body);
    InterfaceText& text = described.emplace_back(InterfaceText{
        body, "bonded", "charge and body never part or slide, and the bond bears any tension and shear"});
    if (faces == scene.interfaces.end() || !can_slide(*faces)) continue;
    text.condition = "sliding";
    text.assumes = fmt::format(
        "Coulomb's friction {:g} on the pressure of the same instant, no tension, faces may part; the heat "
        "of friction is told and heats no skin",
        faces->friction.value_or(0.0));
  }
  return described;
}

}  // namespace launchsafe::scene

// The tables [interface.NAME] and [contact.NAME] of a file: how bodies hold the charge.
#include "launchsafe/scene/interfaces.hpp"

#include "launchsafe/scene/read_scene.hpp"

#include <fmt/format.h>

#include <cmath>

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

Fault check_body(const SceneFile& file, const Interface& faces) {
  const Scene& scene = file.scene;
  const std::vector<std::string> touching = bodies_at_the_charge(scene);
  if (std::ranges::find(touching, faces.body) != touching.end()) return std::nullopt;
  const Body* body = find_named(scene.bodies, faces.body);
  const char* what = body == nullptr           ? "which no body is called"
                     : is_charge(scene, *body) ? "which is a charge itself"
                                               : "which does not touch the charge";
  const std::string nearest = nearest_of(faces.body, touching);
  return fault_of(file, faces, "", fmt::format("\"{}\", {}", faces.body, what),
                  touching.empty() ? "no interface: no body touches a charge"
                                   : "a body that touches the charge: " + quoted_list(touching),
                  nearest.empty() ? nearest : "interface." + nearest);
}

Fault check_law(const SceneFile& file, const Interface& faces) {
  const bool slides = faces.condition == Condition::sliding;
  const bool breaks = faces.tension_strength || faces.shear_strength;
  const std::string friction = fmt::format("a friction from 0 (smooth) to {:g}", largest_friction);
  if (slides && breaks)
    return fault_of(file, faces, faces.tension_strength ? "tension_strength" : "shear_strength",
                    "the strength of a bond on faces that slide from the start",
                    "strengths with condition = \"bonded\", or condition = \"sliding\" without them");
  if (slides && !faces.friction)
    return fault_of(file, faces, "friction", "nothing: faces that slide without their friction", friction);
  if (breaks && !faces.friction)
    return fault_of(file, faces, "friction",
                    "nothing: a bond that can break without the friction of the faces after it", friction);
  if (breaks && !(faces.tension_strength && faces.shear_strength))
    return fault_of(file, faces, faces.tension_strength ? "shear_strength" : "tension_strength",
                    "nothing, beside the other strength of the bond", "both strengths of a bond, or none");
  if (faces.friction && !slides && !breaks)
    return fault_of(file, faces, "friction",
                    fmt::format("{:g} on faces that are bonded for good", *faces.friction),
                    "friction with condition = \"sliding\", or with the strengths of a bond that can break",
                    "condition = \"sliding\"");
  return std::nullopt;
}

/// The values of the contact that a table [interface.NAME] names; none where it names none.
Expected<const NamedContact*> contact_of(const toml::table& table, const std::string& file,
                                         const std::vector<NamedContact>& contacts) {
  const toml::node* node = table.get("contact");
  if (node == nullptr) return static_cast<const NamedContact*>(nullptr);
  const auto name = read_value(*node, contact_of_interface_key(), file);
  if (!name) return name.error();
  std::vector<std::string> names;
  for (const NamedContact& each : contacts) {
    if (each.name == std::get<std::string>(*name)) return &each;
    names.push_back(each.name);
  }
  return error_at(place_of(*node, file), "contact", found_text(*node),
                  quoted_list(names) + "; or one that a table [contact.NAME] describes",
                  nearest_of(std::get<std::string>(*name), names));
}

/// One table [interface.NAME].
Expected<Interface> read_interface(const std::string& body, const toml::table& table, const std::string& file,
                                   const std::vector<NamedContact>& contacts, std::vector<Source>& sources,
                                   std::map<std::string, Place>& places) {
  const auto contact = contact_of(table, file, contacts);
  if (!contact) return contact.error();
  Interface faces;
  if (*contact != nullptr) faces = (*contact)->faces;
  faces.body = body;
  std::vector<Key<Interface>> keys = interface_keys();
  if (*contact != nullptr)
    for (Key<Interface>& key : keys) key.required = false;  // the contact gives the condition
  const auto read = read_table(table, keys, {"contact"}, file, faces);
  if (!read) return read.error();
  std::vector<Source> of_contact = *contact != nullptr ? (*contact)->sources : std::vector<Source>{};
  for (const auto& [key, place] : *read) {
    places[fmt::format("interface.{}.{}", body, key)] = place;
    forget_source(of_contact, key);
  }
  for (Source& source : of_contact) {
    for (std::string& key : source.keys) key = fmt::format("interface.{}.{}", body, key);
    source.citation = fmt::format("{}: {}", (*contact)->name, source.citation);
    sources.push_back(std::move(source));
  }
  return faces;
}

}  // namespace

bool share_a_face(const Scene& scene, const Body& a, const Body& b) {
  const double tolerance = length_tolerance(scene);
  const auto meet = [&](double end, double begin) { return std::abs(end - begin) <= tolerance; };
  const double common_x = std::min(a.x_end, b.x_end) - std::max(a.x_begin, b.x_begin);
  const double common_r = std::min(a.r_end, b.r_end) - std::max(a.r_begin, b.r_begin);
  const bool ends = meet(a.x_end, b.x_begin) || meet(b.x_end, a.x_begin);
  const bool sides = meet(a.r_end, b.r_begin) || meet(b.r_end, a.r_begin);
  return (ends && common_r > tolerance) || (sides && common_x > tolerance);
}

const std::vector<Key<Interface>>& interface_keys() {
  static const std::vector<Key<Interface>> keys = {
      word_key("condition", Standing::input,
               "How a body and the charge hold each other: bonded, or sliding with friction, "
               "free to part. Bodies without a table are bonded.",
               {{"bonded", Condition::bonded}, {"sliding", Condition::sliding}}, &Interface::condition) |
          required() |
          always_plausible(
              "launches are published with bonded charges, and shells are loaded with and without a bond",
              of_model),
      optional_number_key<Interface>(
          "friction", Dimension::number, between(0, largest_friction),
          "Coulomb's coefficient between the faces; to be given where they can slide, 0 for smooth ones.",
          &Interface::friction) |
          plausibly(between(0, 1), "explosives on metals and lacquers are measured between 0.05 and 0.6",
                    of_model),
      optional_number_key<Interface>("tension_strength", Dimension::pressure, above_to(0, 1e12),
                                     "Tension at which the bond breaks for good; none: it never does.",
                                     &Interface::tension_strength) |
          plausibly(above_to(0, 100e6), "no explosive or lacquer bears more", of_model),
      optional_number_key<Interface>("shear_strength", Dimension::pressure, above_to(0, 1e12),
                                     "Shear at which the bond breaks for good; none: it never does.",
                                     &Interface::shear_strength) |
          plausibly(above_to(0, 100e6), "no explosive or lacquer bears more", of_model),
  };
  return keys;
}

std::vector<std::string> bodies_at_the_charge(const Scene& scene) {
  std::vector<std::string> names;
  for (const Body& body : scene.bodies) {
    if (is_charge(scene, body)) continue;
    const bool touches = std::ranges::any_of(scene.bodies, [&](const Body& other) {
      return is_charge(scene, other) && share_a_face(scene, body, other);
    });
    if (touches) names.push_back(body.name);
  }
  return names;
}

Expected<ReadInterfaces> read_interfaces(const toml::table& root, const std::string& file,
                                         const std::vector<NamedContact>& contacts,
                                         std::map<std::string, Place>& places) {
  ReadInterfaces read;
  const auto add = [&](const std::string& body, const toml::table& table) -> Fault {
    const std::string name = "interface." + body;
    places[name] = place_of(table, file);
    auto faces = read_interface(body, table, file, contacts, read.sources, places);
    if (!faces) return within(name, faces.error());
    read.interfaces.push_back(std::move(*faces));
    return std::nullopt;
  };
  if (auto error = visit_tables(root, "interface", "of the body that touches the charge", file, add))
    return *error;
  return read;
}

Fault check_interfaces(const SceneFile& file) {
  for (const Interface& faces : file.scene.interfaces) {
    if (auto error = check_body(file, faces)) return error;
    if (auto error = check_law(file, faces)) return error;
    if (!can_slide(faces) || file.scene.numerics.formulation == Formulation::total_lagrangian) continue;
    return fault_of(file, faces, "condition", "faces that can slide with formulation \"updated-lagrangian\"",
                    "faces bonded for good with \"updated-lagrangian\", which has one velocity a "
                    "place; sliding with numerics.formulation = \"total-lagrangian\"",
                    "formulation = \"total-lagrangian\"");
  }
  return std::nullopt;
}

std::string interfaces_as_toml(std::vector<Interface> interfaces) {
  const KeyDescription name{.kind = KeyKind::text};
  // In the order of names, in which files are read: the order in which a program made them says nothing.
  std::ranges::stable_sort(interfaces, {}, &Interface::body);
  std::string text;
  for (const Interface& faces : interfaces) {
    const auto add = [&](std::string_view key, const std::string& value) {
      text += fmt::format("interface.{}.{} = {}\n", exact_toml(name, faces.body), key, value);
    };
    for (const Key<Interface>& key : interface_keys())
      if (!key.is_written || key.is_written(faces)) add(key.name, exact_toml(key, key.get(faces)));
    // Only programs make these; files cannot say them, but texts of different scenes differ.
    if (!faces.against.empty()) add("against", exact_toml(name, faces.against));
  }
  return text;
}

std::vector<InterfaceText> describe_interfaces(const Scene& scene) {
  std::vector<InterfaceText> described;
  for (const std::string& body : bodies_at_the_charge(scene)) {
    const auto faces = std::ranges::find(scene.interfaces, body, &Interface::body);
    if (faces == scene.interfaces.end() || !can_slide(*faces)) {
      described.push_back(
          {body, "bonded", "charge and body never part or slide, and the bond bears any tension and shear"});
      continue;
    }
    const std::string sliding = fmt::format(
        "Coulomb's friction {:g} on the pressure of the same instant, no tension, faces may part; the heat "
        "of friction is told and heats no skin",
        faces->friction.value_or(0.0));
    if (!faces->tension_strength) {
      described.push_back({body, "sliding", sliding});
      continue;
    }
    described.push_back(
        {body, "bonded until it breaks",
         fmt::format("past {} of tension or {} of shear at a node, each by itself, the bond is gone there "
                     "for good; then {}",
                     pressure_text(*faces->tension_strength),
                     pressure_text(faces->shear_strength.value_or(0.0)), sliding)});
  }
  return described;
}

const std::vector<Key<NamedContact>>& contact_keys() {
  static const std::vector<Key<NamedContact>> keys =
      keys::joined({{text_key("title", Standing::input, "What the contact is, for reports.", "smooth faces",
                              &NamedContact::title) |
                     always_plausible("it is for people")},
                    keys::keys_of_part("", &NamedContact::faces, interface_keys())});
  return keys;
}

const KeyDescription& contact_of_interface_key() {
  static const KeyDescription key{
      .name = "contact",
      .kind = KeyKind::text,
      .standing = Standing::input,
      .sentence = "Contact by name, whose values stand for those that are not given here.",
      .example = "smooth",
      .plausible = {.because = "the values are judged"}};
  return key;
}

}  // namespace launchsafe::scene

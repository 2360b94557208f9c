#include "foreign_material.hpp"

#include "launchsafe/scene/named_material.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace launchsafe::study {
namespace {

using scene::Implausible, scene::Material, scene::Scene;

/// Whether the keys of the scene speak of the material.
bool is_first_of_its_law(const Scene& scene, const Material& material) {
  return std::visit([&]<class Law>(const Law&) { return material.name == scene.material<Law>().name; },
                    material.law);
}

/// What of a material is not as in another one.
std::vector<Implausible> differences(const Scene& scene, const Material& material, const Material& other) {
  std::vector<Implausible> found;
  const auto add = [&](const scene::KeyDescription& key, const std::string& name, const scene::Value& value,
                       const std::string& calibrated) {
    found.push_back(scene::implausible(scene.accepted, key,
                                       fmt::format("material.{}.{}", material.name, name), value,
                                       "calibrated with " + calibrated));
  };
  std::visit(
      [&]<class Law>(const Law& law) {
        const Law* theirs = std::get_if<Law>(&other.law);
        if (theirs == nullptr)
          return add({.kind = scene::KeyKind::text}, "law", std::string(Law::name), "another law");
        for (const auto& key : Law::parameters()) {
          if (key.name.ends_with(".title") || same_value(key.get(law), key.get(*theirs))) continue;
          add(key, scene::key_in_material(Law::name, key.name), key.get(law),
              scene::format_value(key, key.get(*theirs)));
        }
      },
      material.law);
  return found;
}

/// Whether a difference is of a constant of a material. When it ignites is a constant of the calibration, and
/// friction of cracks is part of the model.
bool is_of_material(const Implausible& each) {
  const std::string& key = each.key;
  if (key == "kinetics.ignition_temperature" || key == "charge.crack_friction" ||
      key == "charge.face_friction")
    return false;
  return key.starts_with("kinetics.") || key.starts_with("material.") ||
         std::ranges::any_of(scene::usual_materials(),
                             [&](const Material& law) { return key.starts_with(law.name + "."); });
}

}  // namespace

std::string short_digest(const std::string& text) { return store::sha256(text).substr(0, 8); }

void add_other_materials(const Scene& scene, const Scene& calibrated,
                         bool (*share_place)(const scene::Body&, const scene::Body&),
                         std::vector<Implausible>& foreign) {
  std::set<std::string> compared;
  for (const scene::Body& body : scene.bodies) {
    const Material& material = *scene::find_material(scene, body.material);
    std::vector<Implausible> fewest;
    bool first = true;
    for (const scene::Body& there : calibrated.bodies) {
      if (share_place != nullptr && !share_place(body, there)) continue;
      const Material& other = *scene::find_material(calibrated, there.material);
      const bool by_keys = is_first_of_its_law(scene, material) && is_first_of_its_law(calibrated, other) &&
                           material.law.index() == other.law.index();
      std::vector<Implausible> found =
          by_keys ? std::vector<Implausible>{} : differences(scene, material, other);
      if (first || found.size() < fewest.size()) fewest = std::move(found);
      first = false;
    }
    if (!fewest.empty() && compared.insert(material.name).second)
      foreign.insert(foreign.end(), fewest.begin(), fewest.end());
  }
}

void summarise_materials(const Scene& scene, std::vector<Implausible>& foreign) {
  std::string values;
  std::vector<std::string> names;
  for (const Implausible& each : foreign) {
    if (!is_of_material(each)) continue;
    names.push_back(each.key);
    values += scene::value_text({each.key, each.value, {}, {}, {}}) + "\n";
  }
  if (names.size() < 2) return;
  std::erase_if(foreign, is_of_material);
  constexpr std::size_t most_named = 3;
  const std::size_t named = std::min(names.size(), most_named);
  const std::string rest = named < names.size() ? fmt::format(" and {} more", names.size() - named) : "";
  foreign.push_back(scene::implausible(
      scene.accepted, {.kind = scene::KeyKind::text}, scene::foreign_material,
      fmt::format("{}{}, {}",
                  fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(named), ", "), rest,
                  short_digest(values)),
      "calibrated with other numbers"));
}

}  // namespace launchsafe::study

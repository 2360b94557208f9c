// Reads decompositions of explosives, and picks that of a flame.
#include "launchsafe/scene/decomposition.hpp"

#include <algorithm>
#include <utility>

namespace launchsafe::scene {

const std::vector<Key<Decomposition>>& decomposition_keys() {
  static const std::vector<Key<Decomposition>> keys{
      required(text_key("title", Standing::input, "Of which explosive, for reports.", "RDX",
                        &Decomposition::title)),
      required(number_key<Decomposition>(
          "activation_temperature", Dimension::temperature_difference, above_to(0, 1e6), Standing::literature,
          "Activation energy over the gas constant, E/R.",
          [](auto& d) -> auto& { return d.kinetics.activation_temperature; })),
      required(number_key<Decomposition>(
          "frequency", Dimension::frequency, above_to(0, 1e30), Standing::literature, "Frequency factor Z.",
          [](auto& d) -> auto& { return d.kinetics.frequency; })),
      required(number_key<Decomposition>(
          "heat_of_reaction", Dimension::specific_energy, above_to(0, 1e8), Standing::literature, "Heat Q.",
          [](auto& d) -> auto& { return d.kinetics.heat_of_reaction; })),
  };
  return keys;
}

Expected<std::vector<Decomposition>> read_decompositions(const toml::table& root, const std::string& file,
                                                         const std::vector<Decomposition>&) {
  std::vector<Decomposition> all;
  const auto read = [&](const std::string& name, const toml::table& table) -> std::optional<InputError> {
    Decomposition each;
    each.name = each.kinetics.name = name;
    if (auto places = read_table(table, decomposition_keys(), {"source"}, file, each); !places)
      return within("decomposition." + name, places.error());
    auto sources = read_sources(table, {"activation_temperature", "frequency", "heat_of_reaction"}, file);
    if (!sources) return within("decomposition." + name, sources.error());
    each.sources = std::move(*sources);
    all.push_back(std::move(each));
    return std::nullopt;
  };
  if (auto error = visit_tables(root, "decomposition", "that combustion.kinetics refers to", file, read))
    return *error;
  return all;
}

materials::KineticsParameters flame_kinetics(const Scene& scene) {
  materials::KineticsParameters kinetics = scene.charge().kinetics;
  const auto& all = shipped_decompositions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Decomposition& each) {
    return each.name == scene.combustion.kinetics;
  });
  if (found == all.end()) return kinetics;
  kinetics.name = found->name;
  kinetics.activation_temperature = found->kinetics.activation_temperature;
  kinetics.frequency = found->kinetics.frequency;
  kinetics.heat_of_reaction = std::min(kinetics.heat_of_reaction, found->kinetics.heat_of_reaction);
  return kinetics;
}

}  // namespace launchsafe::scene

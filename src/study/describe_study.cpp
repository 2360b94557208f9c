// The keys of a study file as documentation.
#include "cited_limits.hpp"
#include "hard_launches.hpp"
#include "launchsafe/scene/acceptance.hpp"
#include "study_axes.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace launchsafe::study {
namespace {

using scene::DocumentedKey, scene::KeyDescription, scene::KeyKind;

/// " (kind critical-gap, sweep)", or nothing for a key of every kind.
std::string kinds_text(const std::vector<StudyKind>& kinds) {
  std::vector<std::string> names;
  for (const StudyKind kind : kinds) names.push_back(to_string(kind));
  return names.empty() ? std::string{} : fmt::format(" (kind {})", fmt::join(names, ", "));
}

/// Empty for a value that stands for none.
std::string default_text(const KeyDescription& key, const scene::Value& value) {
  const auto* number = std::get_if<double>(&value);
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const bool none = key.required || (number && !std::isfinite(*number)) ||
                    (numbers && !numbers->empty() && !std::isfinite(numbers->front()));
  return none ? std::string{} : scene::format_value(key, value);
}

template <class Owner>
void document(std::vector<DocumentedKey>& documented, const std::vector<scene::Key<Owner>>& keys,
              const std::string& table) {
  for (const scene::Key<Owner>& key : keys) {
    DocumentedKey entry{key, default_text(key, key.default_value())};
    entry.description.sentence += kinds_text(detail::kinds_of_key(table.empty() ? key.name : table));
    if (!table.empty()) entry.description.name = table + "." + key.name;
    documented.push_back(std::move(entry));
  }
}

/// Axes take a list of what their scene key takes one of.
DocumentedKey axis_of(const std::string& name, const std::string& scene_key, std::string sentence) {
  KeyDescription key = *scene::find_key(scene::scene_keys(), scene_key);
  key.name = "axes." + name;
  key.kind = KeyKind::list;
  key.sentence = std::move(sentence) + kinds_text(detail::kinds_of_key("axes"));
  return {std::move(key), {}};
}

void document_axes(std::vector<DocumentedKey>& documented) {
  documented.push_back(axis_of(std::string(detail::gap_axis), "gap.thickness",
                               "Gaps to judge, all on each mechanical run; those of the scene if absent. "
                               "Beside it write other keys of [gap] in quotation marks: "
                               "\"gap.exchange_time\"."));
  for (const detail::NamedAxis& axis : detail::named_axes()) {
    documented.push_back(axis_of(axis.name, axis.key,
                                 fmt::format("Values of {}, each a mechanical run; so may any scene key that "
                                             "takes one number be varied, by its own name.",
                                             axis.key)));
  }
}

}  // namespace

std::vector<DocumentedKey> describe_study_keys() {
  std::vector<DocumentedKey> documented;
  document(documented, detail::study_keys(), "");
  document(documented, detail::reference_keys(), "reference");
  document(documented, detail::cited_limit_keys(), "cited_limit");
  document_axes(documented);
  document(documented, detail::input_keys({}), "input");
  document(documented, detail::hard_launch_keys(), "case");
  document(documented, scene::acceptance_keys(), "accept");
  return documented;
}

}  // namespace launchsafe::study

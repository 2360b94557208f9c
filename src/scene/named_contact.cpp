// The contacts of a file: how bodies hold the charge.
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/named_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace launchsafe::scene {
namespace {

Expected<NamedContact> read_contact(const std::string& name, const toml::table& table,
                                    const std::string& file) {
  NamedContact contact;
  contact.name = name;
  const auto places = read_table(table, contact_keys(), {"source"}, file, contact);
  if (!places) return places.error();
  std::vector<std::string> given;
  for (const Key<Interface>& key : interface_keys())
    if (places->contains(key.name)) given.push_back(key.name);
  auto sources = read_sources(table, given, file);
  if (!sources) return sources.error();
  contact.sources = std::move(*sources);
  return contact;
}

}  // namespace

const std::vector<Key<NamedContact>>& contact_keys() {
  static const std::vector<Key<NamedContact>> keys =
      keys::joined({{always_plausible(text_key("title", Standing::input, "What the contact is, for reports.",
                                               "smooth faces", &NamedContact::title),
                                      "it is for people")},
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

Expected<std::vector<NamedContact>> read_contacts(const toml::table& root, const std::string& file,
                                                  const std::vector<NamedContact>& known) {
  std::vector<NamedContact> contacts;
  const auto read = [&](const std::string& name, const toml::table& table) -> std::optional<InputError> {
    if (std::any_of(known.begin(), known.end(), [&](const NamedContact& each) { return each.name == name; }))
      return error_at(place_of(table, file), "contact", fmt::format("a contact called \"{}\"", name),
                      "a name that no other contact has");
    auto contact = read_contact(name, table, file);
    if (!contact) return within("contact." + name, contact.error());
    contacts.push_back(std::move(*contact));
    return std::nullopt;
  };
  if (auto error = visit_tables(root, "contact", "that interfaces refer to", file, read)) return *error;
  return contacts;
}

}  // namespace launchsafe::scene

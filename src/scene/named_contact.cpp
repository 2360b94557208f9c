#include "launchsafe/scene/named_contact.hpp"

#include "built_in_materials.hpp"
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
  std::vector<const KeyDescription*> described = descriptions_of(contact_keys());
  const std::size_t own = described.size();
  for (const KeyDescription* key : descriptions_of(interface_keys())) described.push_back(key);
  const auto read = read_described(table, described, {"source"}, file);
  if (!read) return read.error();
  std::vector<std::string> given;
  for (const auto& [index, value] : read->values) {
    if (index < own) {
      contact_keys()[index].set(contact, value);
    } else {
      interface_keys()[index - own].set(contact.faces, value);
      given.push_back(described[index]->name);
    }
  }
  auto sources = read_sources(table, given, file);
  if (!sources) return sources.error();
  contact.sources = std::move(*sources);
  return contact;
}

}  // namespace

const std::vector<Key<NamedContact>>& contact_keys() {
  static const std::vector<Key<NamedContact>> keys{
      always_plausible(text_key("title", Standing::input, "What the contact is, for reports.", "smooth faces",
                                &NamedContact::title),
                       "it is for people")};
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

const std::vector<NamedContact>& shipped_contacts() {
  static const std::vector<NamedContact> all = read_built_in<NamedContact>(read_contacts);
  return all;
}

Expected<std::vector<NamedContact>> read_contacts(const toml::table& root, const std::string& file,
                                                  const std::vector<NamedContact>& known) {
  std::vector<NamedContact> contacts;
  const toml::node* node = root.get("contact");
  if (node == nullptr) return contacts;
  const auto no_table = [&](const toml::node& found, const std::string& key) {
    return error_at(place_of(found, file), key, found_text(found),
                    "tables, each written [contact.NAME] with the name that interfaces refer to");
  };
  if (!node->is_table()) return no_table(*node, "contact");
  for (const auto& [name, inner] : *node->as_table()) {
    const std::string text(name.str());
    if (!inner.is_table()) return no_table(inner, "contact." + text);
    if (std::any_of(known.begin(), known.end(), [&](const NamedContact& each) { return each.name == text; }))
      return error_at(place_of(inner, file), "contact", fmt::format("a contact called \"{}\"", text),
                      "a name that no other contact has");
    auto contact = read_contact(text, *inner.as_table(), file);
    if (!contact) {
      InputError error = contact.error();
      error.key = "contact." + text + "." + error.key;
      return error;
    }
    contacts.push_back(std::move(*contact));
  }
  return contacts;
}

}  // namespace launchsafe::scene

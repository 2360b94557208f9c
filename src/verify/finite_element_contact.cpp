// Contact in finite element decks: nodes of faces that can part, and CalculiX's face-to-face penalty contact.
#include "finite_element_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::verify {
namespace {

/// Coefficient of friction from which on faces that stick do not become stiffer.
constexpr double stiffest_friction = 0.1;

bool holds(const std::vector<int>& bodies, int body) {
  return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
}

/// A face of an element, by CalculiX's name for it: S1 (x least), S2 (r most), S3 (x most), S4 (r least).
struct ElementFace {
  int element;
  const char* name;
};

/// The faces on which two bodies touch, of the one and, in the same order, of the other.
struct TouchingFaces {
  std::vector<ElementFace> own, other;
};

TouchingFaces faces_between(const FiniteElementModel& model, int body, int other) {
  TouchingFaces faces;
  const auto look = [&](int before, const char* before_face, int after, const char* after_face) {
    if (model.body(before) == body && model.body(after) == other) {
      faces.own.push_back({before, before_face});
      faces.other.push_back({after, after_face});
    } else if (model.body(before) == other && model.body(after) == body) {
      faces.own.push_back({after, after_face});
      faces.other.push_back({before, before_face});
    }
  };
  for (int j = 0; j < model.rows(); ++j)
    for (int i = 0; i < model.columns(); ++i) {
      if (i > 0) look(model.element(i - 1, j), "S3", model.element(i, j), "S1");
      if (j > 0) look(model.element(i, j - 1), "S2", model.element(i, j), "S4");
    }
  return faces;
}

void write_surface(const std::string& name, const std::vector<ElementFace>& faces, Text text) {
  fmt::format_to(text, "*SURFACE,NAME={},TYPE=ELEMENT\n", name);
  for (const ElementFace& face : faces) fmt::format_to(text, "{},{}\n", face.element + 1, face.name);
}

}  // namespace

const FiniteElementContact* FiniteElementModel::contact_between(int a, int b) const {
  for (const FiniteElementContact& contact : contacts)
    if ((contact.body == a && contact.other == b) || (contact.body == b && contact.other == a))
      return &contact;
  return nullptr;
}

NodeLattice::NodeLattice(const FiniteElementModel& model)
    : columns(2 * model.columns() + 1), rows(2 * model.rows() + 1), model_(&model) {
  for (int b = 0; b < rows; ++b)
    for (int a = 0; a < columns; ++a) copies = std::max(copies, copies_at(a, b));
}

int NodeLattice::copies_at(int a, int b) const {
  if (a % 2 != 0 && b % 2 != 0) return 0;
  return model_->contacts.empty() ? 1 : static_cast<int>(groups_at(a, b).size());
}

int NodeLattice::number(int a, int b, int body) const {
  if (model_->contacts.empty()) return number_of_copy(a, b, 0);
  const std::vector<std::vector<int>> groups = groups_at(a, b);
  const auto own = std::find_if(groups.begin(), groups.end(),
                                [body](const std::vector<int>& group) { return holds(group, body); });
  return number_of_copy(a, b, static_cast<int>(own - groups.begin()));
}

std::vector<std::vector<int>> NodeLattice::groups_at(int a, int b) const {
  std::vector<std::vector<int>> groups;
  for (int j = std::max(0, (b - 1) / 2); j <= std::min(model_->rows() - 1, b / 2); ++j)
    for (int i = std::max(0, (a - 1) / 2); i <= std::min(model_->columns() - 1, a / 2); ++i) {
      const int body = model_->body(model_->element(i, j));
      if (std::any_of(groups.begin(), groups.end(),
                      [body](const std::vector<int>& group) { return holds(group, body); }))
        continue;
      // The body joins all groups that have one to which it is bonded.
      std::vector<int> joined{body};
      std::erase_if(groups, [&](const std::vector<int>& group) {
        const bool bonded = std::any_of(group.begin(), group.end(), [&](int each) {
          return model_->contact_between(body, each) == nullptr;
        });
        if (bonded) joined.insert(joined.end(), group.begin(), group.end());
        return bonded;
      });
      groups.push_back(std::move(joined));
    }
  return groups;
}

void write_contacts(const FiniteElementModel& model, Text text) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const FiniteElementContact& contact = model.contacts[k];
    const TouchingFaces faces = faces_between(model, contact.body, contact.other);
    if (faces.own.empty()) continue;
    write_surface(fmt::format("OWN{}", k), faces.own, text);
    write_surface(fmt::format("OTHER{}", k), faces.other, text);
    fmt::format_to(text,
                   "*CONTACT PAIR,INTERACTION=FACES{},TYPE=SURFACE TO SURFACE\nOWN{},OTHER{}\n"
                   "*SURFACE INTERACTION,NAME=FACES{}\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n"
                   "{:.10g}\n",
                   k, k, k, k, model.contact_stiffness * pascal);
    if (contact.friction > 0.0)
      fmt::format_to(text, "*FRICTION\n{:.10g},{:.10g}\n", contact.friction,
                     std::min(contact.friction, stiffest_friction) * model.stick_stiffness * pascal);
  }
}

}  // namespace launchsafe::verify

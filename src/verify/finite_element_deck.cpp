#include "launchsafe/verify/finite_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace launchsafe::verify {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Decks are in m, s and MPa, hence in 1000 t: CalculiX 2.20 takes a compressibility as small as steel's in
/// 1/Pa for zero and replaces it by a default.
constexpr double pascal = 1.0 / deck_stress_unit;

/// Nodes lie on a lattice of corners and mid-sides; the places in the middle of elements stay empty. Where
/// faces can part, a place has a copy for each body, or for each group of bodies that are bonded there.
class NodeLattice {
 public:
  explicit NodeLattice(const FiniteElementModel& model);

  int columns, rows, copies = 1;
  /// How many nodes a place has; 0 in the middle of an element.
  int copies_at(int a, int b) const;
  int number_of_copy(int a, int b, int copy) const { return 1 + a + columns * (b + rows * copy); }
  /// The node of a body.
  int number(int a, int b, int body) const;

 private:
  /// Bodies around a place, those that are bonded there in one group.
  std::vector<std::vector<int>> groups_at(int a, int b) const;

  const FiniteElementModel* model_;
};

/// Coefficient of friction from which on faces that stick do not become stiffer.
constexpr double stiffest_friction = 0.1;

bool holds(const std::vector<int>& bodies, int body) {
  return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
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

double place(const std::vector<double>& edges, int half_steps) {
  const auto k = static_cast<std::size_t>(half_steps / 2);
  return half_steps % 2 == 0 ? edges[k] : 0.5 * (edges[k] + edges[k + 1]);
}

void write_nodes(const FiniteElementModel& model, const NodeLattice& nodes, Text text) {
  fmt::format_to(text, "*NODE\n");
  for (int copy = 0; copy < nodes.copies; ++copy)
    for (int b = 0; b < nodes.rows; ++b)
      for (int a = 0; a < nodes.columns; ++a) {
        if (copy >= nodes.copies_at(a, b)) continue;
        fmt::format_to(text, "{},{:.12g},{:.12g}\n", nodes.number_of_copy(a, b, copy),
                       place(model.edges_r, b), place(model.edges_x, a));
      }
}

/// CalculiX refuses sets without members: a material that no element has is left out.
bool is_used(const FiniteElementModel& model, std::size_t material) {
  return std::find(model.material_of.begin(), model.material_of.end(), static_cast<int>(material)) !=
         model.material_of.end();
}

/// Corners counterclockwise in the plane (r, x), then the mid-sides: faces 1 (x least), 2 (r most), 3 (x
/// most), 4 (r least).
void write_elements(const FiniteElementModel& model, const NodeLattice& nodes, Text text) {
  for (std::size_t material = 0; material < model.materials.size(); ++material) {
    if (!is_used(model, material)) continue;
    fmt::format_to(text, "*ELEMENT,TYPE=CAX8R,ELSET=PART{}\n", material);
    for (int j = 0; j < model.rows(); ++j)
      for (int i = 0; i < model.columns(); ++i) {
        const int element = model.element(i, j);
        if (model.material(element) != static_cast<int>(material)) continue;
        const int a = 2 * i, b = 2 * j, body = model.body(element);
        const auto node = [&](int da, int db) { return nodes.number(a + da, b + db, body); };
        fmt::format_to(text, "{},{},{},{},{},{},{},{},{}\n", element + 1, node(0, 0), node(0, 2), node(2, 2),
                       node(2, 0), node(0, 1), node(1, 2), node(2, 1), node(1, 0));
      }
  }
}

/// A material that yields is linear in logarithmic strains; an elastic one is neo-Hookean, with its
/// volumetric and deviatoric responses decoupled. CalculiX's linear law for large strains couples them: under
/// a pressure it adds to the deviator twice the pressure times the strain, a tenth of it in an explosive at
/// 100 MPa.
void write_law(const FiniteElementMaterial& material, Text text) {
  const double bulk = material.bulk_modulus, shear = material.shear_modulus;
  if (material.hardening.empty()) {
    fmt::format_to(text, "*HYPERELASTIC,NEO HOOKE\n{:.10g},{:.10g}\n", 0.5 * shear * pascal,
                   2.0 / (bulk * pascal));
    return;
  }
  const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
  const double poisson = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
  fmt::format_to(text, "*ELASTIC\n{:.10g},{:.10g}\n*PLASTIC\n", young * pascal, poisson);
  for (const HardeningPoint& point : material.hardening)
    fmt::format_to(text, "{:.10g},{:.10g}\n", point.stress * pascal, point.plastic_strain);
}

void write_materials(const FiniteElementModel& model, Text text) {
  fmt::format_to(text, "*ELSET,ELSET=ELEMENTS,GENERATE\n1,{}\n", model.elements());
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    if (!is_used(model, k)) continue;
    fmt::format_to(text, "*MATERIAL,NAME=MATERIAL{}\n", k);
    write_law(model.materials[k], text);
    fmt::format_to(text, "*DENSITY\n{:.10g}\n*SOLID SECTION,ELSET=PART{},MATERIAL=MATERIAL{}\n",
                   model.materials[k].density * pascal, k, k);
  }
}

void write_supports(const FiniteElementModel& model, const NodeLattice& nodes, Text text) {
  fmt::format_to(text, "*BOUNDARY\n");
  const auto hold_radially = [&](int b) {
    for (int a = 0; a < nodes.columns; ++a)
      for (int copy = 0; copy < nodes.copies_at(a, b); ++copy)
        fmt::format_to(text, "{},1,1\n", nodes.number_of_copy(a, b, copy));
  };
  if (model.axis_held || !(model.edges_r.front() > 0.0)) hold_radially(0);
  if (model.rigid_barrel) hold_radially(nodes.rows - 1);
  if (model.ends_held) {
    for (int b = 0; b < nodes.rows; ++b)
      for (const int a : {0, nodes.columns - 1})
        fmt::format_to(text, "{},2,2\n", nodes.number_of_copy(a, b, 0));
  } else {
    // Pressure and body force balance; one node is held against rigid motion. It bears the change of the
    // pressed face's area (follower load), hence it is at the far end.
    fmt::format_to(text, "{},2,2\n", nodes.number_of_copy(0, 0, 0));
  }
}

/// A face of an element, by CalculiX's name for it: S1 (x least), S2 (r most), S3 (x most), S4 (r least).
struct ElementFace {
  int element;
  const char* name;
};

/// Where two bodies touch: the face of `body`, and that of `other` on which it lies.
std::vector<std::pair<ElementFace, ElementFace>> faces_between(const FiniteElementModel& model, int body,
                                                               int other) {
  std::vector<std::pair<ElementFace, ElementFace>> faces;
  const auto look = [&](const ElementFace& before, const ElementFace& after) {
    const int first = model.body(before.element), second = model.body(after.element);
    if (first == body && second == other) faces.emplace_back(before, after);
    if (first == other && second == body) faces.emplace_back(after, before);
  };
  for (int j = 0; j < model.rows(); ++j)
    for (int i = 0; i < model.columns(); ++i) {
      if (i > 0) look({model.element(i - 1, j), "S3"}, {model.element(i, j), "S1"});
      if (j > 0) look({model.element(i, j - 1), "S2"}, {model.element(i, j), "S4"});
    }
  return faces;
}

/// The faces in contact: CalculiX's face-to-face penalty contact.
void write_contacts(const FiniteElementModel& model, Text text) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const FiniteElementContact& contact = model.contacts[k];
    const auto faces = faces_between(model, contact.body, contact.other);
    if (faces.empty()) continue;
    const auto write_face = [&](const ElementFace& face) {
      fmt::format_to(text, "{},{}\n", face.element + 1, face.name);
    };
    fmt::format_to(text, "*SURFACE,NAME=OWN{},TYPE=ELEMENT\n", k);
    for (const auto& [own, other] : faces) write_face(own);
    fmt::format_to(text, "*SURFACE,NAME=OTHER{},TYPE=ELEMENT\n", k);
    for (const auto& [own, other] : faces) write_face(other);
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

void write_loads(const FiniteElementModel& model, double share, Text text) {
  fmt::format_to(text, "*DLOAD\n");
  if (model.acceleration > 0.0)
    fmt::format_to(text, "ELEMENTS,GRAV,{:.12g},0.,1.,0.\n", share * model.acceleration);
  const auto press = [&](int element, const char* face, double pressure) {
    fmt::format_to(text, "{},{},{:.12g}\n", element + 1, face, share * pressure * pascal);
  };
  if (model.base_pressure > 0.0)
    for (int j = 0; j < model.rows(); ++j)
      press(model.element(model.columns() - 1, j), "P3", model.base_pressure);
  if (model.bore_pressure > 0.0)
    for (int i = 0; i < model.columns(); ++i) press(model.element(i, 0), "P4", model.bore_pressure);
}

/// A step that raises the load to a share of the whole, in increments of at most a part of the step; only the
/// last one is printed.
void write_step(const FiniteElementModel& model, double share, double increment, Text text) {
  fmt::format_to(text, "*STEP,NLGEOM,INC=1000\n*STATIC\n{},1.,1e-5,{}\n", increment, increment);
  // The charge slides by 100 um at the nose and by less than 1 um on the base: CalculiX's default tolerances
  // of forces (0.5 %) and displacements (1 % of the largest) would exceed the differences to be measured.
  if (!model.contacts.empty()) fmt::format_to(text, "*CONTROLS,PARAMETERS=FIELD\n1e-4,1e-5,,,1e-4\n");
  write_loads(model, share, text);
  fmt::format_to(text, "*EL PRINT,ELSET=ELEMENTS,FREQUENCY=1000\nS\n*END STEP\n");
}

bool may_yield(const FiniteElementModel& model) {
  return std::any_of(model.materials.begin(), model.materials.end(),
                     [](const FiniteElementMaterial& material) { return !material.hardening.empty(); });
}

std::vector<double> halved(const std::vector<double>& edges) {
  std::vector<double> finer{edges.front()};
  for (std::size_t k = 1; k < edges.size(); ++k) {
    finer.push_back(0.5 * (edges[k - 1] + edges[k]));
    finer.push_back(edges[k]);
  }
  return finer;
}

}  // namespace

const FiniteElementContact* FiniteElementModel::contact_between(int a, int b) const {
  for (const FiniteElementContact& contact : contacts)
    if ((contact.body == a && contact.other == b) || (contact.body == b && contact.other == a))
      return &contact;
  return nullptr;
}

IntegrationPoint integration_point(const FiniteElementModel& model, int element, int point) {
  const auto i = static_cast<std::size_t>(element % model.columns()),
             j = static_cast<std::size_t>(element / model.columns());
  const double half_x = 0.5 * (model.edges_x[i + 1] - model.edges_x[i]),
               half_r = 0.5 * (model.edges_r[j + 1] - model.edges_r[j]);
  const double gauss = 1.0 / std::sqrt(3.0);
  const double x = model.edges_x[i] + half_x * (point / 2 == 0 ? 1.0 - gauss : 1.0 + gauss);
  const double r = model.edges_r[j] + half_r * (point % 2 == 0 ? 1.0 - gauss : 1.0 + gauss);
  return {x, r, r * half_x * half_r};
}

std::vector<double> graded_edges(double begin, double end, double first, double last) {
  const double length = end - begin;
  // Distances that grow in proportion to the way: d = first + (last - first) s/length, and the number of
  // elements is the integral of ds/d.
  const double ratio = last / first;
  const bool uniform = std::abs(ratio - 1.0) < 1e-9;
  const double count = uniform ? length / first : length * std::log(ratio) / (last - first);
  const int parts = std::max(1, static_cast<int>(std::ceil(count - 1e-9)));
  std::vector<double> edges;
  for (int k = 0; k < parts; ++k) {
    const double share = static_cast<double>(k) / parts;
    edges.push_back(begin + length * (uniform ? share : std::expm1(share * std::log(ratio)) / (ratio - 1.0)));
  }
  edges.push_back(end);
  return edges;
}

FiniteElementModel refined(const FiniteElementModel& model) {
  FiniteElementModel finer = model;
  finer.edges_x = halved(model.edges_x);
  finer.edges_r = halved(model.edges_r);
  const auto refine = [&](std::vector<int>& of_element) {
    if (of_element.empty()) return;
    const std::vector<int> coarse = std::exchange(of_element, {});
    for (int j = 0; j < finer.rows(); ++j)
      for (int i = 0; i < finer.columns(); ++i)
        of_element.push_back(coarse[static_cast<std::size_t>(model.element(i / 2, j / 2))]);
  };
  refine(finer.material_of);
  refine(finer.body_of);
  return finer;
}

std::string deck_of(const FiniteElementModel& model) {
  std::string deck;
  const NodeLattice nodes(model);
  const Text text = std::back_inserter(deck);
  write_nodes(model, nodes, text);
  write_elements(model, nodes, text);
  write_materials(model, text);
  write_supports(model, nodes, text);
  write_contacts(model, text);
  // Little yields under the first half of the load.
  const bool yields = may_yield(model);
  if (yields) write_step(model, 0.5, 0.25, text);
  write_step(model, 1.0, yields ? 2.0 * model.increment : model.contacts.empty() ? 0.2 : 1.0, text);
  return deck;
}

}  // namespace launchsafe::verify

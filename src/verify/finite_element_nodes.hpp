// Numbers of the nodes in a finite element deck, and the deck's faces that are in contact.
#pragma once

#include "launchsafe/verify/finite_element_deck.hpp"

#include <iterator>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// Decks are in m, s and MPa, hence units of mass of 1000 t: a compressibility as small as steel's is in
/// 1/Pa, CalculiX 2.20 takes for none, and puts one of its own in its place.
inline constexpr double pascal = 1.0 / deck_stress_unit;

using Text = std::back_insert_iterator<std::string>;

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

/// The faces in contact and how they hold each other.
void write_contacts(const FiniteElementModel& model, Text text);

}  // namespace launchsafe::verify

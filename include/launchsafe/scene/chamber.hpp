// Which surfaces of the shell face the chamber: its gas fills all that is open towards it, up to the driving
// band.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

enum class BodySide { x_begin, x_end, r_begin, r_end };

/// A part of a body's surface that the chamber pressure acts on.
struct ChamberFace {
  std::size_t body = 0;  ///< index into Scene::bodies
  BodySide side = BodySide::x_end;
  double begin = 0, end = 0;  ///< m: radii of a face across x, places along x of a side

  bool across_x() const { return side == BodySide::x_begin || side == BodySide::x_end; }
  /// Of the force of a pressure on it, along x or r.
  double direction() const { return side == BodySide::x_end || side == BodySide::r_end ? -1.0 : 1.0; }
};

struct Chamber {
  std::vector<ChamberFace> faces;  ///< in the order of the bodies, each from its begin on
  double band = 0;                 ///< m, base-side end of the ring of full radius that seals the chamber
  /// What the drawing leaves open, for people, and files are refused for; empty where it is clear. Otherwise
  /// the rearmost faces alone are loaded.
  std::string unclear;
};

/// Gas fills what is open towards the base, and what lies between the barrel and a shell of less than the
/// full radius behind the band. The band is at `Load::obturation`, or at the foremost ring of full radius.
/// What has the full radius lies against the barrel. Nothing without bodies.
Chamber chamber_of(const Scene& scene);

/// Whether the chamber pressure acts on the rearmost faces alone, as on a flat base of full radius.
bool acts_on_rear_alone(const Scene& scene, const Chamber& chamber);

/// For people: area and force along x at a pressure (Pa), and how much that is of pi R^2 p.
std::string chamber_text(const Scene& scene, double pressure);

}  // namespace launchsafe::scene

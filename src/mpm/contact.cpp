#include "launchsafe/mpm/contact.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::mpm {
namespace {

/// Faces are paired anew once they have slid by this part of their shortest cell, or after so many steps:
/// until then shares and normals stay as they are.
constexpr double pairing_slide = 5e-3;
constexpr int pairing_steps = 128;

/// Sweeps over all rows end when no impulse changed by more than this part of the largest one, or after so
/// many. What they leave, the next step begins with: gaps remember it, and launches with one sweep and with
/// eight agree to six digits.
constexpr double settled = 1e-2;
constexpr int most_sweeps = 2;

/// Part of an overlap, which only pairing anew can make, that a step takes back: all at once would be a blow.
/// And at most this part of the shortest cell, which is about this part of the speed of sound: where a face
/// that bulged out past the other one's end is driven back over it, overlaps are as large as the bulge.
constexpr double overlap_taken_back = 0.1, most_taken_back = 1e-4;

}  // namespace

void Contact::restart(const std::vector<Nodes>& nodes) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Tie::Member& m = members_[points_[p].first_member];
    before_[p] = {nodes[m.nodes].velocity_x[m.index], nodes[m.nodes].velocity_r[m.index]};
    impulse_[p] = {0.0, 0.0};
  }
  pair(nodes);
  last_dt_ = 0.0;
  for (Row& row : rows_) {
    row.normal = row.slide = row.last_slide = 0.0;
  }
}

ContactTotals Contact::act(std::vector<Nodes>& nodes, double dt, double keep) {
  keep_before_ = keep_;
  keep_ = keep;
  read_nodes(nodes);
  exchange();
  press(dt);
  const ContactTotals totals = write_nodes(nodes, dt);
  ++steps_;
  settle_rows(dt);
  if (slid_ > pairing_slide * shortest_cell_ || steps_ >= pairing_steps) pair(nodes);
  last_dt_ = dt;
  return totals;
}

/// How far (m) faces with a gap must open in a step.
double Contact::least_opening(double gap) const {
  return gap > 0.0 ? -gap : std::min(-overlap_taken_back * gap, most_taken_back * shortest_cell_);
}

Contact::Velocity Contact::relative(const Row& row, const std::vector<Velocity>& velocity) const {
  Velocity v{0.0, 0.0};
  for (std::size_t s = row.begin; s < row.end; ++s) {
    v.x += shares_[s].share * velocity[shares_[s].point].x;
    v.r += shares_[s].share * velocity[shares_[s].point].r;
  }
  return v;
}

void Contact::set_speeds(Row& row) const {
  const Velocity v = relative(row, before_);
  row.opening = v.x * row.normal_x + v.r * row.normal_r;
  row.sliding = v.r * row.normal_x - v.x * row.normal_r;
}

Contact::Velocity Contact::impulse(const Row& row, double normal, double slide) const {
  return {normal * row.normal_x - slide * row.normal_r, normal * row.normal_r + slide * row.normal_x};
}

/// Gives the row's points an impulse along its normal and one along the face.
void Contact::push(const Row& row, double normal, double slide) {
  const Velocity j = impulse(row, normal, slide);
  for (std::size_t s = row.begin; s < row.end; ++s) {
    const std::size_t p = shares_[s].point;
    velocity_[p].x += shares_[s].share * j.x * mobility_[p].x;
    velocity_[p].r += shares_[s].share * j.r * mobility_[p].r;
  }
}

/// The same for the momentum that came back from the particles, also where the nodes are held along r.
void Contact::hand_over(const Row& row, double normal, double slide) {
  const Velocity j = impulse(row, normal, slide);
  for (std::size_t s = row.begin; s < row.end; ++s) {
    const std::size_t p = shares_[s].point;
    matched_[p].x += shares_[s].share * j.x * mobility_[p].x;
    matched_[p].r += shares_[s].share * j.r * mobility_[p].x;
  }
}

void Contact::read_nodes(const std::vector<Nodes>& nodes) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Tie::Member& m = members_[points_[p].first_member];
    const Nodes& n = nodes[m.nodes];
    free_[p] = {n.velocity_x[m.index], n.velocity_r[m.index]};
    brought_[p] = {free_[p].x - n.change_x[m.index], free_[p].r - n.change_r[m.index]};
  }
}

/// Makes the velocities that came back from the particles agree where faces are bonded. Bonded nodes
/// coincide, so that one sweep does.
void Contact::exchange() {
  matched_ = brought_;
  if (!has_bonds_) return;
  for (const Row& row : rows_) {
    if (!row.bonded) continue;
    const Velocity v = relative(row, matched_);
    hand_over(row, -(v.x * row.normal_x + v.r * row.normal_r) * row.inertia,
              -(v.r * row.normal_x - v.x * row.normal_r) * row.inertia);
  }
}

/// Finds the impulses, from those of the last step on.
void Contact::press(double dt) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const double moves_r = mobility_[p].r > 0.0 ? 1.0 : 0.0;
    start_[p] = {free_[p].x + keep_ * (matched_[p].x - brought_[p].x),
                 free_[p].r + keep_ * moves_r * (matched_[p].r - brought_[p].r)};
  }
  const double longer = last_dt_ > 0.0 ? dt / last_dt_ : 0.0;
  // The same impulses on the same pairs as in the last step, which are known by point.
  const bool same_pairs = steps_ > 0;
  const double begin = same_pairs ? longer : 0.0;
  for (std::size_t p = 0; p < points_.size(); ++p)
    velocity_[p] = {start_[p].x + begin * impulse_[p].x * mobility_[p].x,
                    start_[p].r + begin * impulse_[p].r * mobility_[p].r};
  for (Row& row : rows_) {
    row.last_slide = row.slide;
    row.normal *= longer;
    row.slide *= longer;
    row.target = row.bonded ? 0.0 : least_opening(row.gap) / dt;
    if (!same_pairs) push(row, row.normal, row.slide);
  }
  const auto settle = [&] {
    for (int count = 0; count < most_sweeps; ++count)
      if (sweep() <= settled) return;
  };
  settle();
  while (has_bonds_ && break_bonds(dt)) settle();
}

/// One pass over all rows; the largest change of an impulse over the largest impulse.
double Contact::sweep() {
  double changed = 0.0, largest = 0.0;
  for (Row& row : rows_) {
    const Velocity v = relative(row, velocity_);
    const double opening = v.x * row.normal_x + v.r * row.normal_r;
    if (!row.bonded && row.normal <= 0.0 && opening >= row.target) continue;
    const double sliding = v.r * row.normal_x - v.x * row.normal_r;
    double normal = row.normal - (opening - row.target) * row.normal_inertia;
    double slide = row.slide - sliding * row.slide_inertia;
    if (!row.bonded) {
      normal = std::max(normal, 0.0);
      const double limit = row.friction * normal;
      slide = std::clamp(slide, -limit, limit);
    }
    const double more_normal = normal - row.normal, more_slide = slide - row.slide;
    push(row, more_normal, more_slide);
    row.normal = normal;
    row.slide = slide;
    changed = std::max(changed, std::abs(more_normal) + std::abs(more_slide));
    largest = std::max(largest, std::abs(normal) + std::abs(slide));
  }
  return changed > 0.0 ? changed / largest : 0.0;
}

/// Ends bonds whose traction is past a strength; whether there were any.
bool Contact::break_bonds(double dt) {
  bool any = false;
  for (Row& row : rows_) {
    if (!row.bonded || !(row.area > 0.0)) continue;
    const double unit = row.area * dt * keep_;
    if (-row.normal <= row.tension_strength * unit && std::abs(row.slide) <= row.shear_strength * unit)
      continue;
    any = true;
    row.bonded = false;
    row.target = least_opening(row.gap) / dt;
    const double normal = std::max(row.normal, 0.0), limit = row.friction * normal;
    const double slide = std::clamp(row.slide, -limit, limit);
    push(row, normal - row.normal, slide - row.slide);
    row.normal = normal;
    row.slide = slide;
  }
  return any;
}

ContactTotals Contact::write_nodes(std::vector<Nodes>& nodes, double dt) {
  ContactTotals totals;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    const Velocity v = velocity_[p], more{v.x - free_[p].x, v.r - free_[p].r};
    const Velocity before = before_[p];
    const Velocity impulse{point.inertia * (v.x - start_[p].x), point.inertia * (v.r - start_[p].r)};
    const Velocity change{v.x - matched_[p].x, v.r - matched_[p].r};
    const Velocity free_change{free_[p].x - brought_[p].x, free_[p].r - brought_[p].r};
    // Impulses count as if damping came after them: J/keep each, of which this step's damping takes its part.
    const double old_work = impulse_[p].x * before.x + impulse_[p].r * before.r;
    const double work = impulse.x * before.x + impulse.r * before.r;
    totals.loss -= 0.5 * (old_work / keep_before_ + work / keep_);
    totals.way_back_loss += 0.5 * work * (1.0 / keep_ - 1.0);
    totals.way_back_loss += 0.5 * point.inertia *
                            ((change.x - free_change.x) * (before.x - brought_[p].x) +
                             (change.r - free_change.r) * (before.r - brought_[p].r));
    totals.momentum += point.mass * more.x;
    impulse_[p] = impulse;
    before_[p] = v;
    for (std::size_t k = point.first_member; k < point.end_member; ++k) {
      Nodes& n = nodes[members_[k].nodes];
      const std::size_t i = members_[k].index;
      n.velocity_x[i] = v.x;
      n.velocity_r[i] = v.r;
      n.change_x[i] = change.x;
      n.change_r[i] = change.r;
      n.displacement_x[i] += dt * more.x;
      n.displacement_r[i] += dt * more.r;
    }
  }
  return totals;
}

/// Takes the rows to the end of the step.
void Contact::settle_rows(double dt) {
  double fastest = 0.0;
  for (Row& row : rows_) {
    row.friction_work -= 0.5 * (row.last_slide / keep_before_ + row.slide / keep_) * row.sliding;
    set_speeds(row);
    row.gap += dt * row.opening;
    fastest = std::max(fastest, std::abs(row.sliding));
  }
  slid_ += dt * fastest;
}

double Contact::friction_work(std::size_t face) const {
  double work = 0.0;
  for (std::size_t i = 0; i < faces_[face].own.indices.size(); ++i)
    work += rows_[faces_[face].first_row + i].friction_work;
  return work;
}

std::vector<FaceState> Contact::state_of(std::size_t face) const {
  const Face& f = faces_[face];
  const double direction = f.along_x ? -f.outward : f.outward;
  std::vector<FaceState> states;
  for (std::size_t i = 0; i < f.own.indices.size(); ++i) {
    const Row& row = rows_[f.first_row + i];
    const double per_impulse = row.area > 0.0 && last_dt_ > 0.0 ? 1.0 / (row.area * last_dt_ * keep_) : 0.0;
    FaceState state;
    state.place = f.own.rest[i];
    state.area = row.area;
    state.gap = row.gap;
    state.pressure = row.normal * per_impulse;
    state.shear = direction * row.slide * per_impulse;
    state.sliding_speed = direction * row.sliding;
    state.friction_heat = row.area > 0.0 ? row.friction_work / row.area : 0.0;
    state.bonded = row.bonded;
    states.push_back(state);
  }
  return states;
}

}  // namespace launchsafe::mpm

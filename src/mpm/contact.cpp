#include "launchsafe/mpm/contact.hpp"

namespace launchsafe::mpm {
namespace {

/// Faces are paired anew once they have slid by this part of their shortest cell, or after so many steps:
/// until then shares and normals stay as they are.
constexpr double pairing_slide = 5e-3;
constexpr int pairing_steps = 128;

/// Sweeps over all rows end when no impulse changed by more than this part of the largest one, or after so
/// many. The residual enters the gaps, from which the next step begins; launches with one sweep and with
/// eight agree to six digits.
constexpr double settled = 1e-2;
constexpr int most_sweeps = 2;

/// Part of an overlap that one step removes; overlaps arise at a new pairing only. Removing all of it in one
/// step would give the nodes the velocity overlap/dt. The length removed is also at most this part of the
/// shortest cell, which limits the velocity to about this part of the speed of sound: where a face that
/// bulged past the end of the other one is pushed back over it, overlaps are as large as the bulge.
constexpr double overlap_taken_back = 0.1, most_taken_back = 1e-4;

}  // namespace

void Contact::reset(const std::vector<Nodes>& nodes) {
  impulse_.resize(points_);
  for (const Member& m : members_) {
    before_.x(m.point) = nodes[m.nodes].velocity_x[m.index];
    before_.r(m.point) = nodes[m.nodes].velocity_r[m.index];
  }
  pair(nodes);
  last_dt_ = 0.0;
  damping_factor_ = 1.0;
  for (Row& row : rows_) row.normal = row.slide = 0.0;
}

ContactTotals Contact::act(std::vector<Nodes>& nodes, const StepInput& step) {
  const double dt = step.dt;
  damping_factor_before_ = damping_factor_;
  damping_factor_ = step.damping_factor;
  read_nodes(nodes);
  solve_impulses(dt);
  const ContactTotals totals = add_up_energy();
  write_nodes(nodes, dt);
  ++steps_;
  advance_rows(dt);
  if (slid_ > pairing_slide * shortest_cell_ || steps_ >= pairing_steps) pair(nodes);
  last_dt_ = dt;
  return totals;
}

/// How far (m) faces with a gap must open in a step.
double Contact::least_opening(double gap) const {
  return gap > 0.0 ? -gap : std::min(-overlap_taken_back * gap, most_taken_back * shortest_cell_);
}

Contact::Velocity Contact::relative(const Row& row, const Field& velocity) const {
  Velocity v{0.0, 0.0};
  for (std::size_t s = row.begin; s < row.end; ++s) {
    v.x += shares_[s].share * velocity.x(shares_[s].point);
    v.r += shares_[s].share * velocity.r(shares_[s].point);
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
    const Share& each = shares_[s];
    velocity_.x(each.point) += each.give_x * j.x;
    velocity_.r(each.point) += each.give_r * j.r;
  }
}

void Contact::read_nodes(const std::vector<Nodes>& nodes) {
  for (const Member& m : members_) {
    const Nodes& n = nodes[m.nodes];
    const double x = n.velocity_x[m.index], r = n.velocity_r[m.index];
    free_velocity_.x(m.point) = x;
    free_velocity_.r(m.point) = r;
    particle_velocity_.x(m.point) = x - n.velocity_increment_x[m.index];
    particle_velocity_.r(m.point) = r - n.velocity_increment_r[m.index];
  }
}

/// Begins with the last step's impulses on all points: where the pairs are the same, the rows' are known
/// there.
void Contact::begin_impulses(double step_ratio) {
  for (std::size_t i = 0; i < velocity_.size(); i += math::pack_width)
    velocity_.store(i, free_velocity_.load(i) + step_ratio * impulse_.load(i) * mobility_.load(i));
}

/// Finds the impulses, from those of the last step on.
void Contact::solve_impulses(double dt) {
  const double step_ratio = last_dt_ > 0.0 ? dt / last_dt_ : 0.0;
  const bool same_pairs = steps_ > 0;
  begin_impulses(same_pairs ? step_ratio : 0.0);
  for (Row& row : rows_) {
    row.normal *= step_ratio;
    row.slide *= step_ratio;
    row.target = least_opening(row.gap) / dt;
    if (!same_pairs) push(row, row.normal, row.slide);
  }
  for (int count = 0; count < most_sweeps; ++count)
    if (sweep() <= settled) return;
}

/// One pass over all rows; the largest change of an impulse over the largest impulse.
double Contact::sweep() {
  double changed = 0.0, largest = 0.0;
  for (Row& row : rows_) {
    const Velocity v = relative(row, velocity_);
    const double opening = v.x * row.normal_x + v.r * row.normal_r;
    if (row.normal == 0.0 && opening >= row.target) continue;
    const double sliding = v.r * row.normal_x - v.x * row.normal_r;
    const double normal = std::max(row.normal - (opening - row.target) * row.normal_inertia, 0.0);
    const double limit = row.friction * normal;
    const double slide = std::clamp(row.slide - sliding * row.slide_inertia, -limit, limit);
    const double more_normal = normal - row.normal, more_slide = slide - row.slide;
    push(row, more_normal, more_slide);
    row.normal = normal;
    row.slide = slide;
    changed = std::max(changed, std::abs(more_normal) + std::abs(more_slide));
    largest = std::max(largest, std::abs(normal) + std::abs(slide));
  }
  return changed > 0.0 ? changed / largest : 0.0;
}

/// What the impulses took out of the energies.
ContactTotals Contact::add_up_energy() {
  Pack loss(0.0), damping(0.0), way_back(0.0), momentum(0.0);
  for (std::size_t i = 0; i < velocity_.size(); i += math::pack_width) {
    const Pack inertia = inertia_.load(i), v = velocity_.load(i), before = before_.load(i);
    const Pack brought = particle_velocity_.load(i), free = free_velocity_.load(i);
    const Pack more = v - free, impulse = inertia * more;
    const Pack work = impulse * before;
    // Impulses count as if damping came after them: J over the damping factor each, of which this step's
    // damping takes its part.
    loss += (0.5 / damping_factor_before_) * (impulse_.load(i) * before) + (0.5 / damping_factor_) * work;
    damping += work;
    way_back += impulse * (before - brought);
    momentum += mass_.load(i) * more;
    impulse_.store(i, impulse);
    before_.store(i, v);
  }
  return {-sum(loss), 0.5 * (sum(way_back) + (1.0 / damping_factor_ - 1.0) * sum(damping)), sum(momentum)};
}

void Contact::write_nodes(std::vector<Nodes>& nodes, double dt) const {
  for (const Member& m : members_) {
    Nodes& n = nodes[m.nodes];
    const std::size_t i = m.index, p = m.point;
    const double x = velocity_.x(p), r = velocity_.r(p);
    n.velocity_x[i] = x;
    n.velocity_r[i] = r;
    n.velocity_increment_x[i] = x - particle_velocity_.x(p);
    n.velocity_increment_r[i] = r - particle_velocity_.r(p);
    n.displacement_x[i] += dt * (x - free_velocity_.x(p));
    n.displacement_r[i] += dt * (r - free_velocity_.r(p));
  }
}

/// Takes the rows to the end of the step.
void Contact::advance_rows(double dt) {
  double fastest = 0.0;
  for (Row& row : rows_) {
    if (!(row.area > 0.0)) continue;
    set_speeds(row);
    row.gap += dt * row.opening;
    row.overlap = std::max(row.overlap, -row.gap);
    row.slip += dt * row.sliding;
    fastest = std::max(fastest, std::abs(row.sliding));
  }
  slid_ += dt * fastest;
}

std::vector<FaceState> Contact::state_of(std::size_t face, const std::vector<Nodes>& nodes) const {
  const Face& f = faces_[face];
  const Nodes& own = nodes[f.own.nodes];
  const double direction = f.along_x ? -f.outward : f.outward;
  std::vector<FaceState> states;
  for (std::size_t i = 0; i < f.own.indices.size(); ++i) {
    const Row& row = rows_[f.first_row + i];
    const double per_impulse =
        row.area > 0.0 && last_dt_ > 0.0 ? 1.0 / (row.area * last_dt_ * damping_factor_) : 0.0;
    const double along = f.own.rest[i], across = f.own.across_rest;
    states.push_back({along, (f.along_x ? along : across) + own.displacement_x[f.own.indices[i]],
                      (f.along_x ? across : along) + own.displacement_r[f.own.indices[i]], row.area, row.gap,
                      row.normal * per_impulse, direction * row.slide * per_impulse, direction * row.slip,
                      row.overlap});
  }
  return states;
}

}  // namespace launchsafe::mpm

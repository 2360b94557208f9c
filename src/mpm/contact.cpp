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
  last_dt_ = last_kick_ = 0.0;
  damping_factor_ = 1.0;
  for (Row& row : rows_) row.normal = row.slide = row.from_gas = row.last_slide = row.last_from_gas = 0.0;
}

ContactTotals Contact::act(std::vector<Nodes>& nodes, const StepInput& step) {
  const double dt = step.dt;
  kick_ = step.kick;
  damping_factor_before_ = damping_factor_;
  damping_factor_ = step.damping_factor;
  read_nodes(nodes);
  exchange_momentum();
  solve_impulses(dt);
  const double change = change_of_step(step);
  ContactTotals totals = add_up_energy();
  totals.step_change = change;
  write_nodes(nodes, dt);
  ++steps_;
  advance_rows(dt);
  if (slid_ > pairing_slide * shortest_cell_ || steps_ >= pairing_steps) pair(nodes);
  last_dt_ = dt;
  last_kick_ = kick_;
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

/// Makes the velocities summed from the particles agree where faces are bonded. Bonded nodes
/// coincide, so that one sweep does.
void Contact::exchange_momentum() {
  exchanged_velocity_ = particle_velocity_;
  if (!has_bonds_) return;
  for (const Row& row : rows_) {
    if (!row.bonded) continue;
    const Velocity v = relative(row, exchanged_velocity_);
    const Velocity j = impulse(row, -(v.x * row.normal_x + v.r * row.normal_r) * row.free_normal_inertia,
                               -(v.r * row.normal_x - v.x * row.normal_r) * row.free_slide_inertia);
    // Also where the nodes are held along r.
    for (std::size_t s = row.begin; s < row.end; ++s) {
      exchanged_velocity_.x(shares_[s].point) += shares_[s].give_x * j.x;
      exchanged_velocity_.r(shares_[s].point) += shares_[s].free_r * j.r;
    }
  }
}

/// Begins with the last step's impulses on all points: where the pairs are the same, the rows' are known
/// there.
void Contact::begin_impulses(double step_ratio) {
  for (std::size_t i = 0; i < start_.size(); i += math::pack_width) {
    const Pack exchanged =
        damping_factor_ * unconstrained_.load(i) * (exchanged_velocity_.load(i) - particle_velocity_.load(i));
    const Pack start = free_velocity_.load(i) + exchanged;
    start_.store(i, start);
    velocity_.store(i, start + step_ratio * impulse_.load(i) * mobility_.load(i));
  }
}

/// Finds the impulses, from those of the last step on.
void Contact::solve_impulses(double dt) {
  const double step_ratio = last_kick_ > 0.0 ? kick_ / last_kick_ : 0.0;
  const bool same_pairs = steps_ > 0;
  begin_impulses(same_pairs ? step_ratio : 0.0);
  for (Row& row : rows_) {
    row.last_slide = row.slide;
    row.last_from_gas = row.from_gas;
    row.normal *= step_ratio;
    row.from_gas *= step_ratio;
    row.slide *= step_ratio;
    row.target = row.bonded ? 0.0 : least_opening(row.gap) / dt;
    if (!same_pairs) push(row, row.normal, row.slide);
  }
  const auto settle = [&] {
    for (int count = 0; count < most_sweeps; ++count)
      if (sweep(dt) <= settled) return;
  };
  settle();
  while (has_bonds_ && break_bonds(dt)) settle();
}

/// kg m/s, of a row's gas in a step at whose end the faces part with a speed (m/s). As forces do, it acts
/// before damping.
double Contact::gas_impulse(const Row& row, double speed, double dt) const {
  const double mean = row.gap + row.floor + 0.25 * (dt * speed - last_dt_ * row.opening);
  return (row.gas.at(mean) - row.gas.outside) * row.area * kick_ * damping_factor_;
}

/// The impulse of a row's gas where the faces would part with a speed (m/s) without it: that of the speed v
/// at which v = speed + impulse(v)/inertia. The right side falls with v, so there is one; Newton's method,
/// and bisection where it leaves the interval in which that lies.
double Contact::push_by_gas(const Row& row, double speed, double dt) const {
  constexpr double exact = 1e-12;
  constexpr int most = 100;
  const double mobility = 1.0 / row.normal_inertia,
               suction = row.gas.outside * row.area * kick_ * damping_factor_;
  const double free = row.gap + row.floor - row.gas.covolume - 0.25 * last_dt_ * row.opening;
  // Between the larger of the speeds that close the covolume and that the strongest suction leaves, and none.
  double low = std::max(-4.0 * free / dt, speed - mobility * suction);
  double high = std::numeric_limits<double>::infinity(), reach = 4.0 * std::abs(free) / dt;
  double v = speed + mobility * row.from_gas;
  if (!(v > low)) v = low + reach;
  double impulse = gas_impulse(row, v, dt);
  for (int count = 0; count < most; ++count) {
    const double excess = v - speed - mobility * impulse;
    if (std::abs(excess) <= exact * (std::abs(v) + std::abs(speed))) break;
    (excess < 0.0 ? low : high) = v;
    const double stiffness = row.gas.exponent * (impulse + suction) / (free + 0.25 * dt * v);
    double next = v - excess / (1.0 + 0.25 * dt * mobility * stiffness);
    if (!(next > low && next < high)) next = std::isfinite(high) ? 0.5 * (low + high) : low + (reach *= 2.0);
    if (!(next > low && next < high)) break;  // neighbouring numbers
    v = next;
    impulse = gas_impulse(row, v, dt);
  }
  return impulse;
}

/// The impulses of the gas that rows share, which has one pressure: that of a row with their mean opening and
/// speed. An impulse moves that as far as all of them, divided by their areas, move the mean.
void Contact::push_by_common_gas(double dt) {
  Row all;
  double speed = 0.0, mobility = 0.0;
  for (const Row& row : rows_)
    if (row.floor > 0.0) all.area += row.area;
  for (const Row& row : rows_) {
    if (!(row.floor > 0.0)) continue;
    const Velocity v = relative(row, velocity_);
    const double part = row.area / all.area;
    all.gap += part * (row.gap + row.floor);
    all.opening += part * row.opening;
    all.from_gas += row.from_gas;
    speed += part * (v.x * row.normal_x + v.r * row.normal_r);
    if (!shares_gas(row)) continue;
    speed -= part * row.normal / row.normal_inertia;
    mobility += part * part / row.normal_inertia;
  }
  if (!(mobility > 0.0)) return;
  all.gas = common_gas_;
  all.normal_inertia = 1.0 / mobility;
  const double impulse = push_by_gas(all, speed, dt);
  for (Row& row : rows_)
    if (shares_gas(row)) row.from_gas = impulse * row.area / all.area;
}

/// One pass over all rows; the largest change of an impulse over the largest impulse.
double Contact::sweep(double dt) {
  double changed = 0.0, largest = 0.0;
  if (common_gas_.pressure > 0.0) push_by_common_gas(dt);
  for (Row& row : rows_) {
    const Velocity v = relative(row, velocity_);
    const double opening = v.x * row.normal_x + v.r * row.normal_r;
    const bool own_gas = row.gas.pressure > 0.0 && row.normal_inertia > 0.0;
    const bool has_gas = own_gas || shares_gas(row);
    if (own_gas) row.from_gas = push_by_gas(row, opening - row.normal / row.normal_inertia, dt);
    if (!has_gas && !row.bonded && !row.held && row.normal == 0.0 && opening >= row.target) continue;
    const double sliding = v.r * row.normal_x - v.x * row.normal_r;
    double normal = row.normal - (opening - row.target) * row.normal_inertia;
    double slide = row.slide - sliding * row.slide_inertia;
    if (!row.bonded) {
      normal = std::max(normal, row.from_gas);
      double limit = row.friction * (normal - row.from_gas);
      if (row.held) {
        const double unit = row.area * kick_ * damping_factor_;
        limit = std::max(limit, row.shear_strength * unit);
        const double stop = row.normal - opening * row.normal_inertia;
        if (stop < 0.0) normal = std::max(stop, -row.tension_strength * unit);
      }
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

/// Ends bonds whose traction is past a strength; whether there were any. The traction of one step decides,
/// not a mean: while bonds hold, it oscillates little (on the 155 mm launch its largest values are those of a
/// mean over the time sound takes through ten cells, to 0.1 % for shear), and where bonds break in
/// succession, the next one is broken by the wave of the stress that the last one released. Half the time
/// step moves the end of the broken part by a node at base and wall. The strengths say nothing of toughness:
/// at a corner, where stress grows without bound, finer cells break earlier.
bool Contact::break_bonds(double dt) {
  bool any = false;
  for (Row& row : rows_) {
    if (!row.bonded || !(row.area > 0.0)) continue;
    const double unit = row.area * kick_ * damping_factor_;
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

/// Of what TotalLagrangian::change_of_step counts, the part of contact, whose impulses do all of their work.
double Contact::change_of_step(const StepInput& step) const {
  if (!step.changes()) return 0.0;
  Pack work(0.0);
  for (std::size_t i = 0; i < impulse_.size(); i += math::pack_width)
    work += impulse_.load(i) * before_.load(i);
  return -0.5 * step.share_beyond(step.kick_before) / damping_factor_before_ * sum(work);
}

/// What the impulses took out of the energies.
ContactTotals Contact::add_up_energy() {
  Pack loss(0.0), damping(0.0), way_back(0.0), momentum(0.0);
  for (std::size_t i = 0; i < velocity_.size(); i += math::pack_width) {
    const Pack inertia = inertia_.load(i), v = velocity_.load(i), before = before_.load(i);
    const Pack brought = particle_velocity_.load(i), free = free_velocity_.load(i);
    const Pack impulse = inertia * (v - start_.load(i)), more = v - free;
    const Pack work = impulse * before;
    // Impulses count as if damping came after them: J over the damping factor each, of which this step's
    // damping takes its part.
    loss += (0.5 / damping_factor_before_) * (impulse_.load(i) * before) + (0.5 / damping_factor_) * work;
    damping += work;
    way_back += inertia * (more + brought - exchanged_velocity_.load(i)) * (before - brought);
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
    n.velocity_increment_x[i] = x - exchanged_velocity_.x(p);
    n.velocity_increment_r[i] = r - exchanged_velocity_.r(p);
    n.displacement_x[i] += dt * (x - free_velocity_.x(p));
    n.displacement_r[i] += dt * (r - free_velocity_.r(p));
  }
}

/// Takes the rows to the end of the step.
void Contact::advance_rows(double dt) {
  double fastest = 0.0;
  const double mean_before = common_gas_.pressure > 0.0 ? mean_opening() : 0.0;
  for (Row& row : rows_) {
    if (!(row.area > 0.0)) continue;
    const double work =
        -0.5 * (row.last_slide / damping_factor_before_ + row.slide / damping_factor_) * row.sliding;
    row.friction_work += work;
    row.friction_heat += work / row.area;
    row.gas_work -=
        0.5 * (row.last_from_gas / damping_factor_before_ + row.from_gas / damping_factor_) * row.opening;
    set_speeds(row);
    const double before = row.gap + row.floor;
    row.gap += dt * row.opening;
    row.gas.exchange_heat(before, row.gap + row.floor, dt);
    row.largest_gap = std::max(row.largest_gap, row.gap);
    row.overlap = std::max(row.overlap, -row.gap);
    row.slid += dt * std::abs(row.sliding);
    row.slip += dt * row.sliding;
    fastest = std::max(fastest, std::abs(row.sliding));
  }
  slid_ += dt * fastest;
  if (common_gas_.pressure > 0.0) common_gas_.exchange_heat(mean_before, mean_opening(), dt);
}

void Contact::hold(std::size_t face) {
  for (std::size_t i = 0; i < faces_[face].own.indices.size(); ++i) {
    Row& row = rows_[faces_[face].first_row + i];
    if (row.bonded) continue;
    row.bonded = row.held = has_bonds_ = true;
  }
}

void Contact::loosen(double share) {
  for (Row& row : rows_) {
    if (!row.held) continue;
    if (row.bonded) {
      const double unit = row.area * last_kick_ * damping_factor_;
      row.held_tension = unit > 0.0 ? std::max(-row.normal, 0.0) / unit : 0.0;
      row.held_shear = unit > 0.0 ? std::abs(row.slide) / unit : 0.0;
    }
    row.bonded = false;
    row.held = share > 0.0;
    row.tension_strength = share * row.held_tension;
    row.shear_strength = share * row.held_shear;
  }
}

void Contact::part(std::size_t face, double opening, double floor) {
  const Face& f = faces_[face];
  for (std::size_t i = 0; i < f.own.indices.size(); ++i) {
    Row& row = rows_[f.first_row + i];
    row.gap += opening - floor;
    row.parted = opening;
    row.floor = floor;
    row.largest_gap = std::max(row.largest_gap, row.gap);
  }
}

void Contact::set_gas(std::size_t face, std::size_t node, const GapGas& gas) {
  rows_[faces_[face].first_row + node].gas = gas;
}

double Contact::opening(std::size_t face, std::size_t node) const {
  const Row& row = rows_[faces_[face].first_row + node];
  return row.gap + row.floor;
}

double Contact::mean_opening() const {
  double volume = 0.0, area = 0.0;
  for (const Row& row : rows_) {
    if (!(row.floor > 0.0)) continue;
    volume += row.area * (row.gap + row.floor);
    area += row.area;
  }
  return volume / area;
}

double Contact::mean_pressure() const {
  double impulse = 0.0, area = 0.0;
  for (const Row& row : rows_) {
    if (!(row.floor > 0.0)) continue;
    impulse += row.normal;
    area += row.area;
  }
  return last_kick_ > 0.0 ? impulse / (area * last_kick_ * damping_factor_) : 0.0;
}

double Contact::gas_work(std::size_t face, std::size_t node) const {
  const Row& row = rows_[faces_[face].first_row + node];
  return row.area > 0.0 ? row.gas_work / row.area : 0.0;
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
    const double per_impulse =
        row.area > 0.0 && last_kick_ > 0.0 ? 1.0 / (row.area * last_kick_ * damping_factor_) : 0.0;
    states.push_back({f.own.rest[i], row.area, row.gap, row.normal * per_impulse,
                      direction * row.slide * per_impulse, row.friction_heat, row.slid, direction * row.slip,
                      row.largest_gap, row.overlap, row.bonded});
  }
  return states;
}

}  // namespace launchsafe::mpm

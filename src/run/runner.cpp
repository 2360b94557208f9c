#include "runner.hpp"

#include <fmt/format.h>

#include <ctime>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace launchsafe::run {
namespace {

/// Steps between two checks of the stable time step, the stop flag and the energy balance.
constexpr std::uint64_t steps_per_check = 16;
/// A step shorter than this share of the first one means that the state has blown up.
constexpr double collapse_share = 1e-3;

/// Flushes denormals to zero on this thread during its lifetime: they cost a hundred times a normal number
/// and carry nothing here, where relaxing stresses decay through them. Without SSE it does nothing.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() { _mm_setcsr(saved_ | flush_to_zero | denormals_are_zero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  const unsigned saved_ = _mm_getcsr();
#else
  FlushDenormals() {}
#endif
};

/// Processor time (s) that the calling thread has used: other work on the machine does not count.
double thread_processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The first of the times `next`, `next` + `interval`, ... after `time`. Intervals much shorter than a step
/// are as good as none: then it is `time`, which every later step reaches.
double next_time(double next, double interval, double time) {
  constexpr double most_in_a_step = 1000.0;
  if (time - next > most_in_a_step * interval) return time;
  while (next <= time) {
    if (!(next + interval > next)) return time;
    next += interval;
  }
  return next;
}

}  // namespace

Runner::Runner(const scene::Scene& scene, const RunOptions& options, std::optional<double> skin_gap)
    : options_(options),
      simulation_(scene),
      recorder_(simulation_, simulation_.scene()),
      heat_(simulation_),
      skin_gap_(skin_gap) {
  if (skin_gap) surface_.emplace(simulation_.scene(), *skin_gap, recorder_);
  couples_back_ = skin_gap && scene.coupling == scene::Coupling::two_way;
  result_.particles = simulation_.particles();
  simulation_.for_each_body([&](const mpm::ParticleFields& p) {
    add_mass(result_.masses, scene.bodies[static_cast<std::size_t>(p.body)].material, mpm::mass_of(p));
  });
}

void Runner::end_with_snapshot(double time) {
  scene::Scene one = simulation_.scene();
  one.output.snapshot_times = {time};
  one.output.snapshot_events.clear();
  snapshots_ = SnapshotTaker(one);
  ends_with_snapshots_ = true;
}

MechanicsResult Runner::run() {
  const FlushDenormals flush;
  const double processor_start = thread_processor_time();
  first_step_ = time_step_ = simulation_.stable_time_step();
  take_monitor_sample(time_step_);
  take_due_snapshots();
  while (!is_done() && result_.status == RunStatus::completed) {
    if (burning_ || result_.steps % steps_per_check == 0) {
      time_step_ = simulation_.stable_time_step();
      check();
      if (result_.status != RunStatus::completed) break;
    }
    // The last step ends on the duration; the one before shares what is left, so that neither is tiny.
    const double remaining = end_ - simulation_.time();
    const double dt = remaining <= time_step_ ? remaining : std::min(time_step_, 0.5 * remaining);
    check_step(dt);
    if (result_.status == RunStatus::completed) advance(dt);
  }
  take_monitor_sample(time_step_);
  if (result_.status == RunStatus::completed) check_energy(energy_of(simulation_));
  result_.end_time = simulation_.time();
  result_.limiters = count_limited(simulation_);
  result_.interfaces = interfaces_of(simulation_);
  result_.yielded_wall = yielded_wall(simulation_);
  result_.wall_time = seconds_since(start_);
  result_.processor_time = thread_processor_time() - processor_start;
  result_.trace = recorder_.take();
  result_.snapshots = snapshots_.finish();
  return std::move(result_);
}

std::optional<CombustionHistory> Runner::take_combustion(const MechanicsResult& mechanics) {
  if (!burning_) return std::nullopt;
  CombustionHistory history = burning_->take();
  history.end = mechanics.status == RunStatus::completed ? combustion_end_ : CombustionEnd::broke_off;
  history.reason = mechanics.reason;
  history.energy_drift = largest_energy_drift(mechanics);
  history.wall_time = mechanics.wall_time;
  return history;
}

void Runner::take_due_snapshots() {
  if (snapshots_.is_due(simulation_.time()))
    snapshots_.take_due(simulation_.time(), [this] { return snapshot(); });
}

Snapshot Runner::snapshot() const {
  const std::vector<trace::Station>& stations = recorder_.trace().stations;
  Snapshot shot = take_snapshot(simulation_, stations);
  if (!surface_) return shot;
  BottomSkin& skin = shot.skins.emplace_back();
  skin.gap = *skin_gap_;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    if (stations[s].observation) continue;
    skin.temperature.push_back(surface_->temperature(s));
    if (burning_) skin.reaction_degree.push_back(burning_->reaction_degree(s));
  }
  return shot;
}

void Runner::advance(double dt) {
  const scene::Scene& scene = simulation_.scene();
  simulation_.step(dt);
  ++result_.steps;
  if (burning_ && !simulation_.within_gas_law())
    return stop_now(RunStatus::outside_gas_law,
                    "a burning particle is in a state that the virial law of the gas does not cover");
  recorder_.accumulate(simulation_, dt);
  heat_.accumulate(simulation_);
  if (surface_) surface_->advance(simulation_, recorder_, dt);
  if (couples_back_) burn();
  const double time = simulation_.time();
  const bool last = finished();
  if (time >= next_sample_ || last) {
    recorder_.sample(simulation_);
    if (surface_) surface_->record(recorder_);
    if (burning_) burning_->record(simulation_, recorder_);
    heat_.advance_to(simulation_, time);
    next_sample_ = next_time(next_sample_, scene.output.trace_interval, time);
  }
  take_due_snapshots();
  if (surface_ && surface_->ignited()) snapshots_.take_ignition([this] { return snapshot(); });
  if (time >= next_monitor_ && !last) take_monitor_sample(dt);
}

bool Runner::is_done() const { return finished() || (ends_with_snapshots_ && snapshots_.done()); }

/// Lets the charge burn where the skin has ignited. The run ends a stated time after the first ignition,
/// whether that is before or after the end of the launch, or at a stated pressure.
void Runner::burn() {
  if (!surface_->ignited()) return;
  const scene::Combustion& combustion = simulation_.scene().combustion;
  if (!burning_) {
    burning_.emplace(simulation_, recorder_);
    end_ = surface_->ignition_time() + combustion.duration;
  }
  burning_->advance(simulation_, *surface_);
  if (!(recorder_.bottom_pressure() >= combustion.stop_pressure)) return;
  end_ = simulation_.time();
  combustion_end_ = CombustionEnd::pressure;
}

bool Runner::finished() const { return end_ - simulation_.time() <= 1e-12 * launch_time_; }

void Runner::check() {
  if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed))
    return stop(RunStatus::interrupted, fmt::format("stopped at t = {:.6g} ms", 1e3 * simulation_.time()));
  if (seconds_since(start_) > options_.time_limit)
    return stop(RunStatus::timed_out, fmt::format("not done after {:.3g} s", options_.time_limit));
  if (std::isfinite(time_step_) && time_step_ < collapse_share * first_step_)
    return stop_now(
        RunStatus::time_step_collapse,
        fmt::format("the stable time step fell from {:.3g} s to {:.3g} s", first_step_, time_step_));
  check_energy(energy_of(simulation_));
  if (options_.progress && seconds_since(last_report_) > 0.25) {
    last_report_ = Clock::now();
    options_.progress(simulation_.time() / end_);
  }
}

/// Steps so short would not end the launch, or no longer move the time at all.
void Runner::check_step(double dt) {
  constexpr double shortest_share = 1e-15;
  if (dt >= shortest_share * launch_time_) return;
  stop_now(std::isnan(dt) ? RunStatus::non_finite : RunStatus::time_step_collapse,
           fmt::format("with steps of {:.3g} s the launch would not end", dt));
}

void Runner::check_energy(const EnergyBalance& energy) {
  largest_energy_ = std::max(largest_energy_, energy.scale());
  if (const auto reason = reason_to_stop(simulation_, energy, largest_energy_,
                                         simulation_.scene().numerics.energy_drift_limit))
    stop_now(reason->status, reason->what);
}

void Runner::stop(RunStatus status, std::string reason) {
  result_.status = status;
  result_.reason = std::move(reason);
}

/// The time stands before the reason.
void Runner::stop_now(RunStatus status, const std::string& what) {
  stop(status, fmt::format("at t = {:.6g} ms: {}", 1e3 * simulation_.time(), what));
}

/// Samples are evenly spread over the launch.
void Runner::take_monitor_sample(double time_step) {
  constexpr double samples_of_launch = 500.0;
  result_.monitor.push_back(monitor_sample(simulation_, time_step));
  next_monitor_ = simulation_.time() + launch_time_ / samples_of_launch;
}

}  // namespace launchsafe::run

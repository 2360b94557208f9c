#include "snapshot_taker.hpp"

#include "snapshot.hpp"

#include <algorithm>

namespace launchsafe::run {

using scene::Event;

SnapshotTaker::SnapshotTaker(const scene::Scene& scene)
    : tolerance_(2e-12 * scene::end_time(scene.load)), wanted_(scene.output.snapshot_events) {
  for (const double time : scene.output.snapshot_times) due_.push_back({time, {}});
  if (wants(Event::peak_pressure)) {
    due_.push_back({scene::PressureHistory(scene.load).peak_time(), Event::peak_pressure});
    std::erase(wanted_, Event::peak_pressure);
  }
  std::stable_sort(due_.begin(), due_.end(), [](const Due& a, const Due& b) { return a.time < b.time; });
}

void SnapshotTaker::take_due(double time, const Take& take) {
  std::vector<Event> events;
  for (; is_due(time); ++next_)
    if (due_[next_].event) events.push_back(*due_[next_].event);
  keep(take(), std::move(events));
}

void SnapshotTaker::look_for_events(const mpm::Simulation& simulation, const Take& take) {
  if (wanted_.empty()) return;
  if (wants(Event::first_crack_growth) && has_grown_crack(simulation))
    take_event(Event::first_crack_growth, take);
  if (wants(Event::first_yield) && has_yielded(simulation)) take_event(Event::first_yield, take);
  if (!wants(Event::largest_slip)) return;
  const double slip = largest_slip(simulation);
  if (!(slip > largest_slip_)) return;
  largest_slip_ = slip;
  std::erase_if(taken_, [](const auto& shot) { return shot->events == std::vector{Event::largest_slip}; });
  keep(take(), {Event::largest_slip});
}

void SnapshotTaker::take_event(Event event, const Take& take) {
  if (!wants(event)) return;
  std::erase(wanted_, event);
  keep(take(), {event});
}

void SnapshotTaker::keep(Snapshot shot, std::vector<Event> events) {
  shot.events = std::move(events);
  taken_.push_back(std::make_shared<const Snapshot>(std::move(shot)));
}

std::vector<Snapshot> SnapshotTaker::finish() {
  std::vector<Snapshot> all;
  for (const auto& shot : taken_) all.push_back(*shot);
  merge_instants(all);
  return all;
}

bool SnapshotTaker::wants(Event event) const {
  return std::find(wanted_.begin(), wanted_.end(), event) != wanted_.end();
}

void merge_instants(std::vector<Snapshot>& snapshots) {
  std::stable_sort(snapshots.begin(), snapshots.end(),
                   [](const Snapshot& a, const Snapshot& b) { return a.time < b.time; });
  std::vector<Snapshot> merged;
  for (Snapshot& shot : snapshots) {
    if (merged.empty() || merged.back().time != shot.time) {
      merged.push_back(std::move(shot));
      continue;
    }
    std::vector<Event>& events = merged.back().events;
    events.insert(events.end(), shot.events.begin(), shot.events.end());
    std::sort(events.begin(), events.end());
  }
  snapshots = std::move(merged);
}

}  // namespace launchsafe::run

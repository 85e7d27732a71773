#include "vigil/runtime/virtual_flight.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/event_words.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
VirtualFlight::VirtualFlight(Mission mission, VirtualFleet& fleet, Recorder* recorder, Stopwatch stopwatch,
                             parallel::Workers* workers)
    : mission_(std::move(mission)),
      fleet_(fleet),
      recorder_(recorder),
      stopwatch_(std::move(stopwatch)),
      workers_(workers),
      state_(swarm_parameters(mission_, first_intent(mission_))),
      snapshot_(mission_.drones.size()),
      script_(mission_, fleet),
      audit_(audit_limits(mission_), mission_.drones.size()),
      summary_(mission_),
      ticks_to_fly_(
          static_cast<std::uint64_t>(std::llround(mission_.simulation.duration_s * mission_.control.rate_hz))),
      observations_(mission_.drones.size()),
      orders_(mission_.drones.size()),
      footprint_radius_m_(footprint_radius_m(mission_)) {
  watchers_.reserve(mission_.drones.size());
  if (mission_.simulation.goals) goals_.emplace(mission_);
}

void VirtualFlight::watch(const std::string& name, std::vector<Vec2> places, double time_s) {
  const auto known = std::find_if(areas_.begin(), areas_.end(), [&](const auto& log) { return log.name() == name; });
  if (known == areas_.end())
    areas_.emplace_back(name, std::move(places), time_s);
  else
    known->watch(std::move(places), time_s);
}

void VirtualFlight::retarget(double time_s, std::vector<swarm::Command>& commands) {
  commands.push_back(
      {.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = coverage_target(mission_, state_.basis())});
  const field::Field& field = state_.basis().field();
  const field::Importance map = importance(mission_);
  std::vector<std::string> watched;
  for (const field::Cluster& cluster : map.clusters) {
    watch(cluster.name, field::places_of(field, field::fit(cluster, map.sigma_min_m), map.no_fly), time_s);
    watched.push_back(cluster.name);
  }
  for (const field::Area& area : map.areas) {
    watch(area.name, field::places_of(field, area.outline, map.no_fly), time_s);
    watched.push_back(area.name);
  }
  for (field::RevisitLog& area : areas_)
    if (std::find(watched.begin(), watched.end(), area.name()) == watched.end()) area.watch({}, time_s);
  if (recorder_ != nullptr) recorder_->targets(time_s, targets_of(mission_));
}

void VirtualFlight::watch_areas(double time_s) {
  watchers_.clear();
  const std::span<const TruthSample> truth = fleet_.truth();
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (snapshot_.drones[i].activity == swarm::Activity::kActive) watchers_.push_back(truth[i].position);
  for (field::RevisitLog& area : areas_) area.see(watchers_, footprint_radius_m_, time_s);
}

/// What was found to be wrong, with its evidence, and what to do about it.
std::string VirtualFlight::fault_in_words(const swarm::Event& event) const {
  const swarm::DroneSnapshot& drone = snapshot_.drones[event.drone.index()];
  const std::string& id = mission_.drones[event.drone.index()].id;
  const EventWords words = words_for_fault(id, drone, snapshot_.active, snapshot_.drones.size());
  return fmt::format("{}; {}; {}", words.text, words.effect, words.next);
}

void VirtualFlight::log_snapshot_events() {
  if (recorder_ == nullptr) return;
  for (const swarm::Event& event : snapshot_.events) {
    LoggedEvent logged{snapshot_.time_s, "swarm", {}, {}, {}};
    if (event.kind == swarm::EventKind::kActivityChanged) {
      logged.what = name_of(event.after);
      logged.detail = "was " + std::string(name_of(event.before));
      if (event.fault != swarm::Fault::kNone) logged.detail += "; " + fault_in_words(event);
    } else if (event.kind == swarm::EventKind::kFaultNoticed) {
      logged.what = name_of(event.fault);
      logged.detail = fault_in_words(event);
    } else if (event.kind == swarm::EventKind::kStationFailed || event.kind == swarm::EventKind::kStationWorks) {
      const bool works = event.kind == swarm::EventKind::kStationWorks;
      const EventWords words = words_for_station(mission_.stations.at(event.station).name, works);
      logged.what = works ? "station_works" : "station_failed";
      logged.detail = fmt::format("{}; {}", words.text, words.effect);
      recorder_->log(logged);
      continue;
    } else if (event.kind == swarm::EventKind::kWishRefused) {
      logged.what = "refused";
      logged.detail = name_of(event.wish);
    } else {
      continue;  // what was accepted is in the log already, from whoever wished it
    }
    if (event.drone.index() < mission_.drones.size()) logged.drone = mission_.drones[event.drone.index()].id;
    recorder_->log(logged);
  }
}

void VirtualFlight::step() {
  const double dt_s = state_.parameters().dt_s;
  const double time_s = static_cast<double>(state_.ticks()) * dt_s;
  DueEvents due = script_.play(time_s);
  for (const EventEntry& edit : due.target_edits) apply_edit(mission_.targets, edit);
  if (!due.target_edits.empty() || has_targets_to_set_) retarget(time_s, due.commands);
  has_targets_to_set_ = false;
  if (recorder_ != nullptr)
    for (const LoggedEvent& event : due.log) recorder_->log(event);

  if (goals_) goals_->play(snapshot_, due.commands);

  fleet_.observe(mission_time(time_s), observations_);
  const std::chrono::nanoseconds before = stopwatch_();
  swarm::tick(state_, observations_, due.commands, snapshot_, workers_);
  const std::chrono::duration<double, std::micro> took = stopwatch_() - before;

  watch_areas(time_s);
  const Clearances clearances = audit_.judge(fleet_.truth(), snapshot_);
  if (goals_) goals_->watch(fleet_.truth(), snapshot_, time_s);
  summary_.add(snapshot_, took.count());
  if (recorder_ != nullptr) recorder_->record({snapshot_, observations_, due.commands, fleet_.truth(), clearances});
  log_snapshot_events();

  std::transform(snapshot_.drones.begin(), snapshot_.drones.end(), orders_.begin(),
                 [](const swarm::DroneSnapshot& drone) { return drone.order; });
  fleet_.order(mission_time(time_s), orders_);
  fleet_.advance(dt_s);
}

FlightSummary VirtualFlight::summary() const {
  const double end_s = static_cast<double>(state_.ticks()) * state_.parameters().dt_s;
  std::vector<std::pair<std::string, double>> worst;
  for (const field::RevisitLog& area : areas_) worst.emplace_back(area.name(), area.worst_s(end_s));
  std::optional<GoalTally> goals;
  if (goals_) goals = goals_->tally();
  return summary_.finish(audit_.totals(), std::move(worst), goals);
}

}  // namespace vigil::runtime

#include "vigil/adapters/sim/simulated_fleet.hpp"

#include <cassert>
#include <cmath>

namespace vigil::sim {
namespace {

/// What a random stream is for. Those of a drone are numbered by it, that of the whole fleet by none.
enum Purpose : std::uint64_t {
  kTrackerPurpose = 1,
  kSlowTrackerPurpose = 2,
  kWindPurpose = 3,
  kOrderPurpose = 4,
  kTelemetryPurpose = 5,
  kConfusionPurpose = 6
};

constexpr std::uint64_t kWholeFleet = ~std::uint64_t{0};

/// Drones that one thread looks after before it asks for more.
constexpr std::size_t kPart = 256;

/// An order waits for the link, and for whatever else delays it.
LinkParameters order_link(const FleetParameters& parameters) {
  LinkParameters link = parameters.link;
  link.packets.delay_s += parameters.vehicle.command_delay_s;
  return link;
}

/// What the dead time adds to the ticks of an order's way, so that both together are rounded once.
std::size_t dead_ticks(const FleetParameters& parameters) {
  const double way_s = order_link(parameters).packets.delay_s;
  const double whole_s = way_s + response_delay_s(parameters.vehicle.motion);
  return static_cast<std::size_t>(std::lround(whole_s / parameters.dt_s) - std::lround(way_s / parameters.dt_s));
}

}  // namespace

SimulatedFleet::SimulatedFleet(const FleetParameters& parameters, std::span<const Vec2> starts,
                               parallel::Workers* workers)
    : dt_s_(parameters.dt_s),
      positions_over_link_(parameters.positions_over_link),
      pads_(parameters.pads),
      confusion_(parameters.confusion, starts.size(),
                 dynamics::RandomStream(parameters.seed, kWholeFleet, kConfusionPurpose)),
      truth_(starts.size()),
      workers_(workers) {
  for (const swarm::ChargingPad& pad : pads_)
    if (pad.station >= has_failed_.size()) has_failed_.resize(pad.station + 1, false);
  drones_.reserve(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    drones_.push_back(make_drone(parameters, i, starts[i]));
    truth_[i] = drones_[i].vehicle.truth();
  }
}

template <typename Body>
void SimulatedFleet::for_each_drone(Body&& body) noexcept {
  parallel::for_each_part(workers_, size(), kPart, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t i = first; i < last; ++i) body(drones_[i], i);
  });
}

SimulatedFleet::Drone SimulatedFleet::make_drone(const FleetParameters& parameters, std::size_t number,
                                                 const Vec2& start) const {
  const auto random = [&](Purpose purpose) { return dynamics::RandomStream(parameters.seed, number, purpose); };
  const bool stays_down = number < parameters.stays_down.size() && parameters.stays_down[number];
  const bool starts_flying = parameters.starts_flying && !stays_down;
  return {SimulatedVehicle(parameters.vehicle, start, starts_flying, dead_ticks(parameters)),
          SimulatedTracker(parameters.tracker, dt_s_, random(kTrackerPurpose), random(kSlowTrackerPurpose)),
          SimulatedWind(parameters.wind, starts_flying, random(kWindPurpose)),
          Channel<swarm::DroneOrder>(order_link(parameters), dt_s_, random(kOrderPurpose)),
          Channel<Telemetry>(parameters.link, dt_s_, random(kTelemetryPurpose)),
          Heard{}};
}

void SimulatedFleet::hear(Drone& drone) noexcept {
  Telemetry sent{drone.vehicle.truth().mode, drone.vehicle.reported_battery(), {}, tick_};
  if (positions_over_link_) sent.sighting = drone.tracker.newest();
  drone.heard.age_s += dt_s_;
  drone.heard.last.sighting.age_s += dt_s_;
  const Telemetry* const arrived = drone.telemetry.pass(sent);
  if (arrived == nullptr) return;
  drone.heard = {*arrived, 0.0};
  drone.heard.last.sighting.age_s += static_cast<double>(tick_ - arrived->sent_at) * dt_s_;
}

void SimulatedFleet::report(const Drone& drone, swarm::DroneObservation& out) const noexcept {
  write(positions_over_link_ ? drone.heard.last.sighting : drone.tracker.newest(), out);
  if (drone.heard.age_s == swarm::DroneObservation::kNever) return;
  out.mode = drone.heard.last.mode;
  out.battery = drone.heard.last.battery;
  out.link_age_s = drone.heard.age_s;
}

void SimulatedFleet::observe(runtime::MissionTime, std::span<swarm::DroneObservation> out) noexcept {
  assert(out.size() == size());
  confusion_.advance(truth_, dt_s_);
  for_each_drone([&](Drone& drone, std::size_t i) {
    drone.tracker.measure(truth_[confusion_.body_of(i)]);
    hear(drone);
    report(drone, out[i]);
  });
  ++tick_;
}

void SimulatedFleet::order(runtime::MissionTime, std::span<const swarm::DroneOrder> orders) noexcept {
  assert(orders.size() == size());
  for_each_drone([&](Drone& drone, std::size_t i) {
    if (const swarm::DroneOrder* const arrived = drone.orders.pass(orders[i])) drone.vehicle.obey(*arrived);
  });
}

void SimulatedFleet::advance(double dt_s) noexcept {
  for_each_drone([&](Drone& drone, std::size_t i) {
    charge(drone, dt_s);
    drone.vehicle.advance(dt_s, drone.wind.advance(drone.vehicle.is_airborne(), dt_s));
    truth_[i] = drone.vehicle.truth();
  });
}

/// By the pad that it stands on, if it stands on one.
void SimulatedFleet::charge(Drone& drone, double dt_s) const noexcept {
  if (drone.vehicle.is_airborne()) return;
  for (const swarm::ChargingPad& pad : pads_)
    if (!has_failed_[pad.station] && (drone.vehicle.truth().position - pad.place).norm() <= pad.radius_m)
      return drone.vehicle.charge(dt_s / pad.full_in_s);
}

void SimulatedFleet::set_station(std::size_t station, bool charges) noexcept {
  if (station < has_failed_.size()) has_failed_[station] = !charges;
}

void SimulatedFleet::fail(swarm::DroneId drone) noexcept { drones_[drone.index()].vehicle.fail(); }

void SimulatedFleet::take_over(swarm::DroneId drone, const Vec2& velocity) noexcept {
  drones_[drone.index()].vehicle.take_over(velocity);
}

void SimulatedFleet::give_back(swarm::DroneId drone) noexcept { drones_[drone.index()].vehicle.give_back(); }

void SimulatedFleet::hide(swarm::DroneId drone, double for_s) noexcept { drones_[drone.index()].tracker.hide(for_s); }

void SimulatedFleet::cut_link(swarm::DroneId drone, double for_s) noexcept {
  drones_[drone.index()].orders.cut(for_s);
  drones_[drone.index()].telemetry.cut(for_s);
}

void SimulatedFleet::befall(swarm::DroneId drone, const runtime::Mishap& mishap) noexcept {
  using runtime::MishapKind;
  Drone& who = drones_[drone.index()];
  switch (mishap.kind) {
    case MishapKind::kFreezeTracking:
      return who.tracker.freeze(mishap.for_s);
    case MishapKind::kShiftTracking:
      return who.tracker.shift(mishap.value, mishap.for_s);
    case MishapKind::kSwapTracking:
      return confusion_.swap(drone.index(), mishap.other.index(), mishap.for_s);
    case MishapKind::kSkewVelocity:
      return who.tracker.skew(mishap.value, mishap.for_s);
    case MishapKind::kIgnoreOrders:
      return who.vehicle.ignore_orders(mishap.for_s);
    case MishapKind::kDrift:
      return who.vehicle.drift(mishap.value, mishap.for_s);
    case MishapKind::kLandByItself:
      return who.vehicle.land_by_itself();
    case MishapKind::kTakenByPilot:
      return who.vehicle.take_over(mishap.value);
  }
}

}  // namespace vigil::sim

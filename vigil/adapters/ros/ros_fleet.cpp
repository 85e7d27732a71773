#include "vigil/adapters/ros/ros_fleet.hpp"

#include <algorithm>
#include <utility>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::ros_bridge {
namespace {

using swarm::VehicleMode;
using Verdict = PositionGate::Verdict;

// How height is kept: as fast as it is wrong, but no faster than this.
constexpr double kHeightGainPerS = 1.0;
constexpr double kClimbLimit = 0.3;  ///< m/s
constexpr double kFreshS = 0.5;

/// In words; null where the position is used.
const char* refusal(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNothingNew:
    case Verdict::kBelieved:
      return nullptr;
    case Verdict::kLate:
      return "their stamps are more than 0.15 s old; are all machines' clocks set, and is the network slow?";
    case Verdict::kOlder:
      return "they were measured before ones that are known; do two trackers send them?";
    case Verdict::kFrozen:
      return "they repeat themselves; has the tracker stopped?";
    case Verdict::kAnothers:
      return "they are of another drone's body; compare names and bodies in the tracker";
    case Verdict::kJumped:
      return "they are farther away than it can have flown; is it the right body?";
    case Verdict::kNotANumber:
      return "they are not numbers; does the tracker see it?";
  }
  return nullptr;
}

GateParameters gate_parameters(const runtime::Mission& mission) {
  GateParameters parameters;
  parameters.reach_m_s = 1.5 * mission.control.speed_limit_m_s + 0.1;
  return parameters;
}

PhaseParameters phase_parameters(const runtime::Mission& mission) {
  const runtime::VehicleSection& vehicle = mission.simulation.vehicle;
  return {.altitude_m = vehicle.altitude_m,
          .take_off_s = vehicle.take_off_s,
          .landing_s = vehicle.landing_s,
          .landed_height_m = mission.health.landed_height_m};
}

}  // namespace

RosFleet::RosFleet(const runtime::Mission& mission, std::unique_ptr<CrazyswarmPort> port)
    : world_(runtime::world_frame(mission)),
      field_m_(mission.field.size_m),
      margin_m_(mission.safety.wall_distance_m),
      altitude_m_(mission.simulation.vehicle.altitude_m),
      port_(std::move(port)),
      drones_(mission.drones.size(),
              Drone{PositionGate(gate_parameters(mission)), FlightPhase(phase_parameters(mission))}),
      bodies_(mission.drones.size()),
      mistaken_(mission.drones.size()) {}

void RosFleet::observe(runtime::MissionTime /*now*/, std::span<swarm::DroneObservation> out) noexcept {
  const double now_s = port_->now_s();
  look(now_s);
  for (std::size_t i = 0; i < drones_.size(); ++i) observe(i, now_s, out[i]);
}

/// Names first, of all drones at once; then each position by itself.
void RosFleet::look(double now_s) noexcept {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    Drone& drone = drones_[i];
    drone.newest = port_->newest(i);
    bodies_[i] = {.is_known = drone.gate.has_seen(),
                  .is_timely = drone.gate.is_timely(drone.newest),
                  .is_airborne = drone.phase.is_airborne(),
                  .unseen_s = drone.gate.age_s(now_s),
                  .expected = drone.gate.expected(drone.newest),
                  .seen = drone.newest.place};
  }
  mistaken_.judge(bodies_);
  tell_of_the_mistaken();
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    Drone& drone = drones_[i];
    const Verdict verdict = drone.gate.look(drone.newest, drone.phase.flies(), mistaken_.taken_for(i).has_value());
    if (verdict != Verdict::kNothingNew) drone.refusal = refusal(verdict);
  }
  tell_of_the_refused(now_s);
}

/// Of those who have not been seen for a while: single positions are refused every now and then.
void RosFleet::tell_of_the_refused(double now_s) noexcept {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    Drone& drone = drones_[i];
    const bool is_lost = drone.gate.age_s(now_s) > kFreshS;
    const char* const now = is_lost ? drone.refusal : nullptr;
    if (now == drone.told_refusal || (is_lost && now == nullptr)) continue;
    if (port_->tell_refused(i, now)) drone.told_refusal = now;
  }
}

/// Once for two that are taken for each other.
void RosFleet::tell_of_the_mistaken() noexcept {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    const std::optional<std::size_t> other = mistaken_.taken_for(i);
    if (other == drones_[i].told_of) continue;
    const bool is_told = !other || drones_[*other].told_of == i || port_->tell_mistaken(i, *other);
    if (is_told) drones_[i].told_of = other;
  }
}

void RosFleet::observe(std::size_t index, double now_s, swarm::DroneObservation& out) noexcept {
  Drone& drone = drones_[index];
  if (port_->is_connected(index)) drone.heard_s = now_s;
  const Point& place = drone.gate.place();
  const Point& velocity = drone.gate.velocity();
  out.age_s = drone.gate.age_s(now_s);
  drone.phase.watch(place.z, out.age_s, now_s);
  out.mode = drone.phase.mode();
  out.link_age_s = drone.heard_s < 0.0 ? swarm::DroneObservation::kNever : now_s - drone.heard_s;
  if (!drone.gate.has_seen()) return;
  out.position = world_.point_to_field({place.x, place.y});
  out.velocity = world_.vector_to_field({velocity.x, velocity.y});
  out.height_m = place.z;
}

void RosFleet::order(runtime::MissionTime /*now*/, std::span<const swarm::DroneOrder> orders) noexcept {
  const double now_s = port_->now_s();
  for (std::size_t i = 0; i < drones_.size(); ++i) order(i, now_s, orders[i]);
  port_->flush();
}

void RosFleet::order(std::size_t index, double now_s, const swarm::DroneOrder& order) noexcept {
  Drone& drone = drones_[index];
  drone.phase.answered(port_->answer(index), now_s);
  const bool may_stay = order.action == swarm::Action::kStopMotors || !has_left(drone);
  const swarm::Action action = may_stay ? order.action : swarm::Action::kLand;
  const std::optional<VehicleCall> call = drone.phase.call_for(action, drone.gate.age_s(now_s), now_s);
  if (call && port_->call(index, *call)) drone.phase.called(*call, now_s);
  port_->set(index, setpoint(index, now_s, order));
}

/// Whether it flies where no order can have sent it: it may be another one's body, or follow nobody.
bool RosFleet::has_left(const Drone& drone) const noexcept {
  if (drone.phase.mode() != VehicleMode::kFlying || !drone.gate.has_seen()) return false;
  const Vec2 place = world_.point_to_field({drone.gate.place().x, drone.gate.place().y});
  return (place.array() < -margin_m_).any() || ((place - field_m_).array() > margin_m_).any();
}

/// A drone that flies always has one: what is ordered, or a hover, or straight down.
Setpoint RosFleet::setpoint(std::size_t index, double now_s, const swarm::DroneOrder& order) const noexcept {
  const Drone& drone = drones_[index];
  if (!drone.phase.is_streamed()) return {};
  Setpoint setpoint{true, {}};
  if (drone.phase.descends()) {
    setpoint.velocity_m_s.z = -FlightPhase::kDescentPerS;
    return setpoint;
  }
  if (drone.gate.age_s(now_s) > kFreshS || mistaken_.taken_for(index)) return setpoint;
  setpoint.velocity_m_s.z =
      std::clamp(kHeightGainPerS * (altitude_m_ - drone.gate.place().z), -kClimbLimit, kClimbLimit);
  if (order.action != swarm::Action::kVelocity || drone.phase.mode() != VehicleMode::kFlying) return setpoint;
  const Vec2 velocity = world_.vector_to_world(order.velocity);
  setpoint.velocity_m_s.x = velocity.x();
  setpoint.velocity_m_s.y = velocity.y();
  return setpoint;
}

}  // namespace vigil::ros_bridge

// What of a tick keeps drones clear of each other.

#include <algorithm>
#include <cassert>
#include <limits>

#include "vigil/core/guidance/step_aside.hpp"
#include "vigil/core/safety/barrier.hpp"
#include "vigil/swarm/guidance_parameters.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::swarm {
namespace {

/// May be about to meet others although nobody steers it there.
bool is_stray(const safety::Body& body) {
  return !body.is_controlled && body.is_obstacle && body.uncooperative_speed_m_s > 0.0 && body.position.allFinite() &&
         body.velocity.allFinite();
}

}  // namespace

safety::Explanation SwarmState::explain(DroneId drone) const {
  assert(ticks_ > 0 && drone.index() < drones_.size());
  safety::Filter filter = filter_;  // its work space is not this state's business
  safety::Explanation why = filter.explain(drone.index(), bodies_, target_.no_fly, u_nom_[drone.index()]);
  for (safety::GivenRow& row : why.rows)
    if (row.what.kind == safety::RowKind::kNeighbour) row.what.index = drone_of(row.what.index);
  name_holders(why.report);
  return why;
}

/// Once its position or its link is lost a drone is told to stop, or stops by its own failsafe: it wanders no farther.
double SwarmState::longest_assumed_age_s() const noexcept {
  return parameters_.health.tracking_timeout_s + parameters_.health.link_timeout_s;
}

double SwarmState::assumed_age(const DroneMemory& drone) const noexcept {
  if (drone.activity == Activity::kNeverSeen) return 0.0;  // it has been told nothing but to stay where it is
  const bool is_lost = !is_steered(drone.activity);
  // The paper's barrier knows no age; only a drone that is lost is given more room.
  if (parameters_.barrier.kind == safety::BarrierKind::kPaper && !is_lost) return 0.0;
  const double predicted = parameters_.observation_delay_s;
  return std::clamp(drone.last_good.age_s - predicted, 0.0, longest_assumed_age_s());
}

safety::Body SwarmState::body_of(std::size_t index) const noexcept {
  const DroneMemory& drone = drones_[index];
  safety::Body body;
  body.position = motions_[index].position;
  body.velocity = motions_[index].velocity;
  body.age_s = assumed_age(drone);
  // What a drone that is not heard, or that somebody calls failed, did with the orders on their way to it, nobody
  // knows.
  if (drone.activity == Activity::kLinkLost || drone.activity == Activity::kMarkedFailed)
    body.age_s += (body.position - drone.last_good.position).norm() / parameters_.barrier.u_max_m_s;
  body.is_controlled = is_steered(drone.activity) || stands_still(drone.activity);
  // Others clear the air above a drone that is to take off.
  const bool takes_room = is_airborne(drone, parameters_.health) || wants_up(drone);
  body.is_obstacle = parameters_.only_active_are_obstacles ? drone.activity == Activity::kActive : takes_room;
  body.uncooperative_speed_m_s = wandering_speed(drone, parameters_.barrier.u_max_m_s);
  return body;
}

/// A drone that is seen where it cannot be is in one of two places, and nobody knows in which: others keep clear of
/// both. It hovers, and cannot meet itself.
void SwarmState::add_doubted_places() noexcept {
  doubted_.clear();
  if (!monitor_.watches()) return;
  for (std::size_t index = 0; index < drones_.size(); ++index) {
    if (is_steered(drones_[index].activity) || !bodies_[index].is_obstacle) continue;
    const auto sighting = monitor_.doubted_sighting(index);
    if (!sighting) continue;
    safety::Body body = bodies_[index];
    body.position = sighting->motion.position;
    body.velocity = sighting->motion.velocity;
    body.age_s = std::clamp(sighting->age_s - parameters_.observation_delay_s, 0.0, longest_assumed_age_s());
    bodies_.push_back(body);  // within its capacity, and so below
    doubted_.push_back(static_cast<std::uint32_t>(index));
  }
}

int SwarmState::drone_of(int body) const noexcept {
  const auto drones = static_cast<int>(drones_.size());
  return body < drones ? body : static_cast<int>(doubted_[static_cast<std::size_t>(body - drones)]);
}

/// Whoever holds a drone is named, in whichever of its places it does.
void SwarmState::name_holders(safety::FilterReport& report) const noexcept {
  for (safety::HoldingRow& row : report.holding)
    if (row.kind == safety::RowKind::kNeighbour) row.index = drone_of(row.index);
  report.nearest = drone_of(report.nearest);
}

/// Whoever is in the way of a drone that nobody controls wishes nothing else than to leave it.
void SwarmState::step_aside() noexcept {
  if (parameters_.barrier.kind == safety::BarrierKind::kPaper || !is_any(&PartNote::has_stray)) return;
  const guidance::AsideParameters aside = aside_parameters(parameters_);
  for (const safety::Body& body : bodies_) {
    if (!is_stray(body)) continue;
    const guidance::Stray stray{body.position, body.velocity};
    if (!guidance::is_fast(aside, stray)) continue;
    for (std::size_t index = 0; index < drones_.size(); ++index) {
      if (!is_steered(drones_[index].activity)) continue;
      const auto wish = guidance::step_aside(aside, stray, safety::barrier_point(parameters_.barrier, bodies_[index]));
      if (wish) u_nom_[index] = *wish;
    }
  }
}

void SwarmState::keep_safe(parallel::Workers* workers) noexcept {
  bodies_.resize(drones_.size());
  for_each_drone(workers, [&](std::size_t index, PartNote& note) {
    bodies_[index] = body_of(index);
    note.has_stray = note.has_stray || is_stray(bodies_[index]);
  });
  add_doubted_places();
  step_aside();
  filter_.run(bodies_, target_.no_fly, u_nom_, u_, reports_, workers);
  if (!doubted_.empty())
    for (safety::FilterReport& report : reports_) name_holders(report);
}

void SwarmState::sort_air(parallel::Workers* workers) noexcept {
  const auto place_in_air = [&](std::size_t index) {
    const Vec2 nowhere = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    return is_airborne(drones_[index], parameters_.health) ? drones_[index].last_good.position : nowhere;
  };
  air_.sort(drones_.size(), place_in_air, workers);
}

bool SwarmState::has_clear_air(std::size_t index) const noexcept {
  constexpr double kRounding = 1e-6;  // those who clear the air come to rest on the boundary itself
  const safety::BarrierParameters& barrier = parameters_.barrier;
  const double room_m = safety::barrier_radius(barrier) - kRounding;
  const Vec2& place = drones_[index].last_good.position;
  if (!place.allFinite()) return true;
  constexpr double kAnswers = 2.0;  // lags: until 0.86 of a change is flown
  const bool is_announced = drones_[index].wants_up_s >= parameters_.command_delay_s + kAnswers * barrier.lag_s;
  if (!is_announced) return false;
  // Who is fast must be able to give way from now on: the barrier between the two holds already, as they will be.
  safety::Body rising = bodies_[index];
  rising.is_controlled = true;
  const safety::PairBarrier pair = safety::margin_barrier(barrier, rising);
  const double reach_m = room_m + 2.0 * pair.lag_s * barrier.u_max_m_s + barrier.u_max_m_s * kLongestPredictionS;
  bool is_clear = true;
  air_.visit_near(place, reach_m, [&](std::size_t other) {
    if (other == index) return;
    const Vec2 z_ij = safety::barrier_point(barrier, bodies_[other]) - place;
    const double spread_m = pair.lag_s * (bodies_[other].velocity - rising.velocity).norm();
    const double h = z_ij.squaredNorm() - spread_m * spread_m - pair.radius_m * pair.radius_m;
    const bool is_far = (drones_[other].last_good.position - place).norm() >= room_m;
    if (!is_far || h < -kRounding * pair.radius_m) is_clear = false;
  });
  return is_clear;
}

}  // namespace vigil::swarm

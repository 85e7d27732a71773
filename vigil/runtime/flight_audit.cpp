#include "vigil/runtime/flight_audit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil::runtime {
namespace {

constexpr double kRounding = 1e-9;

double wall_distance(const field::Field& field, const Vec2& p) {
  return std::min({p.x(), field.length_x - p.x(), p.y(), field.length_y - p.y()});
}

void lower(double& least, double value) { least = std::min(least, value); }

}  // namespace

FlightAudit::FlightAudit(AuditLimits limits, std::size_t drones)
    : limits_(std::move(limits)), near_(limits_.field, limits_.separation_m, drones), piloted_(drones, 0) {
  airborne_.reserve(drones);
}

bool FlightAudit::is_within_limits(const TruthSample& drone) const noexcept {
  const auto is_clear = [&](const field::Polygon& polygon) {
    return field::signed_distance(polygon, drone.position) >= limits_.no_fly_buffer_m - kRounding;
  };
  return drone.velocity.norm() <= limits_.speed_limit_m_s + kRounding &&
         wall_distance(limits_.field, drone.position) >= limits_.wall_distance_m - kRounding &&
         std::all_of(limits_.no_fly.begin(), limits_.no_fly.end(), is_clear);
}

void FlightAudit::note_pilots(std::span<const TruthSample> truth) noexcept {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].mode == swarm::VehicleMode::kManual)
      piloted_[i] = 1;
    else if (piloted_[i] == 1 && is_within_limits(truth[i]))
      piloted_[i] = 0;
  }
}

/// A pair that is farther apart than both R_s and the least distance so far changes nothing.
void FlightAudit::judge_pairs(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot,
                              Clearances& now) noexcept {
  const auto position_of = [&](std::size_t i) -> const Vec2& { return truth[airborne_[i]].position; };
  const auto is_active = [&](std::size_t i) {
    return snapshot.drones[airborne_[i]].activity == swarm::Activity::kActive;
  };
  near_.sort(airborne_.size(), position_of);
  const std::span<const std::uint32_t> sorted = near_.sorted();
  const auto judge_pair = [&](std::size_t a, std::size_t b) {
    const double distance = (position_of(a) - position_of(b)).norm();
    lower(now.airborne_pair_m, distance);
    if (is_active(a) && is_active(b)) lower(now.active_pair_m, distance);
    if (distance < limits_.separation_m - kRounding) ++totals_.separation_violations;
  };
  for (std::size_t place = 0; place < near_.placed(); ++place) {
    const std::size_t own = sorted[place];
    const double least_m = is_active(own) ? now.active_pair_m : now.airborne_pair_m;
    near_.visit_parts(position_of(own), std::max(limits_.separation_m, least_m),
                      [&](std::size_t first, std::size_t last) {
                        for (first = std::max(first, place + 1); first < last; ++first) judge_pair(own, sorted[first]);
                      });
  }
}

void FlightAudit::judge_places(std::span<const TruthSample> truth, Clearances& now) noexcept {
  for (const std::size_t drone : airborne_) {
    if (piloted_[drone] == 1) continue;
    const Vec2& p = truth[drone].position;
    const double wall = wall_distance(limits_.field, p);
    lower(now.wall_m, wall);
    if (wall < limits_.wall_distance_m - kRounding) ++totals_.wall_violations;
    double no_fly = std::numeric_limits<double>::infinity();
    for (const field::Polygon& polygon : limits_.no_fly) lower(no_fly, field::signed_distance(polygon, p));
    lower(now.no_fly_m, no_fly);
    if (no_fly < limits_.no_fly_buffer_m - kRounding) ++totals_.no_fly_violations;
  }
}

void FlightAudit::judge_speeds(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot) noexcept {
  for (const std::size_t drone : airborne_) {
    if (piloted_[drone] == 1 || snapshot.drones[drone].order.action != swarm::Action::kVelocity) continue;
    const double speed = truth[drone].velocity.norm();
    totals_.max_speed_m_s = std::max(totals_.max_speed_m_s, speed);
    const double ordered = snapshot.drones[drone].order.velocity.norm();
    const double judged = limits_.follows_exactly ? std::max(ordered, speed) : ordered;
    if (judged > limits_.speed_limit_m_s + kRounding) ++totals_.speed_violations;
  }
}

void FlightAudit::judge_batteries(std::span<const TruthSample> truth) noexcept {
  totals_.ran_empty = 0;
  for (const TruthSample& drone : truth) totals_.ran_empty += drone.ran_empty ? 1U : 0U;
  for (const std::size_t drone : airborne_)
    if (std::isfinite(truth[drone].charge)) lower(totals_.least_charge, truth[drone].charge);
}

Clearances FlightAudit::judge(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot) noexcept {
  airborne_.clear();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool is_up = truth[i].mode != swarm::VehicleMode::kGrounded && truth[i].height_m > limits_.landed_height_m;
    if (is_up) airborne_.push_back(i);
  }
  note_pilots(truth);
  Clearances now;
  judge_pairs(truth, snapshot, now);
  judge_places(truth, now);
  judge_batteries(truth);
  judge_speeds(truth, snapshot);
  lower(totals_.least.airborne_pair_m, now.airborne_pair_m);
  lower(totals_.least.active_pair_m, now.active_pair_m);
  lower(totals_.least.wall_m, now.wall_m);
  lower(totals_.least.no_fly_m, now.no_fly_m);
  return now;
}

}  // namespace vigil::runtime

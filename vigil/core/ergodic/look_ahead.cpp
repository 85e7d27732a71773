#include "vigil/core/ergodic/look_ahead.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace vigil::ergodic {
namespace {

// A new path: at half speed, each drone another way. Without it a drone on a ridge of the map would stay there.
Vec2 first_velocity(std::size_t drone, double u_max) noexcept {
  constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002103;  // pi (3 - sqrt 5): directions never repeat
  const double heading = kGoldenAngle * static_cast<double>(drone);
  return 0.5 * u_max * Vec2(std::cos(heading), std::sin(heading));
}

Vec2 shortened(const Vec2& velocity, double u_max) noexcept {
  const double speed = velocity.norm();
  return speed > u_max ? Vec2(velocity * (u_max / speed)) : velocity;
}

}  // namespace

double default_look_ahead_s(const field::Field& field, std::size_t drones, double u_max_m_s) noexcept {
  constexpr double kShareOfCrossing = 0.6;
  return kShareOfCrossing * std::sqrt(field.area() / static_cast<double>(drones)) / u_max_m_s;
}

LookAhead::LookAhead(const Basis& basis, const LookAheadParameters& parameters, std::size_t drones)
    : parameters_(parameters),
      field_(basis.field()),
      forecast_(basis, drones, parameters.pieces),
      paths_(drones * static_cast<std::size_t>(parameters.pieces), Vec2::Zero()),
      takes_part_(drones, 0) {
  assert(parameters.u_max_m_s > 0.0 && parameters.lag_s >= 0.0 && parameters.dt_s > 0.0);
  assert(!parameters.horizon_s || *parameters.horizon_s > 0.0);
  assert(parameters.decisions > 0.0 && parameters.catch_up >= 0.0 && parameters.step > 0.0);
  starts_.reserve(drones);
  velocities_.reserve(paths_.size());
}

// By the metric's own weights drones may leave a small new place with some of its share missing, and for minutes.
void LookAhead::targets_changed() noexcept {
  decide_at_once();
  if (!has_steered_) return;
  catch_up_left_s_ = parameters_.catch_up * std::max(field_.length_x, field_.length_y) / parameters_.u_max_m_s;
}

double LookAhead::horizon_s(std::size_t drones) const noexcept {
  return parameters_.horizon_s ? *parameters_.horizon_s : default_look_ahead_s(field_, drones, parameters_.u_max_m_s);
}

std::span<Vec2> LookAhead::path_of(std::size_t drone) noexcept {
  const auto pieces = static_cast<std::size_t>(parameters_.pieces);
  return std::span(paths_).subspan(drone * pieces, pieces);
}

void LookAhead::enlist(std::span<const Departure> departures) noexcept {
  std::size_t next = 0;
  for (std::size_t drone = 0; drone < takes_part_.size(); ++drone) {
    const bool takes_part = next < departures.size() && departures[next].drone == drone;
    if (takes_part) ++next;
    if (takes_part == (takes_part_[drone] != 0)) continue;
    takes_part_[drone] = takes_part ? 1 : 0;
    is_due_ = true;
    if (takes_part) std::ranges::fill(path_of(drone), first_velocity(drone, parameters_.u_max_m_s));
  }
}

// The rest of a path after some pieces were flown, drawn out to its full length by its last velocity.
void LookAhead::fly_on(std::span<Vec2> path, double pieces_flown) const noexcept {
  const auto last = static_cast<double>(path.size() - 1);
  for (std::size_t j = 0; j < path.size(); ++j) {
    const double place = std::min(last, static_cast<double>(j) + pieces_flown);
    const auto before = static_cast<std::size_t>(place);  // never behind j: what is read was not written yet
    const std::size_t after = std::min(before + 1, path.size() - 1);
    path[j] += (place - static_cast<double>(before)) * (path[after] - path[before]) + (path[before] - path[j]);
  }
}

void LookAhead::decide(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
                       const AllowedRegion& region, std::span<const Departure> departures) noexcept {
  forecast_.set_emphasis(catch_up_left_s_ > 0.0 ? Emphasis::kDetail : Emphasis::kMetric);
  const double piece_s = horizon_s(departures.size()) / parameters_.pieces;
  starts_.clear();
  velocities_.clear();
  for (const Departure& departure : departures) {
    starts_.push_back(departure.position + parameters_.lag_s * departure.velocity);
    const std::span<Vec2> path = path_of(departure.drone);
    fly_on(path, since_decision_s_ / piece_s);
    velocities_.insert(velocities_.end(), path.begin(), path.end());
  }
  forecast_.run(kernel, statistics, phi_k, region, {starts_, velocities_, piece_s});

  // The more drones change their paths at once, the less each may: their changes add up where they meet.
  const double step = parameters_.step / (forecast_.curvature() * std::sqrt(static_cast<double>(departures.size())));
  std::span<const Vec2> slopes = forecast_.slopes();
  for (const Departure& departure : departures) {
    for (Vec2& velocity : path_of(departure.drone)) {
      velocity = shortened(velocity - step * slopes.front(), parameters_.u_max_m_s);
      slopes = slopes.subspan(1);
    }
  }
}

void LookAhead::steer(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
                      const AllowedRegion& region, std::span<const Departure> departures, std::span<Vec2> u) noexcept {
  assert(departures.size() == u.size() && departures.size() <= takes_part_.size());
  enlist(departures);
  if (departures.empty()) return;
  has_steered_ = true;
  since_decision_s_ += parameters_.dt_s;
  const double pause_s = std::max(parameters_.least_pause_s, horizon_s(departures.size()) / parameters_.decisions);
  if (is_due_ || since_decision_s_ > pause_s - 0.5 * parameters_.dt_s) {
    decide(kernel, statistics, phi_k, region, departures);
    since_decision_s_ = 0.0;
    is_due_ = false;
  }
  catch_up_left_s_ = std::max(0.0, catch_up_left_s_ - parameters_.dt_s);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = path_of(departures[i].drone).front();
}

}  // namespace vigil::ergodic

#include "vigil/adapters/sim/simulated_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil::sim {
namespace {

std::size_t ticks_of(double delay_s, double dt_s) { return static_cast<std::size_t>(std::lround(delay_s / dt_s)); }

Vec2 advanced(const dynamics::GaussMarkov& bias, const Vec2& value, const Vec2& normals, double dt_s) {
  return {dynamics::advance(bias, value.x(), normals.x(), dt_s), dynamics::advance(bias, value.y(), normals.y(), dt_s)};
}

}  // namespace

void write(const Sighting& sighting, swarm::DroneObservation& out) noexcept {
  if (sighting.age_s == swarm::DroneObservation::kNever) return;
  out.position = sighting.position;
  out.velocity = sighting.velocity;
  out.height_m = sighting.height_m;
  out.age_s = sighting.age_s;
}

SimulatedTracker::SimulatedTracker(const TrackerParameters& parameters, double dt_s, dynamics::RandomStream random,
                                   dynamics::RandomStream slow_random)
    : parameters_(parameters),
      dt_s_(dt_s),
      random_(random),
      slow_random_(slow_random),
      least_ticks_(ticks_of(parameters.delay_s, dt_s)),
      beat_(parameters.measurements_per_tick),
      on_the_way_(ticks_of(parameters.delay_s + parameters.jitter_s, dt_s)) {
  if (parameters_.bias.sigma > 0.0)  // it has been wandering for ever
    bias_ = advanced(parameters_.bias, Vec2::Zero(), slow_random_.normal(1.0), std::numeric_limits<double>::infinity());
}

/// A Poisson process of beginnings, each with an exponential length.
void SimulatedTracker::draw_dropouts() noexcept {
  if (parameters_.dropouts_per_min <= 0.0) return;
  const double expected = parameters_.dropouts_per_min / 60.0 * dt_s_;
  const bool begins = random_.uniform() < -std::expm1(-expected);
  const double length = random_.exponential(parameters_.dropout_s);  // drawn always: the stream keeps its step
  if (begins) hide(length);
}

void SimulatedTracker::hide(double for_s) noexcept { hidden_s_ = std::max(hidden_s_, for_s); }

void SimulatedTracker::wander() noexcept {
  if (parameters_.bias.sigma > 0.0) bias_ = advanced(parameters_.bias, bias_, slow_random_.normal(1.0), dt_s_);
}

std::size_t SimulatedTracker::draw_delay() noexcept {
  if (parameters_.jitter_s <= 0.0) return least_ticks_;
  return ticks_of(parameters_.delay_s + parameters_.jitter_s * slow_random_.uniform(), dt_s_);
}

void SimulatedTracker::send(const runtime::TruthSample& truth) noexcept {
  Sighting sighting{truth.position + bias_, truth.velocity, truth.height_m, 0.0};
  if (parameters_.noise_m > 0.0) sighting.position += random_.normal(parameters_.noise_m);
  if (parameters_.velocity_noise_m_s > 0.0) sighting.velocity += random_.normal(parameters_.velocity_noise_m_s);
  const std::size_t ticks = draw_delay();
  distort(sighting);
  if (hidden_s_ > 0.0) return;
  sighting.age_s = static_cast<double>(ticks) * dt_s_;  // when it arrives
  on_the_way_.send(sighting, ticks);
}

/// What is wrong with it beyond noise.
void SimulatedTracker::distort(Sighting& sighting) noexcept {
  sighting.position += shift_.now();
  sighting.velocity += skew_.now();
  if (frozen_s_ > 0.0 && measured_.age_s != swarm::DroneObservation::kNever) sighting = measured_;
  measured_ = sighting;
}

void SimulatedTracker::receive() noexcept {
  arrived_.age_s += dt_s_;
  if (const Sighting* const sighting = on_the_way_.receive()) arrived_ = *sighting;
}

void SimulatedTracker::measure(const runtime::TruthSample& truth) noexcept {
  draw_dropouts();
  if (beat_.next()) send(truth);
  for (double* const left_s : {&hidden_s_, &frozen_s_, &shift_.left_s, &skew_.left_s})
    *left_s = std::max(0.0, *left_s - dt_s_);
  wander();
  receive();
}

}  // namespace vigil::sim

#include "vigil/adapters/sim/simulated_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::sim {
namespace {

std::size_t ticks_of(double delay_s, double dt_s) { return static_cast<std::size_t>(std::lround(delay_s / dt_s)); }

}  // namespace

SimulatedTracker::SimulatedTracker(const TrackerParameters& parameters, double dt_s, dynamics::RandomStream random)
    : parameters_(parameters), dt_s_(dt_s), random_(random), on_the_way_(ticks_of(parameters.delay_s, dt_s) + 1) {}

/// A Poisson process of beginnings, each with an exponential length.
void SimulatedTracker::draw_dropouts() noexcept {
  if (parameters_.dropouts_per_min <= 0.0) return;
  const double expected = parameters_.dropouts_per_min / 60.0 * dt_s_;
  const bool begins = random_.uniform() < -std::expm1(-expected);
  const double length = random_.exponential(parameters_.dropout_s);  // drawn always: the stream keeps its step
  if (begins) hide(length);
}

void SimulatedTracker::hide(double for_s) noexcept { hidden_s_ = std::max(hidden_s_, for_s); }

void SimulatedTracker::measure(const runtime::TruthSample& truth) noexcept {
  draw_dropouts();
  newest_ = (newest_ + 1) % on_the_way_.size();
  Measurement& measurement = on_the_way_[newest_];
  measurement.is_seen = hidden_s_ <= 0.0;
  measurement.position = truth.position;
  if (parameters_.noise_m > 0.0) measurement.position += random_.normal(parameters_.noise_m);
  measurement.velocity = truth.velocity;
  if (parameters_.velocity_noise_m_s > 0.0) measurement.velocity += random_.normal(parameters_.velocity_noise_m_s);
  measurement.height_m = truth.height_m;
  hidden_s_ = std::max(0.0, hidden_s_ - dt_s_);

  const Measurement& arriving = on_the_way_[(newest_ + 1) % on_the_way_.size()];  // the oldest of the ring
  age_s_ += dt_s_;
  if (!arriving.is_seen) return;
  arrived_ = arriving;
  age_s_ = static_cast<double>(on_the_way_.size() - 1) * dt_s_;
}

void SimulatedTracker::observe(swarm::DroneObservation& out) const noexcept {
  if (age_s_ == swarm::DroneObservation::kNever) return;
  out.position = arrived_.position;
  out.velocity = arrived_.velocity;
  out.height_m = arrived_.height_m;
  out.age_s = age_s_;
}

}  // namespace vigil::sim

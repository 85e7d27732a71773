#pragma once

#include "vigil/adapters/sim/beat.hpp"
#include "vigil/adapters/sim/in_transit.hpp"
#include "vigil/core/dynamics/gauss_markov.hpp"
#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

/// What a motion-capture system or a satellite receiver does to the truth.
struct TrackerParameters {
  double noise_m = 0.0;                ///< standard deviation per axis
  double velocity_noise_m_s = 0.0;     ///< standard deviation per axis
  double delay_s = 0.0;                ///< age of a measurement when it arrives, at least
  double jitter_s = 0.0;               ///< on top of it: uniform between 0 and this
  double measurements_per_tick = 1.0;  ///< 1 or more: every tick has one
  double dropouts_per_min = 0.0;       ///< on average
  double dropout_s = 0.5;              ///< mean length
  dynamics::GaussMarkov bias{};        ///< of x and y each, slowly wandering; the height has none
};

/// A body as a tracker saw it.
struct Sighting {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double height_m = 0.0;
  double age_s = swarm::DroneObservation::kNever;  ///< kNever: not seen yet
};

/// Into an observation; one that says nothing leaves it alone.
void write(const Sighting& sighting, swarm::DroneObservation& out) noexcept;

/// The tracker's view of one vehicle: measures, delivers late, now and then nothing. A measurement that comes after a
/// newer one is dropped. Delays are rounded to whole ticks.
class SimulatedTracker {
 public:
  /// `random` draws noise and dropouts, `slow_random` bias and jitter.
  SimulatedTracker(const TrackerParameters& parameters, double dt_s, dynamics::RandomStream random,
                   dynamics::RandomStream slow_random);

  /// One tick: takes a measurement of the truth where one is due, and what arrives.
  void measure(const runtime::TruthSample& truth) noexcept;
  /// Nothing is seen for so long from now on.
  void hide(double for_s) noexcept;
  /// For so long it tells, fresh each time, the last place and velocity that it measured.
  void freeze(double for_s) noexcept { frozen_s_ = for_s; }
  /// For so long it sees the body so far from where it is.
  void shift(const Vec2& by_m, double for_s) noexcept { shift_ = {by_m, for_s}; }
  /// For so long it reports velocities that are wrong by so much.
  void skew(const Vec2& by_m_s, double for_s) noexcept { skew_ = {by_m_s, for_s}; }
  /// The newest that has arrived.
  [[nodiscard]] const Sighting& newest() const noexcept { return arrived_; }

 private:
  void draw_dropouts() noexcept;
  void wander() noexcept;
  [[nodiscard]] std::size_t draw_delay() noexcept;
  void send(const runtime::TruthSample& truth) noexcept;
  void receive() noexcept;

  struct Error {
    Vec2 by = Vec2::Zero();
    double left_s = 0.0;
    [[nodiscard]] Vec2 now() const { return left_s > 0.0 ? by : Vec2(Vec2::Zero()); }
  };
  void distort(Sighting& sighting) noexcept;

  TrackerParameters parameters_;
  double dt_s_;
  dynamics::RandomStream random_;
  dynamics::RandomStream slow_random_;
  std::size_t least_ticks_;  ///< of a measurement's way
  Beat beat_;
  InTransit<Sighting> on_the_way_;
  Vec2 bias_ = Vec2::Zero();
  double hidden_s_ = 0.0;
  double frozen_s_ = 0.0;
  Error shift_;
  Error skew_;
  Sighting measured_;  ///< the last one, as it was sent
  Sighting arrived_;
};

}  // namespace vigil::sim

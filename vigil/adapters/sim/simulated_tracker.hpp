#pragma once

#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

/// What a motion-capture system or a satellite receiver does to the truth.
struct TrackerParameters {
  double noise_m = 0.0;             ///< standard deviation per axis
  double velocity_noise_m_s = 0.0;  ///< standard deviation per axis
  double delay_s = 0.0;             ///< age of a measurement when it arrives
  double dropouts_per_min = 0.0;    ///< on average
  double dropout_s = 0.5;           ///< mean length
};

/// The tracker's view of one vehicle: measures once a tick, delivers late, now and then nothing.
class SimulatedTracker {
 public:
  SimulatedTracker(const TrackerParameters& parameters, double dt_s, dynamics::RandomStream random);

  /// Takes one measurement of the truth; call once a tick, before observe().
  void measure(const runtime::TruthSample& truth) noexcept;
  /// Nothing is seen for so long from now on.
  void hide(double for_s) noexcept;
  /// Position, velocity, height and age of the newest measurement that has arrived; leaves `out` alone before the
  /// first.
  void observe(swarm::DroneObservation& out) const noexcept;

 private:
  struct Measurement {
    Vec2 position = Vec2::Zero();
    Vec2 velocity = Vec2::Zero();
    double height_m = 0.0;
    bool is_seen = false;
  };
  void draw_dropouts() noexcept;

  TrackerParameters parameters_;
  double dt_s_;
  dynamics::RandomStream random_;
  std::vector<Measurement> on_the_way_;  ///< ring: the delay in ticks, plus one
  std::size_t newest_ = 0;
  double hidden_s_ = 0.0;
  Measurement arrived_;
  double age_s_ = swarm::DroneObservation::kNever;
};

}  // namespace vigil::sim

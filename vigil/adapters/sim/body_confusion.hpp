#pragma once

#include <span>
#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

/// How often a tracker takes two bodies for each other.
struct ConfusionParameters {
  double swaps_per_h = 0.0;  ///< in the whole fleet, on average
  double swap_s = 1.0;       ///< > 0, the length of each
};

/// Which body a tracker takes for which drone: mostly the right one; now and then a drone and the one nearest to it are
/// exchanged for a while. A body that is confused already, or has no other beside it, is left alone.
class BodyConfusion {
 public:
  BodyConfusion(const ConfusionParameters& parameters, std::size_t bodies, dynamics::RandomStream random);

  /// One tick, before the bodies are measured; begins and ends confusions.
  void advance(std::span<const runtime::TruthSample> truth, double dt_s) noexcept;

  /// Takes two for each other from now on for so long. Nothing where one of them is confused already, or both are one.
  void swap(std::size_t drone, std::size_t other, double for_s) noexcept;

  /// The number of the body that is taken for this drone.
  [[nodiscard]] std::size_t body_of(std::size_t drone) const noexcept { return body_of_[drone]; }

 private:
  void begin(std::span<const runtime::TruthSample> truth, std::size_t drone) noexcept;
  void end_those_over(double dt_s) noexcept;
  [[nodiscard]] bool is_confused(std::size_t drone) const noexcept { return body_of_[drone] != drone; }

  ConfusionParameters parameters_;
  dynamics::RandomStream random_;
  std::vector<std::size_t> body_of_;
  std::vector<double> left_s_;  ///< of the confusion that a drone is in
};

}  // namespace vigil::sim

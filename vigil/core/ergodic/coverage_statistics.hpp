#pragma once

#include <optional>
#include <span>

#include "vigil/core/ergodic/kernel.hpp"

namespace vigil::ergodic {

/// How coverage is averaged when the set of active drones changes (control.md 3).
enum class Accounting {
  kDroneTime,    ///< the occupation measure: every drone-second counts alike; continuous at a failure
  kElapsedTime,  ///< every second counts alike, shared by those active: (14) with the averages weighted by t1/t and (t-t1)/t
  kPaperEq14     ///< (14) as printed: the averages of all phases are added up; total mass grows by 1 with each phase
};

/// Where the swarm has spent its time, as Fourier coefficients: (K+1)^2 numbers and a few scalars, however long the mission.
/// A value: copying it copies all of it. No member but the constructor allocates. One thread at a time.
class CoverageStatistics {
 public:
  /// memory_s: time constant with which the past fades, dS = (sum f - S/memory) dt; none: a plain average.
  CoverageStatistics(const Basis& basis, Accounting accounting, std::optional<double> memory_s);

  /// Adds one sample of dt_s seconds: the active drones' positions. A sample without drones changes nothing but, for
  /// kPaperEq14, ends the phase. `active_set` tells phases apart: a number that differs whenever other drones are summed.
  void add(Kernel& kernel, std::span<const Vec2> positions, std::size_t active_set, double dt_s) noexcept;

  /// c_k of (4) or (14); all zero before the first sample.
  void average(Coefficients& c_k) const noexcept;

  /// False before the first sample and after reset().
  [[nodiscard]] bool has_samples() const noexcept;
  /// Forgets everything: "start coverage afresh".
  void reset() noexcept;

 private:
  // (the implementer completes this)
};

}  // namespace vigil::ergodic

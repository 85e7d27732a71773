#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "vigil/core/ergodic/kernel.hpp"

namespace vigil::ergodic {

/// How coverage is averaged when the set of active drones changes (control.md 3).
enum class Accounting {
  kDroneTime,    ///< the occupation measure: every drone-second counts alike; continuous at a failure
  kElapsedTime,  ///< every second counts alike, shared by those active: (14) with the averages weighted by t1/t and
                 ///< (t-t1)/t
  kPaperEq14     ///< (14) as printed: the averages of all phases are added up; total mass grows by 1 with each phase
};

/// All that coverage statistics remember, for keeping and taking up again.
struct CoverageRecord {
  Coefficients sum;            ///< S_k, see below
  double time_s = 0.0;         ///< T
  Coefficients past_averages;  ///< of finished phases
  bool has_samples = false;
};

/// Where the swarm has spent its time, as Fourier coefficients: (K+1)^2 numbers and a few scalars, however long the
/// mission. A value: copying it copies all of it. No member but the constructor allocates. One thread at a time.
class CoverageStatistics {
 public:
  /// memory_s: time constant with which the past fades, dS = (sum f - S/memory) dt, solved exactly for drones that stay
  /// where they are during a sample; none: a plain average. With kPaperEq14 the past fades within a phase; finished
  /// phases keep their mass of 1. Precondition: memory_s > 0.
  CoverageStatistics(const Basis& basis, Accounting accounting, std::optional<double> memory_s);

  /// Adds one sample of dt_s > 0 seconds: the active drones' positions. A sample without drones changes nothing but,
  /// for kPaperEq14, ends the phase. `active_set` tells phases apart: a number that differs whenever other drones are
  /// summed. Precondition: the kernel is one of the same basis; positions finite.
  void add(Kernel& kernel, std::span<const Vec2> positions, std::size_t active_set, double dt_s) noexcept;
  /// The same where somebody else sums up: add_basis(weight, sum_k) adds weight times the sum of f_k over the drones.
  template <typename AddBasis>
  void add_by(const AddBasis& add_basis, std::size_t drones, std::size_t active_set, double dt_s) noexcept {
    if (!begin_sample(drones, active_set, dt_s)) return;
    add_basis(gain_s(dt_s, drones), sum_);
  }

  /// c_k of (4) or (14), 1/m; all zero before the first sample. Precondition: c_k is (K+1) x (K+1).
  void average(Coefficients& c_k) const noexcept;

  /// d_k = T (c_k - phi_k), s/m: how much too long drones have been where f_k is. Precondition: both (K+1) x (K+1).
  void excess(const Coefficients& phi_k, Coefficients& d_k) const noexcept;
  /// What another sample, add() of the same active set, would make of excess(): d_k before it becomes d_k after it.
  /// Precondition as for add(); at least one position.
  void foresee(Kernel& kernel, std::span<const Vec2> positions, const Coefficients& phi_k, double dt_s,
               Coefficients& d_k) const noexcept;
  /// The share of the past that is left after dt_s.
  [[nodiscard]] double kept(double dt_s) const noexcept;
  /// What the newest sample, of dt_s and so many drones, makes up of all that is remembered, (0, 1]; 0: there is none.
  [[nodiscard]] double share_of_newest(double dt_s, std::size_t drones) const noexcept {
    return time_s_ > 0.0 && drones > 0 ? gain_s(dt_s, drones) * static_cast<double>(drones) / time_s_ : 0.0;
  }
  /// How many seconds a sample of dt_s adds for each of its drones.
  [[nodiscard]] double gain_s(double dt_s, std::size_t drones) const noexcept;

  /// False before the first sample and after reset().
  [[nodiscard]] bool has_samples() const noexcept { return has_samples_; }
  /// Forgets everything: "start coverage afresh".
  void reset() noexcept;

  /// Copies what is remembered. Allocates nothing where `out` has been written before.
  void write(CoverageRecord& out) const;
  /// Goes on from what was written. False, and nothing changed, where it has another shape or is not finite.
  [[nodiscard]] bool read(const CoverageRecord& record);

 private:
  /// All of a sample but its sums; false where there are none.
  [[nodiscard]] bool begin_sample(std::size_t drones, std::size_t active_set, double dt_s) noexcept;
  void end_phase() noexcept;

  Accounting accounting_;
  std::optional<double> memory_s_;
  Coefficients sum_;            ///< S_k: the integral of f_k over time, summed over drones (averaged for kElapsedTime)
  double time_s_ = 0.0;         ///< T: the same integral of 1
  Coefficients past_averages_;  ///< the sum of the finished phases' averages; stays zero but for kPaperEq14
  std::size_t active_set_ = 0;
  bool has_samples_ = false;
};

}  // namespace vigil::ergodic

#pragma once

#include <cstdint>

#include "vigil/core/field/vec2.hpp"

namespace vigil::dynamics {

/// A seeded stream of random numbers: the same bits on every machine for the integers, and for the rest as far as the C
/// library's log, sin and cos are the same. Eight bytes, so that a hundred thousand drones can each have their own.
class RandomStream {
 public:
  /// Streams of one seed that differ in `drone` (or whatever else is numbered so) or in `purpose` are independent of
  /// each other: what one drone's tracker draws never moves another's.
  RandomStream(std::uint64_t seed, std::uint64_t drone, std::uint64_t purpose);

  [[nodiscard]] std::uint64_t next() noexcept;
  [[nodiscard]] double uniform() noexcept;                        ///< in (0, 1)
  [[nodiscard]] double exponential(double mean) noexcept;         ///< >= 0
  [[nodiscard]] Vec2 normal(double standard_deviation) noexcept;  ///< two independent numbers

 private:
  std::uint64_t state_;
};

}  // namespace vigil::dynamics

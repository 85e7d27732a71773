#pragma once

#include <cstddef>
#include <cstdint>

namespace vigil::safety {

/// Some planar problems side by side, number by number, and their solutions: what is between PlanarQpBatch and its
/// loops, which are compiled for other instructions. So there is no function in it, and nothing is included that has
/// one.
struct alignas(64) PlanarQpColumns {
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kMostRows = 24;  ///< of each problem

  // The problems. All lanes have `rows` rows: those that a problem does not have hold for every velocity.
  alignas(64) double u_nom_x[kLanes];
  alignas(64) double u_nom_y[kLanes];
  alignas(64) double normal_x[kMostRows][kLanes];
  alignas(64) double normal_y[kMostRows][kLanes];
  alignas(64) double offset[kMostRows][kLanes];
  std::size_t rows;

  // The solutions, as PlanarQpSolution has them.
  alignas(64) double u_x[kLanes];
  alignas(64) double u_y[kLanes];
  alignas(64) double line[kLanes];  ///< a row; -1: none
  alignas(64) double end[kLanes];   ///< a row; -1: none
  std::uint8_t on_disk;             ///< a bit for each lane
  std::uint8_t is_solved;           ///< a bit for each lane; where it is not set: has to be given to solve()
};

// Each in a source of its own, compiled for these instructions.
void solve_portable(PlanarQpColumns& problems, double radius) noexcept;
void solve_avx2(PlanarQpColumns& problems, double radius) noexcept;
void solve_avx512(PlanarQpColumns& problems, double radius) noexcept;

}  // namespace vigil::safety

#pragma once

/// What the planar solver and its batches, which must agree to the last bit, have in common.
namespace vigil::safety::planar_qp {

/// Some rounding errors: what separates a row that holds exactly from one that is broken, relative to the numbers in
/// it: sixteen times the distance from 1 to the next number.
inline constexpr double kRounding = 16.0 * 0x1p-52;
/// Rows that differ by no more than this in direction are parallel but for rounding.
inline constexpr double kParallel = 1e-14;

/// A normal whose square is no farther from 1 is a unit vector.
inline constexpr double kUnit = 4.0 * 0x1p-52;

}  // namespace vigil::safety::planar_qp

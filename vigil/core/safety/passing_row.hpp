#pragma once

#include <optional>

#include "vigil/core/safety/body.hpp"
#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety {

/// Lets a drone pass by what flies straight on as if nobody were there: the half-plane of velocities with which, held
/// on, it comes no closer to it than radius_m, on one of the two sides. Of all velocities that do so it is the half
/// that a tangent of the cone of colliding ones bounds; which tangent, u_nom says: the side that it is on already.
///
/// Fleeing along the line between the two, as the rows of barrier.hpp ask, is right whatever the other one does next;
/// but from what is as fast as the drone itself it only puts off what has to come. Lags are taken in: both points run
/// ahead by lag v, so that z_ij + (t - lag) (u - v_j) is where they will be to each other.
///
/// None where it is that close already, or where it comes no closer by itself. `own` is controlled.
[[nodiscard]] std::optional<HalfPlane> passing_row(const BarrierParameters& parameters, const Body& own,
                                                   const Body& other, double radius_m, const Vec2& u_nom,
                                                   Priority priority);

}  // namespace vigil::safety

#pragma once

#include "vigil/core/dynamics/gauss_markov.hpp"
#include "vigil/core/dynamics/vec3.hpp"

namespace vigil::dynamics {

/// A mean wind with gusts like Dryden's (first order in every axis), and how a vehicle takes it. Frame: field, z up.
///
/// Moving air pushes a vehicle by its drag, d (w - v). The part with v is in the vehicle's recorded response already;
/// the part with w arrives as acceleration, less what the autopilot has learnt to lean against it, which follows the
/// wind with the rejection time:  push = d (w - w^),  w^' = (w - w^) / rejection.  So a steady wind moves nothing, a
/// gust of speed g pushes by up to d g, and the velocity that this costs is what the loop's own stiffness leaves of it.
struct Wind {
  Vec3 mean_m_s = Vec3::Zero();
  GaussMarkov gusts{0.0, 3.0};  ///< x and y, m/s
  GaussMarkov vertical_gusts{0.0, 1.0};
  double drag_per_s = 0.3;        ///< d: not recorded with wind; a light vehicle's is about 0.3, a heavy one's less
  double rejection_time_s = 1.5;  ///< > 0: how quickly the autopilot leans against a change
};

struct WindState {
  Vec3 gust = Vec3::Zero();      ///< m/s, beside the mean
  Vec3 rejected = Vec3::Zero();  ///< w^, m/s
};

/// The wind has been blowing for long: gusts drawn from their distribution, the mean rejected.
[[nodiscard]] WindState settled_wind(const Wind& wind, const Vec3& normals) noexcept;

/// dt_s later; `normals`: fresh standard normal draws. The gusts are exact for every dt_s, what is rejected follows the
/// gust at the step's end. Precondition: dt_s >= 0.
[[nodiscard]] WindState advance(const Wind& wind, const WindState& state, const Vec3& normals, double dt_s) noexcept;

/// The moving air, m/s.
[[nodiscard]] Vec3 air_velocity(const Wind& wind, const WindState& state) noexcept;

/// What advance(VehicleModel) takes as push, m/s^2.
[[nodiscard]] Vec3 push_of(const Wind& wind, const WindState& state) noexcept;

}  // namespace vigil::dynamics

#pragma once

#include "vigil/core/dynamics/vec3.hpp"

namespace vigil::dynamics {

/// First-order Gauss-Markov noise: normal, of standard deviation sigma, its correlation falling as exp(-t / time).
struct GaussMarkov {
  double sigma = 0.0;   ///< >= 0, the unit of what wanders
  double time_s = 1.0;  ///< > 0
};

/// What the process is dt_s after it was `value`; exact for every dt_s >= 0:
/// x(t + dt) = rho x(t) + sigma sqrt(1 - rho^2) n,  rho = exp(-dt / time). `normal`: a fresh standard normal draw.
[[nodiscard]] double advance(const GaussMarkov& process, double value, double normal, double dt_s) noexcept;

/// The same, each axis by itself.
[[nodiscard]] Vec3 advance(const GaussMarkov& process, const Vec3& value, const Vec3& normals, double dt_s) noexcept;

/// What satellite navigation says: the truth, a slowly wandering bias and white noise. Metres.
struct SatelliteNavigation {
  GaussMarkov bias{};         ///< each axis of the plane
  GaussMarkov height_bias{};  ///< commonly about twice as large
  double noise_sigma = 0.0;   ///< white, each axis
};

/// 2 m (1 sigma) that wander within a minute. A real receiver's errors are shared by its neighbours; here each vehicle
/// has its own, which is the worse case for keeping apart.
[[nodiscard]] SatelliteNavigation plain_satellite_navigation() noexcept;

/// 0.03 m: corrected by a reference station.
[[nodiscard]] SatelliteNavigation corrected_satellite_navigation() noexcept;

/// The bias dt_s after it was `bias`; one that starts: advance() from zero by an infinite dt_s.
[[nodiscard]] Vec3 advance(const SatelliteNavigation& navigation, const Vec3& bias, const Vec3& normals,
                           double dt_s) noexcept;

/// The measured position; `normals` are draws of their own.
[[nodiscard]] Vec3 measured(const SatelliteNavigation& navigation, const Vec3& truth, const Vec3& bias,
                            const Vec3& normals) noexcept;

}  // namespace vigil::dynamics

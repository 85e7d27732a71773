#include "vigil/core/dynamics/gauss_markov.hpp"

#include <cmath>

namespace vigil::dynamics {

double advance(const GaussMarkov& process, double value, double normal, double dt_s) noexcept {
  const double kept = std::exp(-dt_s / process.time_s);
  const double fresh = std::sqrt(-std::expm1(-2.0 * dt_s / process.time_s));
  return kept * value + process.sigma * fresh * normal;
}

Vec3 advance(const GaussMarkov& process, const Vec3& value, const Vec3& normals, double dt_s) noexcept {
  return {advance(process, value.x(), normals.x(), dt_s), advance(process, value.y(), normals.y(), dt_s),
          advance(process, value.z(), normals.z(), dt_s)};
}

SatelliteNavigation plain_satellite_navigation() noexcept {
  return {.bias = {2.0, 60.0}, .height_bias = {4.0, 60.0}, .noise_sigma = 0.05};
}

SatelliteNavigation corrected_satellite_navigation() noexcept {
  return {.bias = {0.03, 60.0}, .height_bias = {0.06, 60.0}, .noise_sigma = 0.005};
}

Vec3 advance(const SatelliteNavigation& navigation, const Vec3& bias, const Vec3& normals, double dt_s) noexcept {
  return {advance(navigation.bias, bias.x(), normals.x(), dt_s), advance(navigation.bias, bias.y(), normals.y(), dt_s),
          advance(navigation.height_bias, bias.z(), normals.z(), dt_s)};
}

Vec3 measured(const SatelliteNavigation& navigation, const Vec3& truth, const Vec3& bias,
              const Vec3& normals) noexcept {
  return truth + bias + navigation.noise_sigma * normals;
}

}  // namespace vigil::dynamics

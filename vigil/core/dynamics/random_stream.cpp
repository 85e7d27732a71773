#include "vigil/core/dynamics/random_stream.hpp"

#include <cmath>
#include <numbers>

namespace vigil::dynamics {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15U;

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every input bit moves every output bit.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t drone, std::uint64_t purpose)
    : state_(mix(mix(mix(seed + kGoldenGamma) + drone) * kGoldenGamma + purpose)) {}

std::uint64_t RandomStream::next() noexcept {
  state_ += kGoldenGamma;
  return mix(state_);
}

double RandomStream::uniform() noexcept {
  constexpr double kUlp = 0x1.0p-53;
  return (static_cast<double>(next() >> 11U) + 0.5) * kUlp;
}

double RandomStream::exponential(double mean) noexcept { return -mean * std::log(uniform()); }

Vec2 RandomStream::normal(double standard_deviation) noexcept {
  const double radius = standard_deviation * std::sqrt(-2.0 * std::log(uniform()));  // Box and Muller
  const double angle = 2.0 * std::numbers::pi * uniform();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace vigil::dynamics

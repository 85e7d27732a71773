#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vigil::console {

/// The drones that clients are shown: all of a fleet, or, of a very large one, some that are spread over it. A fleet of
/// as many drones always has the same ones, so that a client may follow each of them. A value.
class ShownDrones {
 public:
  static constexpr std::size_t kMost = 10'000;
  static constexpr std::uint32_t kNotShown = 0xFFFFFFFF;

  explicit ShownDrones(std::size_t drones);

  /// Ascending. Clients number drones by their place in this list.
  [[nodiscard]] std::span<const std::size_t> drones() const& { return drones_; }
  std::span<const std::size_t> drones() const&& = delete;  // they would be gone at once
  [[nodiscard]] std::size_t size() const { return drones_.size(); }
  /// A drone's place in it, or kNotShown.
  [[nodiscard]] std::uint32_t place_of(std::size_t drone) const { return places_[drone]; }

 private:
  std::vector<std::size_t> drones_;
  std::vector<std::uint32_t> places_;  ///< by drone
};

}  // namespace vigil::console

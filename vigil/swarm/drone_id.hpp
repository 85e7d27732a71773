#pragma once

#include <compare>
#include <cstddef>

namespace vigil::swarm {

/// Which drone of the fleet, counted from 0 in the mission file's order. Does not mix with other numbers.
class DroneId {
 public:
  DroneId() = default;
  explicit constexpr DroneId(std::size_t index) : index_(index) {}
  [[nodiscard]] constexpr std::size_t index() const { return index_; }
  friend constexpr auto operator<=>(DroneId, DroneId) = default;

 private:
  std::size_t index_ = 0;
};

}  // namespace vigil::swarm

#pragma once

#include <variant>
#include <vector>

#include "vigil/core/dynamics/planar_vehicle.hpp"
#include "vigil/core/dynamics/velocity_loop.hpp"

namespace vigil::sim {

/// What a vehicle's velocity does with its command: a single integrator or first-order lag, or an autopilot's loop.
using MotionModel = std::variant<dynamics::PlanarVehicle, dynamics::VelocityLoop>;

/// Where one vehicle is in the plane and how it moves, its model's dead time included. Field frame.
class PlanarMotion {
 public:
  /// `dead_ticks`: every command acts so many steps later.
  PlanarMotion(const MotionModel& model, std::size_t dead_ticks);

  /// Stands still there from now on, with no command under way.
  void rest_at(const Vec2& position) noexcept;

  /// One step under the velocity command of `dead_ticks` steps before, pushed from outside (m/s^2). Of a lag with an
  /// acceleration limit, the limit holds for all acceleration, the push included; an ideal vehicle feels no push.
  void advance(const Vec2& command, double dt_s, const Vec2& push) noexcept;

  [[nodiscard]] const Vec2& position() const noexcept { return state_.position; }
  [[nodiscard]] const Vec2& velocity() const noexcept { return state_.velocity; }

 private:
  [[nodiscard]] const Vec2& exchange(const Vec2& command) noexcept;

  MotionModel model_;
  dynamics::PlanarLoopState state_;
  std::vector<Vec2> commands_;  ///< ring: those of the dead time, and this step's
  std::size_t next_ = 0;
};

}  // namespace vigil::sim

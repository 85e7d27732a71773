#pragma once

#include <optional>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/vec2.hpp"

namespace vigil::guidance {

/// Something that flies as it likes, as if nobody were there. Field frame.
struct Stray {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
};

struct AsideParameters {
  field::Field field;
  double wall_distance_m = 0.0;  ///< >= 0, what is closer to a wall is no room
  double room_m = 0.0;           ///< > 0, kept beside a stray's line of flight
  double u_max_m_s = 0.0;        ///< > 0
  double answer_s = 0.0;         ///< >= 0: how long a drone takes to fly as it is told
};

/// True for a stray that is fast enough for a drone to be in its way: what is slower can be flown away from.
[[nodiscard]] bool is_fast(const AsideParameters& parameters, const Stray& stray) noexcept;

/// What a drone at `place` should wish that stands in the way of a stray: to leave its line of flight sideways, with
/// u_max, in the time that this takes and as much again. To flee straight ahead of what is as fast as oneself ends at a
/// wall. To the nearer side, or to the other one where a wall leaves no room there, and more on that one. None for a
/// drone that is not in its way, or where the stray is not fast. It only wishes; the safety filter decides.
/// Precondition: all finite.
[[nodiscard]] std::optional<Vec2> step_aside(const AsideParameters& parameters, const Stray& stray,
                                             const Vec2& place) noexcept;

}  // namespace vigil::guidance

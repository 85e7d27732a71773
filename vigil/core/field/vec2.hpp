#pragma once

#include <Eigen/Core>

namespace vigil {

/// A point or vector of the plane. Metres or metres per second, field frame, unless its name says otherwise.
using Vec2 = Eigen::Vector2d;

}  // namespace vigil

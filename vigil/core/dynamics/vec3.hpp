#pragma once

#include <Eigen/Core>

namespace vigil {

/// A point or vector of space, z up. Metres or metres per second, field frame, unless its name says otherwise.
using Vec3 = Eigen::Vector3d;

}  // namespace vigil

#include "vigil/core/ergodic/literal_kernel.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace vigil::ergodic {
namespace {

// grad f_k(p): (8), with L2 in its second component.
Vec2 basis_gradient(const Basis& basis, int k1, int k2, const Vec2& p) {
  const double kappa_x = k1 * std::numbers::pi / basis.field().length_x;
  const double kappa_y = k2 * std::numbers::pi / basis.field().length_y;
  const double along_x = -kappa_x * std::sin(kappa_x * p.x()) * std::cos(kappa_y * p.y());
  const double along_y = -kappa_y * std::cos(kappa_x * p.x()) * std::sin(kappa_y * p.y());
  return Vec2(along_x, along_y) / basis.norm()(k1, k2);
}

}  // namespace

void add_basis_literally(const Basis& basis, std::span<const Vec2> positions, std::span<const double> weights,
                         Coefficients& sum_k) {
  assert(positions.size() == weights.size());
  for (std::size_t i = 0; i < positions.size(); ++i) sum_k += weights[i] * basis.evaluate(positions[i]);
}

void gradient_literally(const Basis& basis, std::span<const Vec2> positions, const Coefficients& a_k,
                        std::span<Vec2> out) {
  assert(positions.size() == out.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    out[i].setZero();
    for (int k1 = 0; k1 <= basis.max_index(); ++k1) {
      for (int k2 = 0; k2 <= basis.max_index(); ++k2) {
        out[i] += a_k(k1, k2) * basis_gradient(basis, k1, k2, positions[i]);  // (7)
      }
    }
  }
}

}  // namespace vigil::ergodic

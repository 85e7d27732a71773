#pragma once

// For the files that multiply with one instruction set each. The macro Eigen stands for another name in each of them:
// otherwise the linker would take one file's code for all.

#include <Eigen/Core>

#include "bench/matrix_product.hpp"

namespace vigil::bench {
namespace {

void multiply_here(const double* a, const double* b, double* c) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::Map<Matrix>(c, kProductSide, kProductSide).noalias() =
      Eigen::Map<const Matrix>(a, kProductSide, kProductSide) * Eigen::Map<const Matrix>(b, kProductSide, kProductSide);
}

}  // namespace
}  // namespace vigil::bench

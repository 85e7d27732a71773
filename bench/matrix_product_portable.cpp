#define Eigen Eigen_portable  // see the header

#include "bench/matrix_product_template.hpp"

namespace vigil::bench {

void multiply_portable(const double* a, const double* b, double* c) { multiply_here(a, b, c); }

}  // namespace vigil::bench

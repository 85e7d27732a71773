#define Eigen Eigen_avx2  // see the header

#include "bench/matrix_product_template.hpp"

namespace vigil::bench {

void multiply_avx2(const double* a, const double* b, double* c) { multiply_here(a, b, c); }

}  // namespace vigil::bench

#pragma once

#include <cstddef>

namespace vigil::testing {

/// Counts the heap allocations that the calling thread makes from here on: operator new, but also malloc and its
/// relatives, which Eigen calls directly. For tests, on Linux with glibc; works under the sanitizers too. Linking
/// vigil::testing is enough. One thread: construct and ask on the same one.
class AllocationGuard {
 public:
  AllocationGuard();

  [[nodiscard]] std::size_t allocations() const;

 private:
  std::size_t at_start_;
};

}  // namespace vigil::testing

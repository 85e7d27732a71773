#include "vigil/testing/allocation_guard.hpp"

#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace vigil::testing {
namespace {

// The compiler may drop an allocation that nobody looks at.
template <typename T>
void look_at(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

TEST(AllocationGuardTest, Nothing_is_counted_where_nothing_is_allocated) {
  const AllocationGuard guard;
  const int number = 3;
  look_at(number);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(AllocationGuardTest, It_counts_what_new_and_containers_allocate) {
  const AllocationGuard guard;
  const auto number = std::make_unique<int>(3);
  look_at(*number);
  const std::vector<double> numbers(100);
  look_at(numbers[0]);
  EXPECT_EQ(guard.allocations(), 2U);
}

TEST(AllocationGuardTest, It_counts_what_Eigen_allocates) {
  const AllocationGuard guard;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(30, 30);
  look_at(matrix(0, 0));
  EXPECT_EQ(guard.allocations(), 1U);
}

TEST(AllocationGuardTest, It_counts_aligned_allocations) {
  struct alignas(64) Wide {
    double numbers[8];
  };
  const AllocationGuard guard;
  const auto wide = std::make_unique<Wide>();
  look_at(*wide);
  EXPECT_EQ(guard.allocations(), 1U);
}

TEST(AllocationGuardTest, Another_thread_s_allocations_are_not_counted) {
  std::size_t starting_a_thread = 0;
  for (const std::size_t count : {0U, 50U}) {
    const AllocationGuard guard;
    std::thread([count] {
      for (std::size_t i = 0; i < count; ++i) look_at(*std::make_unique<int>(3));
    }).join();
    if (count == 0) starting_a_thread = guard.allocations();
    EXPECT_LE(guard.allocations(), starting_a_thread);
  }
}

}  // namespace
}  // namespace vigil::testing

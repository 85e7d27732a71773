#include "vigil/runtime/chosen_evenly.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

TEST(ChosenEvenly, Few_are_all_chosen) {
  EXPECT_EQ(chosen_evenly(3, 400), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(chosen_evenly(3, 3), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(chosen_evenly(0, 400).empty());
}

TEST(ChosenEvenly, Each_quarter_of_a_grid_has_its_quarter_of_the_chosen_however_wide_it_is) {
  constexpr std::size_t kCount = 100'000;
  constexpr std::size_t kMost = 400;
  for (const std::size_t columns : {100U, 250U, 316U, 317U, 400U, 500U, 1000U}) {
    const std::vector<std::size_t> chosen = chosen_evenly(kCount, kMost);
    ASSERT_EQ(chosen.size(), kMost);
    EXPECT_TRUE(std::adjacent_find(chosen.begin(), chosen.end(), std::greater_equal<>()) == chosen.end());
    EXPECT_LT(chosen.back(), kCount);
    std::array<std::size_t, 4> along_x{};
    std::array<std::size_t, 4> along_y{};
    for (const std::size_t number : chosen) {
      ++along_x[4 * (number % columns) / columns];
      ++along_y[4 * number / kCount];
    }
    for (const std::size_t share : along_x) EXPECT_NEAR(static_cast<double>(share), 100.0, 30.0) << columns;
    for (const std::size_t share : along_y) EXPECT_NEAR(static_cast<double>(share), 100.0, 1.0) << columns;
  }
}

}  // namespace
}  // namespace vigil::runtime

#include "vigil/core/field/cell_cover.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::field {
namespace {

constexpr Field kField{.length_x = 3.0, .length_y = 2.0};
constexpr GridShape kShape{.nx = 12, .ny = 7};

double cell_area() { return kField.area() / static_cast<double>(kShape.nx * kShape.ny); }

// A triangle has an area unless its corners are in line, and is simple then.
Polygon triangle(int low, int high) {
  const auto corner = [&] { return Vec2(*rc::gen::inRange(low, high) * 1e-3, *rc::gen::inRange(low, high) * 1e-3); };
  return {{corner(), corner(), corner()}};
}

TEST(CellCoverTest, A_rectangle_covers_each_cell_by_the_product_of_its_overlaps) {
  const Polygon rectangle{{{0.3, 0.2}, {2.1, 0.2}, {2.1, 1.7}, {0.3, 1.7}}};
  const Eigen::ArrayXXd share = covered_share(rectangle, kField, kShape);
  const auto overlap = [](double from, double to, double side, Eigen::Index n, Eigen::Index i) {
    const double cell = side / static_cast<double>(n);
    const double begin = cell * static_cast<double>(i);
    return std::max(0.0, std::min(to, begin + cell) - std::max(from, begin)) / cell;
  };
  for (Eigen::Index ix = 0; ix < kShape.nx; ++ix) {
    for (Eigen::Index iy = 0; iy < kShape.ny; ++iy) {
      EXPECT_NEAR(share(ix, iy), overlap(0.3, 2.1, 3.0, 12, ix) * overlap(0.2, 1.7, 2.0, 7, iy), 1e-14);
    }
  }
}

TEST(CellCoverTest, The_whole_field_covers_every_cell_exactly) {
  const Polygon beyond{{{-1.0, -1.0}, {4.0, -1.0}, {4.0, 3.0}, {-1.0, 3.0}}};
  EXPECT_TRUE((covered_share(beyond, kField, kShape) == 1.0).all());
  const Polygon just{{{0.0, 0.0}, {0.0, 2.0}, {3.0, 2.0}, {3.0, 0.0}}};
  EXPECT_TRUE((covered_share(just, kField, kShape) == 1.0).all());
}

TEST(CellCoverTest, A_polygon_elsewhere_covers_nothing) {
  for (const Vec2& away : {Vec2(5.0, 0.0), Vec2(-5.0, 0.0), Vec2(0.0, 5.0), Vec2(0.0, -5.0)}) {
    const Polygon polygon{{away, away + Vec2(1.0, 0.1), away + Vec2(0.3, 1.0)}};
    EXPECT_TRUE((covered_share(polygon, kField, kShape) == 0.0).all());
  }
}

TEST(CellCoverTest, A_sliver_within_one_cell_has_its_own_area) {
  const Polygon sliver{{{0.30, 0.30}, {0.40, 0.31}, {0.30, 0.32}}};
  const Eigen::ArrayXXd share = covered_share(sliver, kField, kShape);
  EXPECT_NEAR(share(1, 1), area(sliver) / cell_area(), 1e-13);
  EXPECT_NEAR(share.sum(), share(1, 1), 1e-15);
}

RC_GTEST_PROP(CellCoverTest, The_shares_of_a_polygon_within_the_field_add_up_to_its_area, ()) {
  const Polygon polygon = triangle(0, 2000);
  RC_PRE(area(polygon) > 1e-6);
  const Eigen::ArrayXXd share = covered_share(polygon, kField, kShape);
  RC_ASSERT(std::abs(share.sum() * cell_area() - area(polygon)) < 1e-8);
  RC_ASSERT(share.minCoeff() >= 0.0);
  RC_ASSERT(share.maxCoeff() <= 1.0);
}

RC_GTEST_PROP(CellCoverTest, Every_share_is_what_a_fine_raster_counts, ()) {
  const Polygon polygon = triangle(-1000, 4000);
  RC_PRE(area(polygon) > 1e-6);
  const Eigen::ArrayXXd share = covered_share(polygon, kField, {4, 3});
  constexpr Eigen::Index kFine = 40;
  for (Eigen::Index ix = 0; ix < 4; ++ix) {
    for (Eigen::Index iy = 0; iy < 3; ++iy) {
      int inside = 0;
      for (Eigen::Index i = 0; i < kFine * kFine; ++i) {
        const Vec2 sample(static_cast<double>(i % kFine) + 0.5, static_cast<double>(i / kFine) + 0.5);
        const Vec2 cell(static_cast<double>(ix), static_cast<double>(iy));
        inside += contains(polygon, (cell + sample / kFine).cwiseProduct(Vec2(3.0 / 4.0, 2.0 / 3.0)));
      }
      RC_ASSERT(std::abs(share(ix, iy) - static_cast<double>(inside) / (kFine * kFine)) < 3.0 / kFine);
    }
  }
}

RC_GTEST_PROP(CellCoverTest, The_orientation_does_not_matter, ()) {
  Polygon polygon = triangle(-1000, 4000);
  RC_PRE(area(polygon) > 1e-6);
  const Eigen::ArrayXXd share = covered_share(polygon, kField, kShape);
  std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  RC_ASSERT((share - covered_share(polygon, kField, kShape)).abs().maxCoeff() < 1e-12);
}

}  // namespace
}  // namespace vigil::field

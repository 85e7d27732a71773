#include "vigil/adapters/ros/mission_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Cholesky>

#include "vigil/core/field/density.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::ros_bridge {
namespace {

constexpr Colour kGround{0.11F, 0.11F, 0.13F, 1.0F};
constexpr Colour kBorder{0.85F, 0.85F, 0.85F, 1.0F};
constexpr Colour kTarget{1.0F, 0.85F, 0.75F, 1.0F};
constexpr Colour kEllipse{1.0F, 0.55F, 0.45F, 1.0F};
constexpr Colour kNoFly{0.35F, 0.55F, 1.0F, 1.0F};
constexpr double kGroundZ = -0.02;  // below the density
constexpr double kLineZ = 0.005;    // above it

/// Lines look alike in a room and on a field of hectares.
double line_m(const runtime::Mission& mission) { return 0.004 * runtime::monitored_field(mission).shorter_side(); }

Mark ground(const runtime::Mission& mission) {
  const field::Field field = runtime::monitored_field(mission);
  constexpr double kThickness = 0.01;
  return {.set = "ground",
          .kind = Mark::Kind::kBox,
          .colour = kGround,
          .place = in_world(mission, 0.5 * Vec2(field.length_x, field.length_y), kGroundZ - kThickness),
          .yaw_rad = mission.field.yaw_rad,
          .size = {field.length_x, field.length_y, kThickness},
          .points = {},
          .text = {}};
}

Mark line(const runtime::Mission& mission, const char* set, Colour colour) {
  Mark mark;
  mark.set = set;
  mark.colour = colour;
  mark.size.x = line_m(mission);
  return mark;
}

Mark border(const runtime::Mission& mission) {
  const field::Field field = runtime::monitored_field(mission);
  Mark mark = line(mission, "field", kBorder);
  for (const Vec2& corner :
       {Vec2(0, 0), Vec2(field.length_x, 0), Vec2(field.length_x, field.length_y), Vec2(0, field.length_y), Vec2(0, 0)})
    mark.points.push_back(in_world(mission, corner, kLineZ));
  return mark;
}

Mark outline(const runtime::Mission& mission, const char* set, Colour colour, std::span<const Vec2> corners_W) {
  Mark mark = line(mission, set, colour);
  for (const Vec2& corner : corners_W) mark.points.push_back({corner.x(), corner.y(), kLineZ});
  if (!mark.points.empty()) mark.points.push_back(mark.points.front());
  return mark;
}

Mark points_of(const runtime::Mission& mission, const runtime::ClusterEntry& cluster) {
  Mark mark = line(mission, "target points", kTarget);
  mark.kind = Mark::Kind::kPoints;
  mark.size.x = mark.size.y = 3.0 * line_m(mission);
  for (const Vec2& point : cluster.points_m)
    mark.points.push_back(in_world(mission, runtime::target_in_field(mission, point), kLineZ));
  return mark;
}

/// The points at two standard deviations: mean + 2 L (cos a, sin a) with L L' = covariance.
Mark ellipse_of(const runtime::Mission& mission, const runtime::ClusterEntry& cluster) {
  const field::Gaussian gaussian =
      field::fit(runtime::cluster_in_field(mission, cluster), runtime::sigma_min_m(mission));
  const Eigen::Matrix2d root = gaussian.covariance.llt().matrixL();
  constexpr int kCorners = 64;
  Mark mark = line(mission, "clusters", kEllipse);
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Vec2 place = gaussian.mean + 2.0 * (root * Vec2(std::cos(angle), std::sin(angle)));
    mark.points.push_back(in_world(mission, place, kLineZ));
  }
  return mark;
}

/// Marks of a set are told apart by their places in it.
void number(std::vector<Mark>& marks) {
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i].id = static_cast<int>(i);
}

}  // namespace

Point in_world(const runtime::Mission& mission, const Vec2& place, double z_m) {
  const Vec2 world = runtime::world_frame(mission).point_to_world(place);
  return {world.x(), world.y(), z_m};
}

DensityPicture density_picture(const runtime::Mission& mission) {
  const field::Field field = runtime::monitored_field(mission);
  const field::GridShape shape = runtime::grid_of(field, kDensityCells);
  const auto grid = field::rasterise(field, runtime::importance(mission), shape);
  const double highest = grid ? grid->values.maxCoeff() : 1.0;
  DensityPicture picture;
  picture.columns = static_cast<std::size_t>(shape.nx);
  picture.rows = static_cast<std::size_t>(shape.ny);
  picture.column_m = field.length_x / static_cast<double>(shape.nx);
  picture.row_m = field.length_y / static_cast<double>(shape.ny);
  picture.corner = in_world(mission, Vec2::Zero(), 0.0);
  picture.yaw_rad = mission.field.yaw_rad;
  for (Eigen::Index iy = 0; iy < shape.ny; ++iy)
    for (Eigen::Index ix = 0; ix < shape.nx; ++ix)
      picture.share_of_highest.push_back(grid ? static_cast<float>(grid->values(ix, iy) / highest) : 0.0F);
  return picture;
}

std::vector<Mark> target_marks(const runtime::Mission& mission) {
  std::vector<Mark> marks{ground(mission), border(mission)};
  for (const runtime::ClusterEntry& cluster : mission.targets.clusters) {
    marks.push_back(points_of(mission, cluster));
    marks.push_back(ellipse_of(mission, cluster));
  }
  for (const runtime::AreaEntry& area : mission.targets.areas)
    marks.push_back(outline(mission, "areas", kEllipse, area.outline_m));
  for (const runtime::NoFlyEntry& no_fly : mission.no_fly)
    marks.push_back(outline(mission, "no-fly", kNoFly, no_fly.outline_m));
  number(marks);
  return marks;
}

Colour green_of(std::size_t drone, std::size_t drones) {
  const float share =
      drones < 2 ? 0.0F : static_cast<float>(drone) / static_cast<float>(std::max<std::size_t>(drones - 1, 1));
  return {0.0F, 1.0F - 0.5F * share, 0.12F * static_cast<float>(drone % 3), 1.0F};
}

}  // namespace vigil::ros_bridge

#include "vigil/runtime/drone_grid.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

/// More rows or columns than any grid needs: keeps quotients of tiny spacings countable.
constexpr double kMostLines = 1e6;

/// A grid in the field frame: node (column, row) at first + (column step.x, row step.y).
struct Grid {
  int columns = 0;
  Vec2 first = Vec2::Zero();
  Vec2 step = Vec2::Zero();

  [[nodiscard]] Vec2 node(int number) const {
    const int column = number % columns;
    const int row = number / columns;
    return first + Vec2(column * step.x(), row * step.y());
  }
};

/// Where drones may start: the field without wall_distance_m at its border.
Vec2 free_size(const Mission& mission) {
  return mission.field.size_m - Vec2::Constant(2.0 * mission.safety.wall_distance_m);
}

double lines(double length, double step) { return std::min(std::floor(length / step * (1.0 + 1e-12)), kMostLines); }

int rows_for(int count, int columns) { return (count + columns - 1) / columns; }

/// Equal cells, a drone in the middle of each: the number of columns that makes the cells' shorter side longest.
Grid widest_grid(const Mission& mission, int count) {
  const Vec2 free = free_size(mission);
  const auto shorter_side = [&](int columns) {
    return std::min(free.x() / columns, free.y() / rows_for(count, columns));
  };
  int best = 1;
  for (int columns = 2; columns <= count; ++columns) {
    if (shorter_side(columns) > shorter_side(best)) best = columns;
  }
  const Vec2 cell(free.x() / best, free.y() / rows_for(count, best));
  return {.columns = best, .first = Vec2::Constant(mission.safety.wall_distance_m) + 0.5 * cell, .step = cell};
}

[[noreturn]] void refuse_count(const MissionSource& source, int count, double most) {
  source.refuse({.place = "",
                 .key = "drone_grid.count",
                 .value = fmt::format("{}", count),
                 .problem = "does not fit into the field",
                 .valid = fmt::format("must be at most {}", most),
                 .advice = "take fewer drones, a larger field, or a smaller safety.separation_m or spacing_m"});
}

void require_room_for_cells(const Mission& mission, const MissionSource& source, int count) {
  const double apart = safety::barrier_radius(barrier_parameters(mission));
  const Vec2 free = free_size(mission);
  const double most = std::max(1.0, lines(free.x(), apart)) * std::max(1.0, lines(free.y(), apart));
  if (count > most) refuse_count(source, count, most);
}

/// A square grid in the middle of the field, about as wide for its height as the field.
Grid spaced_grid(const Mission& mission, const MissionSource& source, int count, double spacing) {
  const double apart = safety::barrier_radius(barrier_parameters(mission));
  if (spacing < apart) {
    source.refuse({.place = "",
                   .key = "drone_grid.spacing_m",
                   .value = "",
                   .problem = "is nearer than the barrier allows at rest",
                   .valid = fmt::format("must be at least {:.6g} m", apart),
                   .advice = "take a wider spacing or a smaller safety.separation_m"});
  }
  const Vec2 free = free_size(mission);
  const double most_columns = lines(free.x(), spacing) + 1.0;
  const double most_rows = lines(free.y(), spacing) + 1.0;
  if (count > most_columns * most_rows) refuse_count(source, count, most_columns * most_rows);
  const double alike = std::ceil(std::sqrt(count * free.x() / free.y()));
  const double columns = std::clamp(alike, std::ceil(count / most_rows), most_columns);
  Grid grid{.columns = static_cast<int>(std::min(columns, static_cast<double>(count))),
            .first = Vec2::Zero(),
            .step = Vec2::Constant(spacing)};
  const Vec2 extent(spacing * (grid.columns - 1), spacing * (rows_for(count, grid.columns) - 1));
  grid.first = 0.5 * (mission.field.size_m - extent);
  return grid;
}

}  // namespace

std::vector<DroneEntry> drones_on_grid(const Mission& mission, const MissionSource& source) {
  const DroneGridSection& wanted = *mission.drone_grid;
  if (!wanted.spacing_m) require_room_for_cells(mission, source, wanted.count);
  const Grid grid = wanted.spacing_m ? spaced_grid(mission, source, wanted.count, *wanted.spacing_m)
                                     : widest_grid(mission, wanted.count);
  const field::WorldFrame frame = world_frame(mission);
  std::vector<DroneEntry> drones;
  drones.reserve(static_cast<std::size_t>(wanted.count));
  for (int i = 0; i < wanted.count; ++i) {
    drones.push_back({.id = fmt::format("{}{}", wanted.prefix, i + 1), .start_m = frame.point_to_world(grid.node(i))});
  }
  return drones;
}

}  // namespace vigil::runtime

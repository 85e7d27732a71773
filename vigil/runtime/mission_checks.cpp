#include "vigil/runtime/mission_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/parameters.hpp"

namespace vigil::runtime {
namespace {

/// Beyond this the default of sigma_min_m is too fine for the density's grid, and K waves a side say little.
constexpr double kMostElongated = 50.0;
/// The density's grid has at most so many cells a side.
constexpr double kMostCells = 1024.0;

void check_field(const Mission& mission, const MissionSource& source) {
  const field::Field field = monitored_field(mission);
  const double longer = std::max(field.length_x, field.length_y);
  if (longer > kMostElongated * field.shorter_side()) {
    source.refuse({.place = "",
                   .key = "field.size_m",
                   .value = "",
                   .problem = "is too long for its width",
                   .valid = fmt::format("must have sides of a ratio of at most {}", kMostElongated),
                   .advice = "take a wider field, or fly its parts one after the other"});
  }
  if (sigma_min_m(mission) * kMostCells < longer) {
    source.refuse({.place = "",
                   .key = "targets.sigma_min_m",
                   .value = "",
                   .problem = "is too fine for a field of this size",
                   .valid = fmt::format("must be at least {:.6g} m", longer / kMostCells),
                   .advice = "take a larger spread, or leave it out"});
  }
  if (sigma_min_m(mission) > longer) {
    source.refuse({.place = "",
                   .key = "targets.sigma_min_m",
                   .value = "",
                   .problem = "spreads every target over more than the field",
                   .valid = fmt::format("must be in [{:.6g}, {:.6g}] m", longer / kMostCells, longer),
                   .advice = "take a smaller spread, or leave it out"});
  }
}

void check_distances(const Mission& mission, const MissionSource& source) {
  const SafetySection& safety = mission.safety;
  const double shorter = monitored_field(mission).shorter_side();
  if (safety.separation_m >= shorter) {
    source.refuse({.place = "",
                   .key = "safety.separation_m",
                   .value = "",
                   .problem = "is larger than the field",
                   .valid = fmt::format("must be below the field's shorter side, {:.6g} m", shorter),
                   .advice = "take a smaller separation or a larger field"});
  }
  if (safety.contact_distance_m.value_or(0.0) > safety.separation_m) {
    source.refuse({.place = "",
                   .key = "safety.contact_distance_m",
                   .value = "",
                   .problem = "is more than separation_m",
                   .valid = fmt::format("must be in (0, {:.6g}] m", safety.separation_m),
                   .advice = "take a larger separation_m, or the bodies' true size"});
  }
  if (2.0 * safety.wall_distance_m >= shorter) {
    source.refuse({.place = "",
                   .key = "safety.wall_distance_m",
                   .value = "",
                   .problem = "leaves no room inside the field",
                   .valid = fmt::format("must be below half the field's shorter side, {:.6g} m", 0.5 * shorter),
                   .advice = "take a smaller distance or a larger field"});
  }
}

void check_lag(const Mission& mission, const MissionSource& source) {
  if (mission.safety.barrier != safety::BarrierKind::kPaper) return;
  const auto refuse_for_paper = [&](const std::string& key) {
    source.refuse({.place = "",
                   .key = key,
                   .value = "",
                   .problem = "has no meaning for the barrier `paper`",
                   .valid = "must be 0 there",
                   .advice = "take `barrier: lag_aware`, or leave it out"});
  };
  if (mission.safety.lag_s.value_or(0.0) > 0.0) refuse_for_paper("safety.lag_s");
  if (mission.safety.margin_m.value_or(0.0) > 0.0) refuse_for_paper("safety.margin_m");
  if (mission.safety.pair_margin_m.value_or(0.0) > 0.0) refuse_for_paper("safety.pair_margin_m");
}

void check_delay(const Mission& mission, const MissionSource& source) {
  if (mission.safety.barrier == safety::BarrierKind::kPaper || mission.safety.command_delay_s) return;
  const double delay_s = simulated_command_delay_s(mission);
  if (delay_s <= swarm::kLongestPredictionS) return;
  source.refuse(
      {.place = "",
       .key = "simulation.vehicle.command_delay_s",
       .value = "",
       .problem = fmt::format("makes orders act {:.4g} s late, with the link's delay and the model's", delay_s),
       .valid = fmt::format("must leave at most {:.4g} s in all, which the controller can make up for",
                            swarm::kLongestPredictionS),
       .advice = "take a shorter delay, or give safety.command_delay_s to see what happens"});
}

void check_duration(const Mission& mission, const MissionSource& source) {
  constexpr double kRounding = 1e-9;
  const double ticks = mission.simulation.duration_s * mission.control.rate_hz;
  if (ticks >= 1.0 - kRounding) return;
  source.refuse({.place = "",
                 .key = "simulation.duration_s",
                 .value = "",
                 .problem = "is shorter than one tick",
                 .valid = fmt::format("must be in [{:.6g}, {}] s", tick_s(mission), kLongestDurationS),
                 .advice = "fly for longer, or raise control.rate_hz"});
}

void check_memory(const Mission& mission, const MissionSource& source) {
  if (mission.control.memory != Memory::kEndless || !mission.control.memory_s) return;
  source.refuse({.place = "",
                 .key = "control.memory_s",
                 .value = "",
                 .problem = "has no meaning for `memory: endless`",
                 .valid = "must be left out there",
                 .advice = "take `memory: fading`, or leave it out"});
}

void check_ranges(const Mission& mission, const MissionSource& source) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const double least = safety::least_sensing_range(barrier);
  if (barrier.sensing_range_m && *barrier.sensing_range_m < least) {
    source.refuse(
        {.place = "",
         .key = "safety.sensing_range_m",
         .value = "",
         .problem = "is so short that two drones can pass the barrier within one tick",
         .valid = fmt::format("must be at least {:.6g} m: where nobody meets the barrier behind its boundary", least),
         .advice = "take a longer range, leave it out, or raise control.rate_hz"});
  }
  const double least_wall = barrier.wall_distance_m + barrier.u_max_m_s * barrier.dt_s;
  if (barrier.wall_range_m && *barrier.wall_range_m < least_wall) {
    source.refuse({.place = "",
                   .key = "safety.wall_range_m",
                   .value = "",
                   .problem = "is so short that a drone can pass the barrier within one tick",
                   .valid = fmt::format("must be at least {:.6g} m: wall_distance_m + u_max dt", least_wall),
                   .advice = "take a longer range, leave it out, or raise control.rate_hz"});
  }
}

void check_ids(const Mission& mission, const MissionSource& source) {
  if (mission.drone_grid && mission.drone_grid->prefix.size() > 24) {
    source.refuse({.place = "",
                   .key = "drone_grid.prefix",
                   .value = "",
                   .problem = "leaves no room for the number",
                   .valid = "must be at most 24 characters",
                   .advice = "shorten it"});
  }
  std::vector<std::size_t> order(mission.drones.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto id = [&](std::size_t i) -> const std::string& { return mission.drones[i].id; };
  std::ranges::stable_sort(order, {}, id);
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::string key = fmt::format("drones[{}].id", order[n]);
    if (n > 0 && id(order[n]) == id(order[n - 1])) {
      source.refuse({.place = "",
                     .key = key,
                     .value = "",
                     .problem = fmt::format("is also the id of drones[{}]", order[n - 1]),
                     .valid = "must be unique",
                     .advice = "rename one of them"});
    }
    if (id(order[n]) == "all") {
      source.refuse({.place = "",
                     .key = key,
                     .value = "",
                     .problem = "is what events call every drone",
                     .valid = "must be another word",
                     .advice = "rename it"});
    }
  }
}

/// Oler's bound: so many points that are `apart` from each other fit into a rectangle at most.
double most_points(const Vec2& size, double apart) {
  return std::floor(2.0 / std::sqrt(3.0) * size.x() * size.y() / (apart * apart) + (size.x() + size.y()) / apart + 1.0);
}

void check_room(const Mission& mission, const MissionSource& source, double apart) {
  const Vec2 free = mission.field.size_m - Vec2::Constant(2.0 * mission.safety.wall_distance_m);
  const double most = most_points(free, apart);
  if (static_cast<double>(mission.drones.size()) <= most) return;
  source.refuse({.place = "",
                 .key = "safety.separation_m",
                 .value = "",
                 .problem = fmt::format("leaves no room for {} drones", mission.drones.size()),
                 .valid = fmt::format("must let them keep {:.6g} m; at most {} drones fit so", apart, most),
                 .advice = "take fewer drones, a smaller separation or a larger field"});
}

void check_start(const Mission& mission, const MissionSource& source, std::size_t i, const Vec2& start) {
  const auto refuse_start = [&](std::string problem, std::string valid) {
    source.refuse(
        {.place = "",
         .key = fmt::format("drones[{}].start_m", i),
         .value = fmt::format("[{:.6g}, {:.6g}]", mission.drones[i].start_m.x(), mission.drones[i].start_m.y()),
         .problem = std::move(problem),
         .valid = std::move(valid),
         .advice = "move the start"});
  };
  const field::Field field = monitored_field(mission);
  const double from_wall = std::min({start.x(), start.y(), field.length_x - start.x(), field.length_y - start.y()});
  if (from_wall < -rounding_m(mission)) {
    refuse_start("is outside the field",
                 fmt::format("must be inside the field of {:.6g} m x {:.6g} m at field.origin_m", field.length_x,
                             field.length_y));
  }
  if (from_wall < mission.safety.wall_distance_m - rounding_m(mission)) {
    refuse_start(
        fmt::format("is {:.6g} m from the field's border", from_wall),
        fmt::format("must be at least safety.wall_distance_m, {:.6g} m, from it", mission.safety.wall_distance_m));
  }
}

void check_starts_and_no_fly(const Mission& mission, const MissionSource& source, const std::vector<Vec2>& starts) {
  const double buffer = barrier_parameters(mission).no_fly_buffer_m;
  for (const NoFlyEntry& entry : mission.no_fly) {
    const field::Polygon polygon = polygon_in_field(mission, entry.outline_m);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (field::signed_distance(polygon, starts[i]) >= buffer - rounding_m(mission)) continue;
      source.refuse(
          {.place = "",
           .key = fmt::format("drones[{}].start_m", i),
           .value = fmt::format("[{:.6g}, {:.6g}]", mission.drones[i].start_m.x(), mission.drones[i].start_m.y()),
           .problem = fmt::format("is in or too near to the no-fly polygon {}", entry.name),
           .valid = fmt::format("must be at least {:.6g} m from it", buffer),
           .advice = "move the start; with a drone_grid, list the drones instead"});
    }
  }
}

/// Sweeps from left to right, so that only drones near in x are compared.
void check_overlaps(const Mission& mission, const MissionSource& source, const std::vector<Vec2>& starts,
                    double apart) {
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return starts[i].x(); });
  const double least = apart - rounding_m(mission);
  for (std::size_t n = 0; n < order.size(); ++n) {
    for (std::size_t m = n; m-- > 0;) {
      const auto [first, second] = std::minmax(order[m], order[n]);
      if (starts[order[n]].x() - starts[order[m]].x() >= least) break;
      const double distance = (starts[first] - starts[second]).norm();
      if (distance >= least) continue;
      source.refuse({.place = "",
                     .key = fmt::format("drones[{}].start_m", second),
                     .value = "",
                     .problem = fmt::format("is {:.6g} m from the start of {}", distance, mission.drones[first].id),
                     .valid = fmt::format("must be at least {:.6g} m from every other start", apart),
                     .advice = "move one of them, or take a smaller safety.separation_m"});
    }
  }
}

}  // namespace

double rounding_m(const Mission& mission) {
  const double longest = std::max(1.0, mission.field.size_m.maxCoeff());
  const double farthest = mission.field.origin_m.cwiseAbs().maxCoeff();
  return 1e-9 * longest + 8.0 * std::numeric_limits<double>::epsilon() * farthest;
}

void check_numbers(const Mission& mission, const MissionSource& source) {
  check_field(mission, source);
  check_distances(mission, source);
  check_memory(mission, source);
  check_lag(mission, source);
  check_delay(mission, source);
  check_duration(mission, source);
  check_simulation(mission, source);
  check_ranges(mission, source);  // needs the margins that the simulated world leads to
}

void check_drones(const Mission& mission, const MissionSource& source) {
  check_ids(mission, source);
  const double apart = safety::barrier_radius(barrier_parameters(mission));
  const std::vector<Vec2> starts = starts_in_field(mission);
  for (std::size_t i = 0; i < starts.size(); ++i) check_start(mission, source, i, starts[i]);
  check_starts_and_no_fly(mission, source, starts);
  check_room(mission, source, apart);
  check_overlaps(mission, source, starts, apart);
}

}  // namespace vigil::runtime

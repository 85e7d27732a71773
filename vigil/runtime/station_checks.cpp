#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "vigil/runtime/mission_checks.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

struct Pad {
  Vec2 place = Vec2::Zero();  ///< field frame
  std::string key;
};

std::vector<Pad> pads_of(const Mission& mission) {
  std::vector<Pad> pads;
  for (std::size_t n = 0; n < mission.stations.size(); ++n) {
    const std::vector<Vec2>& places_W = mission.stations[n].pads_m;
    for (std::size_t i = 0; i < places_W.size(); ++i)
      pads.push_back({world_frame(mission).point_to_field(places_W[i]), fmt::format("stations[{}].pads_m[{}]", n, i)});
  }
  return pads;
}

void check_names(const Mission& mission, const MissionSource& source) {
  for (std::size_t n = 0; n < mission.stations.size(); ++n) {
    for (std::size_t before = 0; before < n; ++before) {
      if (mission.stations[before].name != mission.stations[n].name) continue;
      source.refuse({.place = "",
                     .key = fmt::format("stations[{}].name", n),
                     .value = "",
                     .problem = fmt::format("is also the name of stations[{}]", before),
                     .valid = "must be unique",
                     .advice = "rename one of them"});
    }
  }
}

/// Whether a drone that keeps clear of walls and polygons gets there.
void check_reach(const Mission& mission, const MissionSource& source, const Pad& pad) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const double reserve_m = safety::wall_reserve(barrier, {});
  const double wall_m = barrier.wall_distance_m + reserve_m;
  const field::Field field = monitored_field(mission);
  const Vec2& p = pad.place;
  const double from_wall = std::min({p.x(), p.y(), field.length_x - p.x(), field.length_y - p.y()});
  if (from_wall < wall_m - rounding_m(mission)) {
    source.refuse({.place = "",
                   .key = pad.key,
                   .value = "",
                   .problem = "is closer to the field's border than a drone flies, or outside",
                   .valid = fmt::format("must be at least {:.6g} m from it, inside", wall_m),
                   .advice = "move the pad, or widen the field"});
  }
  const double clearance_m = safety::no_fly_radius(barrier, reserve_m);
  for (const NoFlyEntry& entry : mission.no_fly) {
    if (field::signed_distance(polygon_in_field(mission, entry.outline_m), p) >= clearance_m) continue;
    source.refuse(
        {.place = "",
         .key = pad.key,
         .value = "",
         .problem = fmt::format("is in the no-fly polygon {}, or closer to it than a drone flies", entry.name),
         .valid = fmt::format("must be at least {:.6g} m from it", clearance_m),
         .advice = "move the pad"});
  }
}

/// Who comes down on one pad must not keep others from the next one.
void check_apart(const Mission& mission, const MissionSource& source, const std::vector<Pad>& pads) {
  const double apart_m = safety::barrier_radius(barrier_parameters(mission));
  for (std::size_t i = 0; i < pads.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      const double distance_m = (pads[i].place - pads[before].place).norm();
      if (distance_m >= apart_m - rounding_m(mission)) continue;
      source.refuse({.place = "",
                     .key = pads[i].key,
                     .value = "",
                     .problem = fmt::format("is {:.6g} m from {}", distance_m, pads[before].key),
                     .valid = fmt::format("must be at least {:.6g} m from every other pad", apart_m),
                     .advice = "move one of them, or take a smaller safety.separation_m"});
    }
  }
}

}  // namespace

void check_stations(const Mission& mission, const MissionSource& source) {
  check_names(mission, source);
  const std::vector<Pad> pads = pads_of(mission);
  if (pads.size() > kMostPads) {
    source.refuse({.place = "",
                   .key = "stations",
                   .value = "",
                   .problem = fmt::format("have {} pads", pads.size()),
                   .valid = fmt::format("must have at most {} in all", kMostPads),
                   .advice = "take fewer"});
  }
  for (const Pad& pad : pads) check_reach(mission, source, pad);
  check_apart(mission, source, pads);
}

}  // namespace vigil::runtime

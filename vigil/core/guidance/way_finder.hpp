#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vigil/core/guidance/way_map.hpp"

namespace vigil::guidance {

/// Leads drones to places round no-fly polygons, with a bounded number of looks a tick: whoever sees its place flies
/// straight; whoever has a corner to fly to keeps it until it is close to it or sees it no more; others ask the map.
/// Where a tick's looks do not suffice for all, everybody asks in turns, and goes on as it did between them. A value.
/// Allocates when it is constructed, and never again. One thread at a time.
class WayFinder {
 public:
  /// Looks a tick, for making the map and for asking it, each: on average, since a question is asked as a whole. A look
  /// takes some ten nanoseconds.
  static constexpr std::size_t kLooksATick = 20'000;

  WayFinder(const WayParameters& parameters, std::size_t drones);

  /// Another ground; every way is asked for anew. See WayMap::begin().
  void ground_changed(std::span<const field::Segment> no_fly) noexcept;

  /// Once a tick, before next(), which will be called for so many drones, once each: goes on making the map.
  void begin_tick(std::size_t travellers) noexcept;

  /// Goes on making the map, also where nobody travels.
  void work() noexcept;

  /// Where the drone flies straight to now, on its way to `goal`; `goal` itself where it sees it, where no way is known
  /// or it is not its turn yet. Precondition: drone < drones; finite.
  [[nodiscard]] Vec2 next(std::size_t drone, const Vec2& position, const Vec2& goal) noexcept;

  /// The length of the shortest way; the straight line's where none is known. Precondition: finite.
  [[nodiscard]] double length_m(const Vec2& from, const Vec2& to) noexcept;

  [[nodiscard]] const WayMap& map() const noexcept { return map_; }

 private:
  struct Leg {
    Vec2 goal = Vec2::Zero();
    Vec2 corner = Vec2::Zero();
    bool is_known = false;
  };

  [[nodiscard]] bool keeps(const Leg& leg, const Vec2& position, const Vec2& goal) const noexcept;

  WayMap map_;
  double close_m_;
  std::vector<Leg> legs_;
  std::size_t tick_ = 0;
  std::size_t period_ = 1;  ///< ticks, from one turn of a traveller to its next
  std::size_t asked_ = 0;   ///< calls of next() in this tick
};

}  // namespace vigil::guidance

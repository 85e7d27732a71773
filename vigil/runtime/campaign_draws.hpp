#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/mission.hpp"

/// What a campaign draws at random for one run. Pure functions of the mission and of the stream's numbers. World frame,
/// rounded to millimetres and hundredths of a second, so that a command line can say it exactly.
namespace vigil::runtime {

/// As many starts as the mission has drones: each pair farther apart than the barrier's radius, each start farther from
/// walls and no-fly polygons than their distances, all by a tenth. Nothing where no room was found for one of them.
[[nodiscard]] std::optional<std::vector<Vec2>> draw_starts(const Mission& mission, dynamics::RandomStream& random);

/// For each cluster of the mission, as many points as it has, about a random centre with the cluster's own spread;
/// inside the field and outside no-fly polygons. Nothing where no such points were found.
[[nodiscard]] std::optional<std::vector<std::vector<Vec2>>> draw_targets(const Mission& mission,
                                                                         dynamics::RandomStream& random);

/// So many incidents at random times to random drones, each of `kinds` as likely: landing, failure in the air, a
/// pilot's override at up to the speed limit, loss of tracking, hold, being marked as failed. What passes is taken back
/// up to ten seconds later, where the mission lasts that long. In the order of time. Precondition: kinds are such, and
/// not empty.
[[nodiscard]] std::vector<EventEntry> draw_incidents(const Mission& mission, std::size_t incidents,
                                                     std::span<const EventKind> kinds, dynamics::RandomStream& random);

}  // namespace vigil::runtime

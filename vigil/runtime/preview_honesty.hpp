#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "vigil/runtime/area_watch.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

/// What a preview promises, against what then happens. For tests and benchmarks.
namespace vigil::runtime {

/// When something was to happen, and when it did. Seconds from the preview on; none: not within the time that was
/// looked ahead.
struct Promise {
  std::optional<double> foreseen_s;
  std::optional<double> was_s;
};

/// |foreseen - was| / was; infinite where only one of both is there, none where neither is.
[[nodiscard]] std::optional<double> relative_error(const Promise& promise);

/// One cluster or area: until it has its share, and until all of it has been seen.
struct AreaPromise {
  TargetName what;
  Promise covered;
  Promise seen;
};

/// Makes the simulated world of a mission.
using MakeWorld = std::function<std::unique_ptr<VirtualFleet>(const Mission&)>;

/// Flies the mission until from_s, looks ahead for `seconds`, and flies on for as long. Areas that have their share
/// already are left out. Precondition: a mission that mission checks accepted.
[[nodiscard]] std::vector<AreaPromise> promises_of(const Mission& mission, const MakeWorld& make_world, double from_s,
                                                   double seconds);

/// random_mission(seed) as a preview can know it: nothing happens that is not going on already, no drone fails or is
/// lost, and nobody is on an errand. Anything else: vehicles, delays, noise, wind, controllers, barriers.
[[nodiscard]] Mission faultless_mission(std::uint64_t seed);

/// One faultless mission and what was promised for it.
struct HonestyCase {
  std::uint64_t seed = 0;
  Mission mission;
  std::vector<AreaPromise> promises;  ///< at least one
};

/// The first so many seeds' missions that leave anything to promise two seconds after their beginning, a minute ahead.
[[nodiscard]] std::vector<HonestyCase> honesty_cases(std::size_t missions, const MakeWorld& make_world);

/// The median of relative_error() over all areas of all cases; `which`: AreaPromise::covered or ::seen. What neither
/// was foreseen nor happened does not count. Precondition: something counts.
[[nodiscard]] double median_error(const std::vector<HonestyCase>& cases, Promise AreaPromise::* which);

}  // namespace vigil::runtime

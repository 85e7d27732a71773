#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "vigil/adapters/geography/track_recorder.hpp"
#include "vigil/runtime/mission_targets.hpp"

namespace vigil::geography {

/// A flight as maps draw it.
struct MappedFlight {
  const runtime::Mission& mission;         ///< with a datum
  const runtime::MissionTargets& targets;  ///< those of its end
  std::span<const Track> tracks;
  std::int64_t began_ns = 0;  ///< time of day at time 0 of the tracks, since 1970; 0: a simulated flight
};

/// RFC 7946, one FeatureCollection: field, clusters (MultiPoint), areas, no-fly polygons, and a MultiLineString for
/// each drone that has a track. `properties.kind` says which; tracks have `times_s` and `heights_m`, nested like the
/// coordinates. Degrees with eight decimals (about a millimetre). Precondition: the mission has a datum.
[[nodiscard]] std::string geojson(const MappedFlight& flight);

}  // namespace vigil::geography

#pragma once

#include <string>

#include "vigil/adapters/geography/geojson.hpp"

namespace vigil::geography {

/// KML 2.2 with Google's tracks (gx:MultiTrack), which a time slider plays: the folders "What is watched" and "Drones".
/// Heights are above the ground. A simulated flight begins at 1970-01-01T00:00:00Z. Precondition: the mission has a
/// datum.
[[nodiscard]] std::string kml(const MappedFlight& flight);

}  // namespace vigil::geography

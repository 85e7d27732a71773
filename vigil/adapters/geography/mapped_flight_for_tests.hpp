#pragma once

#include <limits>
#include <vector>

#include "vigil/adapters/geography/geojson.hpp"

/// A flight made by hand, for the tests of both formats.
namespace vigil::geography {

inline runtime::Mission mapped_mission() {
  runtime::Mission mission;
  mission.name = "hill & valley";
  mission.field.size_m = {400.0, 300.0};
  mission.field.datum = runtime::DatumSection{47.0, 8.0};
  mission.targets.clusters.push_back({"camp <1>", {{60.0, 60.0}, {75.0, 50.0}}, 2.0, {}});
  mission.targets.areas.push_back({"ridge", {{40.0, 220.0}, {50.0, 270.0}, {150.0, 235.0}}, 6.0, 0.0, {}});
  mission.no_fly.push_back({"road", {{170.0, 90.0}, {230.0, 110.0}, {225.0, 190.0}}});
  return mission;
}

inline std::vector<Track> two_tracks() {
  return {
      {"d1",
       {{{0.0, {10.0, 20.0}, 0.0}, {1.0, {11.0, 20.0}, 1.5}}, {{5.0, {15.0, 20.0}, 1.5}, {6.0, {15.0, 21.0}, 1.5}}}},
      {"d2", {}}};
}

}  // namespace vigil::geography

#include "vigil/adapters/geography/geojson.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/geography/geographic_frame.hpp"
#include "vigil/adapters/geography/mapped_flight_for_tests.hpp"

namespace vigil::geography {
namespace {

using Json = nlohmann::json;

class GeoJson : public testing::Test {
 protected:
  [[nodiscard]] Json written(std::int64_t began_ns = 0) const {
    return Json::parse(geojson({mission_, targets_, tracks_, began_ns}));
  }
  [[nodiscard]] Json feature(const std::string& kind, std::int64_t began_ns = 0) const {
    const Json collection = written(began_ns);
    for (const Json& one : collection["features"])
      if (one["properties"]["kind"] == kind) return one;
    return {};
  }
  void expect_at(const Json& position, const Vec2& p_W) const {
    const GeographicPoint point = GeographicFrame(*mission_.field.datum).at(p_W);
    EXPECT_NEAR(position[0].get<double>(), point.longitude_deg, 1e-8);
    EXPECT_NEAR(position[1].get<double>(), point.latitude_deg, 1e-8);
  }

  runtime::Mission mission_ = mapped_mission();
  runtime::MissionTargets targets_ = runtime::targets_of(mission_);
  std::vector<Track> tracks_ = two_tracks();
};

TEST_F(GeoJson, Is_one_collection_with_everything_that_a_map_draws) {
  const Json collection = written();
  EXPECT_EQ(collection["type"], "FeatureCollection");
  std::vector<std::string> kinds;
  for (const Json& one : collection["features"]) kinds.push_back(one["properties"]["kind"]);
  EXPECT_EQ(kinds, (std::vector<std::string>{"field", "cluster", "area", "no_fly", "track"}));
}

TEST_F(GeoJson, Positions_are_longitude_then_latitude) {
  const Json cluster = feature("cluster");
  EXPECT_EQ(cluster["geometry"]["type"], "MultiPoint");
  expect_at(cluster["geometry"]["coordinates"][1], {75.0, 50.0});
  EXPECT_NEAR(cluster["geometry"]["coordinates"][0][0].get<double>(), 8.0, 0.01);
}

TEST_F(GeoJson, Rings_are_closed_and_run_counter_clockwise) {
  const Json area = feature("area");  // given clockwise
  const Json& ring = area["geometry"]["coordinates"][0];
  ASSERT_EQ(ring.size(), 4U);
  EXPECT_EQ(ring.front(), ring.back());
  expect_at(ring[0], {150.0, 235.0});
  expect_at(ring[2], {40.0, 220.0});
}

TEST_F(GeoJson, A_track_has_its_pieces_with_times_and_heights_beside_them) {
  const Json track = feature("track");
  EXPECT_EQ(track["geometry"]["type"], "MultiLineString");
  EXPECT_EQ(track["properties"]["drone"], "d1");
  ASSERT_EQ(track["geometry"]["coordinates"].size(), 2U);
  expect_at(track["geometry"]["coordinates"][1][1], {15.0, 21.0});
  EXPECT_EQ(track["properties"]["times_s"], Json::parse("[[0.0, 1.0], [5.0, 6.0]]"));
  EXPECT_EQ(track["properties"]["heights_m"], Json::parse("[[0.0, 1.5], [1.5, 1.5]]"));
}

TEST_F(GeoJson, Only_a_live_flight_has_a_time_of_day) {
  EXPECT_FALSE(feature("track")["properties"].contains("began"));
  EXPECT_EQ(feature("track", 1'760'000'000'250'000'000)["properties"]["began"], "2025-10-09T08:53:20.250Z");
}

TEST_F(GeoJson, The_same_flight_gives_the_same_bytes) {
  const MappedFlight flight{mission_, targets_, tracks_, 0};
  EXPECT_EQ(geojson(flight), geojson(flight));
}

}  // namespace
}  // namespace vigil::geography

#include "vigil/adapters/geography/kml.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "vigil/adapters/geography/geographic_frame.hpp"
#include "vigil/adapters/geography/mapped_flight_for_tests.hpp"

namespace vigil::geography {
namespace {

class Kml : public testing::Test {
 protected:
  Kml() { EXPECT_TRUE(file_.load_string(kml({mission_, targets_, tracks_, 0}).c_str())); }

  [[nodiscard]] std::string text(const char* path) const { return file_.select_node(path).node().text().get(); }

  runtime::Mission mission_ = mapped_mission();
  runtime::MissionTargets targets_ = runtime::targets_of(mission_);
  std::vector<Track> tracks_ = two_tracks();
  pugi::xml_document file_;
};

TEST_F(Kml, Names_may_hold_what_xml_means_otherwise) {
  EXPECT_EQ(text("/kml/Document/name"), "hill & valley");
  EXPECT_TRUE(file_.select_node("//Placemark[name='camp <1>']"));
}

TEST_F(Kml, Every_moment_of_a_piece_has_its_place) {
  const auto pieces = file_.select_nodes("//Placemark[name='d1']/gx:MultiTrack/gx:Track");
  ASSERT_EQ(pieces.size(), 2U);
  for (const auto& piece : pieces) {
    EXPECT_EQ(piece.node().select_nodes("when").size(), 2U);
    EXPECT_EQ(piece.node().select_nodes("gx:coord").size(), 2U);
  }
  EXPECT_EQ(text("//gx:Track[2]/when[1]"), "1970-01-01T00:00:05.000Z");
  const GeographicPoint second = GeographicFrame(*mission_.field.datum).at({11.0, 20.0});
  EXPECT_EQ(text("//gx:Track[1]/gx:coord[2]"),
            fmt::format("{:.8f} {:.8f} 1.500", second.longitude_deg, second.latitude_deg));
}

TEST_F(Kml, A_drone_without_a_track_has_no_place) { EXPECT_FALSE(file_.select_node("//Placemark[name='d2']")); }

TEST_F(Kml, Every_style_that_is_used_is_defined) {
  for (const auto& use : file_.select_nodes("//styleUrl")) {
    const std::string id = std::string(use.node().text().get()).substr(1);
    EXPECT_TRUE(file_.select_node(("//Style[@id='" + id + "']").c_str())) << id;
  }
}

}  // namespace
}  // namespace vigil::geography

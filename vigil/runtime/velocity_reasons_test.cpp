#include "vigil/runtime/velocity_reasons.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/memory_recording_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/replayed_flight.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

using Json = nlohmann::ordered_json;

/// A flight of three drones, at any of its ticks.
class VelocityReasons : public testing::Test {
 protected:
  VelocityReasons()
      : flight_(std::make_unique<KeptRecording>(kept_flight(700))),
        mission_(small_mission("simulation: {events: [{at_s: 2, do: land, drone: b}]}\n")) {}

  [[nodiscard]] Json why(std::size_t drone) const {
    return velocity_reasons_json(flight_.state(), swarm::DroneId(drone), mission_);
  }
  [[nodiscard]] Vec2 in_world(const Vec2& v) const { return world_frame(mission_).vector_to_world(v); }
  [[nodiscard]] static Vec2 vector_in(const Json& json) { return {json[0].get<double>(), json[1].get<double>()}; }

  ReplayedFlight flight_;
  Mission mission_;
};

TEST_F(VelocityReasons, What_is_explained_is_what_was_decided) {
  while (flight_.step()) {
    for (std::size_t drone = 0; drone < mission_.drones.size(); ++drone) {
      const swarm::DroneSnapshot& decided = flight_.snapshot().drones[drone];
      const Json told = why(drone);
      EXPECT_EQ(told["tick"], flight_.snapshot().tick);
      EXPECT_EQ(told["activity"], swarm::name_of(decided.activity));
      EXPECT_EQ(vector_in(told["u_nom_m_s"]), in_world(decided.u_nom));
      if (decided.order.action == swarm::Action::kVelocity) {
        EXPECT_EQ(vector_in(told["u_m_s"]), in_world(decided.order.velocity));
      }
    }
  }
}

TEST_F(VelocityReasons, Every_row_is_kept_and_those_that_hold_are_tight) {
  constexpr double kRounding = 1e-9;
  std::size_t rows = 0;
  std::size_t held = 0;
  while (flight_.step()) {
    for (std::size_t drone = 0; drone < mission_.drones.size(); ++drone) {
      const Json told = why(drone);
      const Vec2 u = vector_in(told["u_m_s"]);
      EXPECT_FALSE(told["margin_used"]);
      for (const Json& row : told["rows"]) {
        const Vec2 normal = vector_in(row["normal"]);
        EXPECT_NEAR(normal.norm(), 1.0, kRounding);
        EXPECT_NEAR(normal.dot(u) - row["offset_m_s"].get<double>(), row["slack_m_s"].get<double>(), kRounding);
        EXPECT_GE(row["slack_m_s"], -kRounding);
        if (row["holds"]) {
          EXPECT_NEAR(row["slack_m_s"].get<double>(), 0.0, kRounding);
        }
        held += row["holds"] ? 1U : 0U;
      }
      rows += told["rows"].size();
    }
  }
  EXPECT_GT(rows, 30U);
  EXPECT_GT(held, 10U);
}

TEST_F(VelocityReasons, The_speed_limit_is_named_only_where_it_changed_something_beyond_rounding) {
  constexpr double kRounding = 1e-12;
  std::size_t touched = 0;
  while (flight_.step()) {
    for (std::size_t drone = 0; drone < mission_.drones.size(); ++drone) {
      const bool is_changed = why(drone)["changed_m_s"].get<double>() > kRounding;
      const bool is_on_disk = flight_.state().explain(swarm::DroneId(drone)).report.speed_limited;
      EXPECT_EQ(why(drone)["speed_limited"].get<bool>(), is_on_disk && is_changed);
      touched += is_on_disk && !is_changed ? 1U : 0U;
    }
  }
  EXPECT_GT(touched, 0U);
}

TEST_F(VelocityReasons, The_text_names_the_drone_and_what_the_rows_are_about) {
  flight_.seek(300);
  const std::string text = velocity_reasons(flight_.state(), swarm::DroneId(1), mission_);
  EXPECT_NE(text.find(mission_.drones[1].id), std::string::npos) << text;
  EXPECT_NE(text.find("wanted"), std::string::npos) << text;
}

}  // namespace
}  // namespace vigil::runtime

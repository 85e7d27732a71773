#include "vigil/runtime/saved_flight.hpp"

#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

SavedFlight some_flight() {
  SavedFlight flight;
  flight.mission_text = "name: a\n";
  flight.targets_text = "name: \"b\"\n";
  flight.revision = 9;
  flight.past.ticks = 1150;
  flight.past.has_first_metric = true;
  flight.past.first_metric = 0.1;
  flight.past.coverage.sum = ergodic::Coefficients::Random(4, 4);
  flight.past.coverage.past_averages = ergodic::Coefficients::Zero(4, 4);
  flight.past.coverage.time_s = 1.0 / 3.0;
  flight.past.coverage.has_samples = true;
  flight.seen_s = {1.5, -std::numeric_limits<double>::infinity(), 0.1};
  flight.drones = {{{0.1, 0.2}, false, swarm::Intent::kLand}, {{1.0 / 7.0, 3.0}, true, swarm::Intent::kEmergencyStop}};
  return flight;
}

class FlightStoreTest : public ::testing::Test {
 protected:
  FlightStoreTest() { std::filesystem::remove_all(folder); }
  ~FlightStoreTest() override { std::filesystem::remove_all(folder); }
  void write(const std::string& text) const { std::ofstream(folder / "flight.json") << text; }

  std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "vigil_flight_store_test";
};

TEST_F(FlightStoreTest, What_was_saved_last_comes_back_bit_for_bit) {
  const FlightStore store(folder);
  EXPECT_FALSE(store.load());
  SavedFlight flight = some_flight();
  store.save(flight);
  flight.revision = 10;
  store.save(flight);
  const auto back = store.load();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mission_text, flight.mission_text);
  EXPECT_EQ(back->targets_text, flight.targets_text);
  EXPECT_EQ(back->revision, 10U);
  EXPECT_EQ(back->past.ticks, 1150U);
  EXPECT_EQ(back->past.first_metric, 0.1);
  EXPECT_EQ(back->past.coverage.sum, flight.past.coverage.sum);
  EXPECT_EQ(back->past.coverage.time_s, 1.0 / 3.0);
  EXPECT_EQ(back->seen_s, flight.seen_s);
  ASSERT_EQ(back->drones.size(), 2U);
  EXPECT_EQ(back->drones[1].place_m, flight.drones[1].place_m);
  EXPECT_TRUE(back->drones[1].is_down);
  EXPECT_EQ(back->drones[0].order, swarm::Intent::kLand);
  EXPECT_EQ(back->drones[1].order, swarm::Intent::kEmergencyStop);
}

TEST_F(FlightStoreTest, A_state_from_before_orders_were_kept_is_read_and_its_drones_hold) {
  std::string text = saved_text(some_flight());
  const auto replace = [&text](const std::string& was, const std::string& is) {
    ASSERT_NE(text.find(was), std::string::npos) << was;
    text.replace(text.find(was), was.size(), is);
  };
  replace("\"format\":2", "\"format\":1");
  replace(",\"land\"]", "]");
  replace(",\"emergency_stop\"]", "]");
  const SavedFlight back = saved_flight(text);
  ASSERT_EQ(back.drones.size(), 2U);
  EXPECT_EQ(back.drones[0].order, swarm::Intent::kHold);
  EXPECT_TRUE(back.drones[1].is_down);
}

TEST_F(FlightStoreTest, An_order_that_there_is_not_is_refused) {
  std::string text = saved_text(some_flight());
  text.replace(text.find("\"land\""), 6, "\"dive\"");
  EXPECT_THROW((void)saved_flight(text), SavedFlightError);
}

TEST_F(FlightStoreTest, A_program_that_dies_while_it_saves_leaves_the_save_before) {
  const FlightStore store(folder);
  store.save(some_flight());
  std::ofstream(folder / "flight.json.unfinished") << "{\"form";
  EXPECT_EQ(store.load()->revision, 9U);
}

TEST_F(FlightStoreTest, What_makes_no_sense_is_refused_with_advice) {
  const FlightStore store(folder);
  for (const char* text : {"", "{}", "[1]", "{\"format\":3}", "not json"}) {
    write(text);
    try {
      (void)store.load();
      ADD_FAILURE() << text;
    } catch (const SavedFlightError& error) {
      EXPECT_NE(std::string(error.what()).find("remove it"), std::string::npos) << error.what();
    }
  }
  std::string text = saved_text(some_flight());
  text.replace(text.find("\"rows\":4"), 8, "\"rows\":3");
  EXPECT_THROW((void)saved_flight(text), SavedFlightError);
}

TEST_F(FlightStoreTest, A_folder_has_one_user_at_a_time_and_the_second_is_told_what_to_do) {
  {
    const FlightStore first(folder);
    try {
      const FlightStore second(folder);
      ADD_FAILURE() << "two share a folder";
    } catch (const SavedFlightError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(folder.string()), 0U) << line;
      EXPECT_NE(line.find("end that one first"), std::string::npos) << line;
    }
    first.save(some_flight());
  }
  EXPECT_TRUE(FlightStore(folder).load());
}

TEST_F(FlightStoreTest, A_folder_that_cannot_be_locked_is_refused) {
  std::filesystem::create_directories(folder / "lock");  // a folder where the lock's file would be
  EXPECT_THROW((void)FlightStore(folder), SavedFlightError);
}

TEST_F(FlightStoreTest, What_is_cleared_is_gone) {
  const FlightStore store(folder);
  store.save(some_flight());
  store.clear();
  EXPECT_FALSE(store.load());
}

}  // namespace
}  // namespace vigil::runtime

#include "vigil/adapters/console/seats.hpp"

#include <gtest/gtest.h>

namespace vigil::console {
namespace {

class Caller final : public Guest {
 public:
  explicit Caller(std::string origin, bool is_stranger = true)
      : origin_(std::move(origin)), is_stranger_(is_stranger) {}
  [[nodiscard]] const std::string& origin() const override { return origin_; }
  [[nodiscard]] bool is_stranger() const override { return is_stranger_; }
  void give_place() override { has_left_ = true; }
  [[nodiscard]] bool has_left() const { return has_left_; }

 private:
  std::string origin_;
  bool is_stranger_;
  bool has_left_ = false;
};

/// As many callers of an origin as find a place.
std::vector<std::shared_ptr<Caller>> come(Seats& seats, const std::string& origin, int times,
                                          bool are_strangers = true) {
  std::vector<std::shared_ptr<Caller>> callers;
  for (int i = 0; i < times; ++i) {
    if (!seats.make_room()) continue;
    callers.push_back(std::make_shared<Caller>(origin, are_strangers));
    seats.seat(callers.back());
  }
  return callers;
}

TEST(Seats, Everybody_stays_while_there_is_a_place) {
  Seats seats(3);
  for (const auto& caller : come(seats, "10.0.0.1", 3)) EXPECT_FALSE(caller->has_left());
}

TEST(Seats, Who_has_said_who_he_is_is_never_sent_away) {
  Seats seats(2);
  const auto operators = come(seats, "10.0.0.1", 2, false);
  EXPECT_TRUE(come(seats, "10.0.0.2", 5).empty());
  for (const auto& caller : operators) EXPECT_FALSE(caller->has_left());
}

TEST(Seats, A_crowd_of_strangers_pushes_out_its_own_and_the_first_of_them_first) {
  Seats seats(4);
  const auto lonely = come(seats, "10.0.0.1", 1);
  const auto crowd = come(seats, "10.0.0.2", 3);
  const auto next = come(seats, "10.0.0.3", 1);
  EXPECT_FALSE(lonely.front()->has_left());
  EXPECT_TRUE(crowd[0]->has_left());
  EXPECT_FALSE(crowd[1]->has_left());
  EXPECT_EQ(next.size(), 1U);
}

TEST(Seats, Each_role_leaves_places_to_those_above_it_and_all_to_strangers) {
  EXPECT_LE(places_for(Role::kViewer) + 16, places_for(Role::kOperator));
  EXPECT_LE(places_for(Role::kOperator) + 16, places_for(Role::kSafetyPilot));
  EXPECT_LE(places_for(Role::kSafetyPilot) + 32, kMostConnections);
}

TEST(Seats, A_place_is_free_again_when_its_guest_is_gone) {
  Seats seats(1);
  come(seats, "10.0.0.1", 1, false);
  EXPECT_TRUE(seats.make_room());
}

TEST(Seats, Those_that_were_sent_away_and_do_not_go_are_bounded_too) {
  Seats seats(4);
  EXPECT_EQ(come(seats, "10.0.0.1", 100).size(), 8U);
}

}  // namespace
}  // namespace vigil::console

// Lagging drones whose orders and observations take their time: the tick makes up for both.

#include <deque>

#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"

namespace vigil::swarm {
namespace {

constexpr double kLag = 0.3;
constexpr std::size_t kTicksUp = 15;   ///< 0.3 s from decision to reaction
constexpr std::size_t kTicksDown = 4;  ///< 0.08 s from measurement to decision

SwarmParameters crossing(bool makes_up_for_delays) {
  SwarmParameters parameters = laboratory(8);
  parameters.field = {6.0, 6.0};
  parameters.barrier.wall_distance_m = 0.1;
  parameters.barrier.u_max_m_s = 0.8;
  parameters.barrier.lag_s = kLag;
  if (makes_up_for_delays) parameters.command_delay_s = kTicksUp * kDt;
  parameters.observation_delay_s = kTicksDown * kDt;  // never counted as unknown here
  return parameters;
}

/// v' = (u - v)/lag, solved, on a circle whose drones all want to be opposite.
class LateWorld {
 public:
  explicit LateWorld(bool makes_up_for_delays)
      : state_(crossing(makes_up_for_delays)), snapshot_(8), observations_(8), bodies_(8) {
    for (std::size_t i = 0; i < 8; ++i) {
      const double angle = 0.25 * M_PI * static_cast<double>(i);
      bodies_[i].position = Vec2(3.0, 3.0) + 2.0 * Vec2(std::cos(angle), std::sin(angle));
      Command command{.kind = CommandKind::kGoTo, .drone = DroneId(i), .target = {}};
      command.place = Vec2(6.0, 6.0) - bodies_[i].position;
      sent_.push_back(command);
    }
    seen_.assign(kTicksDown + 1, bodies_);
    orders_.assign(kTicksUp + 1, std::vector<Vec2>(8, Vec2::Zero()));
  }

  /// Nothing is seen of the drone from then on.
  void lose(std::size_t drone, double from_s) {
    lost_ = drone;
    lost_from_s_ = from_s;
  }

  double least_distance(double seconds) {
    double least = HUGE_VAL;
    for (double t = 0.0; t < seconds; t += kDt) {
      step();
      for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < i; ++j) least = std::min(least, (bodies_[i].position - bodies_[j].position).norm());
    }
    return least;
  }

 private:
  void step() {
    seen_.pop_front();
    seen_.push_back(bodies_);
    for (std::size_t i = 0; i < 8; ++i) {
      observations_[i] = flying_at(seen_.front()[i].position);
      observations_[i].velocity = seen_.front()[i].velocity;
      observations_[i].age_s = kTicksDown * kDt;
    }
    time_s_ += kDt;
    if (lost_ < 8 && time_s_ > lost_from_s_) {
      if (time_s_ <= lost_from_s_ + kDt) last_seen_ = observations_[lost_];
      last_seen_.age_s += kDt;
      observations_[lost_] = last_seen_;
    }
    tick(state_, observations_, sent_, snapshot_);
    sent_.clear();
    orders_.pop_front();
    orders_.emplace_back();
    for (const DroneSnapshot& drone : snapshot_.drones) orders_.back().push_back(drone.order.velocity);
    const double fade = std::exp(-kDt / kLag);
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec2 u = orders_.front()[i];
      bodies_[i].position += kDt * u + kLag * (1.0 - fade) * (bodies_[i].velocity - u);
      bodies_[i].velocity = u + fade * (bodies_[i].velocity - u);
    }
  }

  SwarmState state_;
  Snapshot snapshot_;
  std::vector<DroneObservation> observations_;
  std::vector<Motion> bodies_;
  std::vector<Command> sent_;
  std::deque<std::vector<Motion>> seen_;
  std::deque<std::vector<Vec2>> orders_;
  double time_s_ = 0.0;
  std::size_t lost_ = 8;
  double lost_from_s_ = 0.0;
  DroneObservation last_seen_;
};

TEST(Delay, Drones_whose_delays_are_made_up_for_keep_R_s_without_any_margin) {
  EXPECT_GE(LateWorld(true).least_distance(30.0), 0.2 - 1e-9);
}

TEST(Delay, A_drone_that_is_seen_no_more_still_flies_what_it_was_ordered_and_the_others_know) {
  for (int moment = 0; moment < 40; ++moment) {
    LateWorld world(true);
    world.lose(static_cast<std::size_t>(moment % 8), 1.0 + 0.1 * moment);
    EXPECT_GE(world.least_distance(12.0), 0.2 - 1e-9) << moment;
  }
}

TEST(Delay, Drones_whose_delay_of_commands_is_not_known_do_not) {
  EXPECT_LT(LateWorld(false).least_distance(30.0), 0.19);
}

}  // namespace
}  // namespace vigil::swarm

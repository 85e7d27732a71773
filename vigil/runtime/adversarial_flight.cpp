#include "vigil/runtime/adversarial_flight.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <vector>

#include "vigil/core/dynamics/planar_vehicle.hpp"
#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/swarm/flown_orders.hpp"

namespace vigil::runtime {
namespace {

using dynamics::PlanarLoopState;

/// A stream of its own: other flights of the same seed draw other numbers.
constexpr std::uint64_t kAdversary = 0x6164;

Vec2 turned(const Vec2& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Vec2 towards(const Vec2& from, const Vec2& to) {
  const Vec2 way = to - from;
  const double length = way.norm();
  return length > 0.0 ? Vec2(way / length) : Vec2(1.0, 0.0);
}

std::vector<PlanarLoopState> starts(const AdversarialFlight& plan) {
  const Vec2 middle(0.5 * plan.field.length_x, 0.5 * plan.field.length_y);
  std::vector<PlanarLoopState> states(plan.drones);
  for (std::size_t i = 0; i < plan.drones; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(plan.drones);
    states[i].position = middle + turned(Vec2(plan.start_radius_m, 0.0), angle);
  }
  return states;
}

/// One flight as it goes on.
class Flight {
 public:
  explicit Flight(const AdversarialFlight& plan)
      : plan_(plan),
        dt_s_(plan.barrier.dt_s),
        filter_(plan.barrier, plan.field, plan.drones),
        flown_(plan.drones, dt_s_, span_s() + dt_s_),
        states_(starts(plan)),
        angles_(plan.drones, 0.0),
        bodies_(plan.drones),
        wishes_(plan.drones, Vec2::Zero()),
        orders_(plan.drones, Vec2::Zero()),
        reports_(plan.drones),
        seen_(plan.observation_delay_ticks + 1, states_),
        on_the_way_(plan.command_delay_ticks, orders_),
        random_(plan.seed, 0, kAdversary) {}

  Closest run() {
    Closest closest{.separation_m = std::numeric_limits<double>::infinity(),
                    .wall_m = std::numeric_limits<double>::infinity()};
    const auto last = static_cast<std::size_t>(std::lround(plan_.duration_s / dt_s_));
    for (std::size_t tick = 0; tick < last; ++tick) {
      now_s_ = static_cast<double>(tick) * dt_s_;
      decide();
      move();
      judge(closest);
    }
    return closest;
  }

 private:
  /// From what is seen to the moment at which the next order begins to act.
  [[nodiscard]] double span_s() const {
    return dt_s_ * static_cast<double>(plan_.observation_delay_ticks + plan_.command_delay_ticks);
  }

  void decide() {
    const std::vector<PlanarLoopState>& seen = seen_.front();
    for (std::size_t i = 0; i < plan_.drones; ++i) {
      const swarm::Motion ahead = flown_.ahead(i, {seen[i].position, seen[i].velocity}, span_s(), plan_.barrier.lag_s);
      bodies_[i].position = ahead.position;
      bodies_[i].velocity = ahead.velocity;
    }
    for (std::size_t i = 0; i < plan_.drones; ++i) wishes_[i] = plan_.barrier.u_max_m_s * wish_of(i);
    filter_.run(bodies_, {}, wishes_, orders_, reports_);
    flown_.remember(orders_);
  }

  /// Whether so much of a period has not passed yet.
  [[nodiscard]] bool is_before(double share) const {
    const double periods = now_s_ / plan_.period_s;
    return periods - std::floor(periods) < share;
  }

  [[nodiscard]] Vec2 wish_of(std::size_t i) {
    Vec2 at = towards(states_[i].position, states_[(i + 1) % plan_.drones].position);
    const bool presses = is_before(0.75);
    const bool is_first = is_before(0.5);
    switch (plan_.wish) {
      case Wish::kPress:
        return at;
      case Wish::kOrbit:
        return turned(at, plan_.angle_rad);
      case Wish::kPulse:
        return presses ? at : Vec2(-at);
      case Wish::kChase:
        return i % 2 == 0 || !is_first ? at : Vec2(-at);
      case Wish::kReverse:
        return turned(at, is_first ? plan_.angle_rad : -plan_.angle_rad);
      case Wish::kRandom:
        return turned(at, random_angle(i));
      case Wish::kWalls:
        break;
    }
    const Vec2 wall = turned(Vec2(1.0, 0.0), plan_.angle_rad + 0.5 * std::numbers::pi * static_cast<double>(i % 4));
    return presses ? wall : Vec2(-wall);
  }

  [[nodiscard]] double random_angle(std::size_t i) {
    const bool changes = random_.uniform() < 2.0 * dt_s_ / plan_.period_s;
    const double quarter = 0.5 * std::numbers::pi * std::floor(4.0 * random_.uniform());
    if (changes) angles_[i] = quarter;
    return angles_[i];
  }

  [[nodiscard]] PlanarLoopState moved(const PlanarLoopState& state, const Vec2& u) const {
    if (!plan_.acceleration_limit_m_s2) return dynamics::advance(plan_.loop, state, u, dt_s_);
    const dynamics::PlanarVehicle vehicle{.lag_s = 1.0 / plan_.loop.proportional_per_s,
                                          .acceleration_limit_m_s2 = plan_.acceleration_limit_m_s2};
    const dynamics::PlanarState next = dynamics::advance(vehicle, {state.position, state.velocity}, u, dt_s_);
    return {.position = next.position, .velocity = next.velocity};
  }

  void move() {
    on_the_way_.push_back(orders_);
    for (std::size_t i = 0; i < plan_.drones; ++i) states_[i] = moved(states_[i], on_the_way_.front()[i]);
    on_the_way_.pop_front();
    seen_.push_back(states_);
    seen_.pop_front();
  }

  void judge(Closest& closest) const {
    const field::Field& field = plan_.field;
    for (std::size_t i = 0; i < plan_.drones; ++i) {
      const Vec2& p = states_[i].position;
      closest.wall_m = std::min({closest.wall_m, p.x(), p.y(), field.length_x - p.x(), field.length_y - p.y()});
      for (std::size_t j = 0; j < i; ++j)
        closest.separation_m = std::min(closest.separation_m, (p - states_[j].position).norm());
    }
  }

  const AdversarialFlight& plan_;
  double dt_s_;
  safety::Filter filter_;
  swarm::FlownOrders flown_;
  std::vector<PlanarLoopState> states_;
  std::vector<double> angles_;
  std::vector<safety::Body> bodies_;
  std::vector<Vec2> wishes_;
  std::vector<Vec2> orders_;
  std::vector<safety::FilterReport> reports_;
  std::deque<std::vector<PlanarLoopState>> seen_;  ///< the oldest is what is seen now
  std::deque<std::vector<Vec2>> on_the_way_;       ///< the oldest arrives now
  dynamics::RandomStream random_;
  double now_s_ = 0.0;
};

}  // namespace

Closest fly(const AdversarialFlight& flight) { return Flight(flight).run(); }

}  // namespace vigil::runtime

#include "vigil/runtime/campaign_draws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/runtime/free_places.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using dynamics::RandomStream;

/// Places tried for one drone or one point.
constexpr int kMostDarts = 500;
/// Starts keep so many times the distance that is required.
constexpr double kRoom = 1.1;
constexpr double kLeastLengthS = 0.5;
constexpr double kMostLengthS = 10.0;

double rounded(double value, double parts) { return std::round(value * parts) / parts; }
Vec2 to_millimetres(const Vec2& p) { return {rounded(p.x(), 1e3), rounded(p.y(), 1e3)}; }
double to_centiseconds(double time_s) { return rounded(time_s, 1e2); }

double between(RandomStream& random, double low, double high) { return low + (high - low) * random.uniform(); }
std::size_t below(RandomStream& random, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
}

/// Free places in the world frame, rounded.
class FreeSpots {
 public:
  FreeSpots(const Mission& mission, double wall_m, double no_fly_m)
      : frame_(world_frame(mission)), places_(mission, wall_m, no_fly_m) {}

  Vec2 dart(RandomStream& random) const { return places_.dart(random); }

  /// The rounded point in the world frame, where it is free and `wanted` too; p_F is in the field frame.
  template <typename Wanted>
  std::optional<Vec2> settle(const Vec2& p_F, Wanted wanted) const {
    const Vec2 p_W = to_millimetres(frame_.point_to_world(p_F));
    return places_.is_free(frame_.point_to_field(p_W)) && wanted(p_W) ? std::optional(p_W) : std::nullopt;
  }

 private:
  field::WorldFrame frame_;
  FreePlaces places_;
};

template <typename Dart, typename Wanted>
std::optional<Vec2> find_place(const FreeSpots& places, Dart dart, Wanted wanted) {
  for (int i = 0; i < kMostDarts; ++i)
    if (const std::optional<Vec2> place = places.settle(dart(), wanted)) return place;
  return std::nullopt;
}

/// The standard deviation per axis of a cluster's points about their centre.
double spread_of(const std::vector<Vec2>& points) {
  Vec2 centre = Vec2::Zero();
  for (const Vec2& point : points) centre += point / static_cast<double>(points.size());
  double squares = 0.0;
  for (const Vec2& point : points) squares += (point - centre).squaredNorm();
  return std::sqrt(0.5 * squares / static_cast<double>(points.size()));
}

std::optional<std::vector<Vec2>> draw_cluster(const FreeSpots& places, const ClusterEntry& cluster,
                                              RandomStream& random) {
  const Vec2 centre_F = places.dart(random);
  const double spread = spread_of(cluster.points_m);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < cluster.points_m.size(); ++i) {
    const auto point =
        find_place(places, [&] { return Vec2(centre_F + random.normal(spread)); }, [](const Vec2&) { return true; });
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

Vec2 random_velocity(RandomStream& random, double limit_m_s) {
  const double speed = limit_m_s * random.uniform();
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  return to_millimetres({speed * std::cos(angle), speed * std::sin(angle)});
}

/// Draws one incident after the other.
class Incidents {
 public:
  Incidents(const Mission& mission, std::span<const EventKind> kinds, RandomStream& random)
      : mission_(mission), kinds_(kinds), random_(random) {}

  void draw() {
    EventEntry event;
    event.what = kinds_[below(random_, kinds_.size())];
    event.drone = mission_.drones[below(random_, mission_.drones.size())].id;
    event.at_s = to_centiseconds(mission_.simulation.duration_s * random_.uniform());
    const double length_s = to_centiseconds(between(random_, kLeastLengthS, kMostLengthS));
    const Vec2 velocity = random_velocity(random_, mission_.control.speed_limit_m_s);
    if (event.what == EventKind::kOverride) event.velocity_m_s = velocity;
    if (event.what == EventKind::kLoseTracking || event.what == EventKind::kLoseLink) event.for_s = length_s;
    add(event);
    if (const auto remedy = remedy_of(event.what)) add_remedy(event, *remedy, length_s);
  }

  std::vector<EventEntry> in_order() && {
    std::ranges::stable_sort(events_, {}, &EventEntry::at_s);
    return std::move(events_);
  }

 private:
  static std::optional<EventKind> remedy_of(EventKind kind) {
    if (kind == EventKind::kOverride) return EventKind::kGiveBack;
    if (kind == EventKind::kHold || kind == EventKind::kMarkFailed) return EventKind::kResume;
    return std::nullopt;
  }

  void add_remedy(const EventEntry& event, EventKind what, double after_s) {
    EventEntry remedy;
    remedy.what = what;
    remedy.drone = event.drone;
    remedy.at_s = to_centiseconds(event.at_s + after_s);
    add(remedy);
  }

  void add(const EventEntry& event) {
    if (event.at_s <= mission_.simulation.duration_s) events_.push_back(event);
  }

  const Mission& mission_;
  std::span<const EventKind> kinds_;
  RandomStream& random_;
  std::vector<EventEntry> events_;
};

}  // namespace

std::optional<std::vector<Vec2>> draw_starts(const Mission& mission, RandomStream& random) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const double apart = kRoom * safety::barrier_radius(barrier);
  const FreeSpots places(mission, kRoom * barrier.wall_distance_m, kRoom * barrier.no_fly_buffer_m);
  std::vector<Vec2> starts;
  const auto is_apart = [&](const Vec2& p_W) {
    return std::ranges::all_of(starts, [&](const Vec2& other_W) { return (p_W - other_W).norm() > apart; });
  };
  while (starts.size() < mission.drones.size()) {
    const auto start = find_place(places, [&] { return places.dart(random); }, is_apart);
    if (!start) return std::nullopt;
    starts.push_back(*start);
  }
  return starts;
}

std::optional<std::vector<std::vector<Vec2>>> draw_targets(const Mission& mission, RandomStream& random) {
  const FreeSpots places(mission, 0.0, 0.0);
  std::vector<std::vector<Vec2>> clusters;
  for (const ClusterEntry& cluster : mission.targets.clusters) {
    auto points = draw_cluster(places, cluster, random);
    if (!points) return std::nullopt;
    clusters.push_back(std::move(*points));
  }
  return clusters;
}

std::vector<EventEntry> draw_incidents(const Mission& mission, std::size_t incidents, std::span<const EventKind> kinds,
                                       RandomStream& random) {
  Incidents drawn(mission, kinds, random);
  for (std::size_t i = 0; i < incidents; ++i) drawn.draw();
  return std::move(drawn).in_order();
}

}  // namespace vigil::runtime

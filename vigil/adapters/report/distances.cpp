#include "vigil/adapters/report/distances.hpp"

#include <algorithm>
#include <optional>

#include "vigil/core/safety/neighbour_grid.hpp"
#include "vigil/runtime/flight_audit.hpp"

namespace vigil::report {
namespace {

constexpr double kPlacesToMeasure = 4e6;  // some seconds

std::size_t stride_for(const FlightData& data) {
  constexpr double kLeastTicks = 40.0;
  constexpr double kMostTicks = 600.0;
  const double affordable = std::clamp(kPlacesToMeasure / static_cast<double>(data.drones()), kLeastTicks, kMostTicks);
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(data.ticks()) / affordable));
}

/// The active drones at one tick, to be found by where they are.
class ActiveDrones {
 public:
  explicit ActiveDrones(const FlightData& data)
      : data_(data),
        least_radius_m_(data.mission.safety.separation_m),
        grid_(data.field, least_radius_m_, data.drones()) {}

  void look_at(std::size_t tick) {
    drones_.clear();
    places_.clear();
    for (std::size_t i = 0; i < data_.drones(); ++i) {
      const Vec2& p = data_.positions[data_.flight.row(tick, i)];
      if (!data_.flight.is_active(tick, i) || !p.allFinite()) continue;
      drones_.push_back(i);
      places_.push_back(p);
    }
    grid_.sort(places_);
  }

  [[nodiscard]] const std::vector<Vec2>& places() const { return places_; }

  struct Nearest {
    double distance_m = std::numeric_limits<double>::infinity();
    std::size_t drone = 0;
  };

  /// Of all but the one with the number `except` in places(). Infinitely far where there is no other.
  [[nodiscard]] Nearest nearest_to(const Vec2& place, std::optional<std::size_t> except = {}) const {
    Nearest nearest;
    const std::size_t others = places_.size() - (except ? 1U : 0U);
    // Each circle is four times the one before: what is found within it is the nearest of all.
    for (double radius_m = least_radius_m_; others > 0 && nearest.distance_m > radius_m; radius_m *= 2.0) {
      grid_.visit_near(place, radius_m, [&](std::size_t number) {
        const double distance_m = (places_[number] - place).norm();
        if (number != except && distance_m < nearest.distance_m) nearest = {distance_m, drones_[number]};
      });
    }
    return nearest;
  }

 private:
  const FlightData& data_;
  double least_radius_m_;
  std::vector<std::size_t> drones_;
  std::vector<Vec2> places_;
  safety::NeighbourGrid grid_;
};

/// Each active drone's distance to its nearest, ascending; empty where there are less than two.
std::vector<double> to_nearest(const ActiveDrones& active) {
  std::vector<double> distances;
  for (std::size_t i = 0; active.places().size() > 1 && i < active.places().size(); ++i)
    distances.push_back(active.nearest_to(active.places()[i], i).distance_m);
  std::sort(distances.begin(), distances.end());
  return distances;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

double distance_m(const FlightData& data, std::size_t tick, std::size_t a, std::size_t b) {
  return (data.positions[data.flight.row(tick, a)] - data.positions[data.flight.row(tick, b)]).norm();
}

std::vector<NearestDistances> nearest_distances(const FlightData& data) {
  std::vector<NearestDistances> out;
  ActiveDrones active(data);
  const std::size_t stride = stride_for(data);
  for (std::size_t tick = 0; tick < data.ticks(); tick += stride) {
    active.look_at(tick);
    const std::vector<double> nearest = to_nearest(active);
    if (nearest.empty()) continue;
    out.push_back({tick, nearest.front(), quantile(nearest, 0.1), quantile(nearest, 0.5), quantile(nearest, 0.9)});
  }
  return out;
}

bool is_down(const FlightData& data, std::size_t tick, std::size_t drone) {
  const double landed_m = runtime::AuditLimits{}.landed_height_m;
  const std::size_t row = data.flight.row(tick, drone);
  const double height_m = data.has_truth ? data.flight.rows.true_height_m[row] : data.flight.rows.height_m[row];
  return data.flight.rows.mode[row] == swarm::VehicleMode::kGrounded || height_m <= landed_m;
}

ClosestToLost closest_to_lost(const FlightData& data) {
  ClosestToLost closest;
  std::vector<bool> was_active(data.drones(), false);
  std::vector<std::size_t> lost;
  ActiveDrones active(data);
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    lost.clear();
    for (std::size_t i = 0; i < data.drones(); ++i) {
      if (data.flight.is_active(tick, i))
        was_active[i] = true;
      else if (was_active[i] && is_down(data, tick, i) && data.positions[data.flight.row(tick, i)].allFinite())
        lost.push_back(i);
    }
    if (lost.empty()) continue;
    active.look_at(tick);
    for (const std::size_t drone : lost) {
      const ActiveDrones::Nearest nearest = active.nearest_to(data.positions[data.flight.row(tick, drone)]);
      if (nearest.distance_m < closest.distance_m) closest = {nearest.distance_m, tick, nearest.drone, drone};
    }
  }
  return closest;
}

}  // namespace vigil::report

#include "vigil/adapters/report/distances.hpp"

#include <algorithm>

#include "vigil/runtime/flight_audit.hpp"

namespace vigil::report {
namespace {

constexpr double kPairsToMeasure = 2e8;  // some tenths of a second

std::size_t stride_for(const FlightData& data, double most_ticks) {
  const double n = static_cast<double>(data.drones());
  const double affordable = std::min(std::max(kPairsToMeasure / (n * n), 50.0), most_ticks);
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(data.ticks()) / affordable));
}

std::vector<Vec2> active_positions(const FlightData& data, std::size_t tick) {
  std::vector<Vec2> positions;
  for (std::size_t i = 0; i < data.drones(); ++i) {
    const Vec2& p = data.positions[data.flight.row(tick, i)];
    if (data.flight.is_active(tick, i) && p.allFinite()) positions.push_back(p);
  }
  return positions;
}

std::vector<double> to_nearest(const std::vector<Vec2>& positions) {
  std::vector<double> squared(positions.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const double d = (positions[i] - positions[j]).squaredNorm();
      squared[i] = std::min(squared[i], d);
      squared[j] = std::min(squared[j], d);
    }
  }
  std::sort(squared.begin(), squared.end());
  for (double& d : squared) d = std::sqrt(d);
  return squared;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

double distance_m(const FlightData& data, std::size_t tick, std::size_t a, std::size_t b) {
  return (data.positions[data.flight.row(tick, a)] - data.positions[data.flight.row(tick, b)]).norm();
}

std::vector<NearestDistances> nearest_distances(const FlightData& data) {
  constexpr double kMostTicks = 600.0;
  std::vector<NearestDistances> out;
  const std::size_t stride = stride_for(data, kMostTicks);
  for (std::size_t tick = 0; tick < data.ticks(); tick += stride) {
    const std::vector<double> nearest = to_nearest(active_positions(data, tick));
    if (nearest.size() < 2) continue;
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
  const std::size_t stride = stride_for(data, static_cast<double>(data.ticks()));
  for (std::size_t tick = 0; tick < data.ticks(); tick += stride) {
    for (std::size_t i = 0; i < data.drones(); ++i) {
      if (data.flight.is_active(tick, i)) was_active[i] = true;
      if (data.flight.is_active(tick, i) || !was_active[i] || !is_down(data, tick, i)) continue;
      for (std::size_t j = 0; j < data.drones(); ++j) {
        if (!data.flight.is_active(tick, j)) continue;
        const double d = distance_m(data, tick, i, j);
        if (d < closest.distance_m) closest = {d, tick, j, i};
      }
    }
  }
  return closest;
}

}  // namespace vigil::report

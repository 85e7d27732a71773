#include "vigil/runtime/flight_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vigil/runtime/live_frame.hpp"

namespace vigil::runtime {
namespace {

constexpr double kRounding = 1e-9;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

enum class Keep { kLast, kMost, kLeast };
constexpr std::array<Keep, FlightHistory::kOfSwarm> kKeptOfSwarm{Keep::kLast, Keep::kMost, Keep::kLeast, Keep::kLeast,
                                                                 Keep::kMost};

float or_none(double value) { return std::isfinite(value) ? static_cast<float>(value) : kNone; }

double speed_asked(const swarm::DroneSnapshot& drone) { return drone.order.velocity.norm(); }

double distance_in_the_air(const swarm::DroneSnapshot& a, const swarm::DroneSnapshot& b) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  return is_airborne(a) && is_airborne(b) ? (a.position - b.position).norm() : kNowhere;
}

double fastest(const swarm::Snapshot& snapshot) {
  double most = 0.0;
  for (const swarm::DroneSnapshot& drone : snapshot.drones) most = std::max(most, speed_asked(drone));
  return most;
}

}  // namespace

FlightHistory::FlightHistory(std::size_t drones) : plotted_(drones <= kMostPlotted ? drones : 0) {
  rows_.reserve(kMostRows);
}

std::size_t FlightHistory::columns() const noexcept {
  return kOfSwarm + plotted_ + (plotted_ == 0 ? 0 : plotted_ * (plotted_ - 1) / 2);
}

bool FlightHistory::is_due(double time_s) const noexcept {
  return rows_.empty() || time_s >= rows_.back().time_s + kSpacingS - kRounding;
}

FlightHistory::Row FlightHistory::row_of(const swarm::Snapshot& snapshot, double worst_age_s) const {
  Row row{snapshot.time_s, snapshot.time_s, {}};
  row.values = {snapshot.has_metric ? or_none(snapshot.metric_percent) : kNone, or_none(worst_age_s),
                or_none(least_airborne_pair_m(snapshot)), static_cast<float>(snapshot.active),
                or_none(fastest(snapshot))};
  std::size_t column = kOfSwarm;
  for (std::size_t i = 0; i < plotted_; ++i) row.values.at(column++) = or_none(speed_asked(snapshot.drones[i]));
  for (std::size_t i = 0; i < plotted_; ++i)
    for (std::size_t j = i + 1; j < plotted_; ++j)
      row.values.at(column++) = or_none(distance_in_the_air(snapshot.drones[i], snapshot.drones[j]));
  return row;
}

void FlightHistory::merge(Row& into, const Row& later) const noexcept {
  into.time_s = later.time_s;
  for (std::size_t column = 0; column < columns(); ++column) {
    float& value = into.values[column];
    const float other = later.values[column];
    const Keep of_drones = column < kOfSwarm + plotted_ ? Keep::kMost : Keep::kLeast;
    const Keep keep = column < kOfSwarm ? kKeptOfSwarm[column] : of_drones;
    // NaN gives way to a number.
    if (keep == Keep::kLast) value = other;
    if (keep == Keep::kMost) value = std::fmax(value, other);
    if (keep == Keep::kLeast) value = std::fmin(value, other);
  }
}

void FlightHistory::halve() {
  spacing_s_ *= 2.0;
  for (std::size_t i = 0; 2 * i + 1 < rows_.size(); ++i) {
    rows_[i] = rows_[2 * i];
    merge(rows_[i], rows_[2 * i + 1]);
  }
  rows_.resize(rows_.size() / 2);
}

void FlightHistory::add(const swarm::Snapshot& snapshot, double worst_age_s) {
  if (!is_due(snapshot.time_s)) return;
  const Row row = row_of(snapshot, worst_age_s);
  if (!rows_.empty() && row.time_s < rows_.back().begin_s + spacing_s_ - kRounding) return merge(rows_.back(), row);
  if (rows_.size() == kMostRows) halve();
  rows_.push_back(row);
}

FlightHistory FlightHistory::until(double time_s) const {
  FlightHistory before = *this;
  const auto after = std::ranges::upper_bound(before.rows_, time_s + kRounding, {}, &Row::time_s);
  before.rows_.erase(after, before.rows_.end());
  before.rows_.reserve(kMostRows);
  return before;
}

}  // namespace vigil::runtime

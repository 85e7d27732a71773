#include "vigil/adapters/ros/position_gate.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::ros_bridge {
namespace {

constexpr double kSmoothingS = 0.05;
constexpr double kLeastStepS = 1e-3;
constexpr double kFliesOnS = 0.1;  ///< for so long a drone that is not seen is expected to keep its velocity

bool is_finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool is_same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// The stamp, but for one from the future: then the clocks differ, and it is of now as far as is known.
double sane_stamp(const Sighting& sighting) { return std::min(sighting.measured_s, sighting.received_s); }

}  // namespace

double PositionGate::age_s(double now_s) const {
  return has_seen_ ? std::max(0.0, now_s - measured_s_) : swarm::DroneObservation::kNever;
}

bool PositionGate::is_timely(const Sighting& sighting) const {
  return sighting.number > 0 && is_finite(sighting.place) &&
         sighting.received_s - sane_stamp(sighting) <= parameters_.late_s;
}

Point PositionGate::expected(const Sighting& sighting) const {
  const double unseen_s = std::clamp(sane_stamp(sighting) - measured_s_, 0.0, kFliesOnS);
  const double speed_m_s = std::hypot(velocity_.x, velocity_.y, velocity_.z);
  const double ahead_s = unseen_s * parameters_.reach_m_s / std::max(speed_m_s, parameters_.reach_m_s);
  return {place_.x + ahead_s * velocity_.x, place_.y + ahead_s * velocity_.y, place_.z + ahead_s * velocity_.z};
}

PositionGate::Verdict PositionGate::look(const Sighting& sighting, bool flies, bool is_anothers) {
  if (sighting.number == number_) return Verdict::kNothingNew;
  const bool is_first = number_ == 0;
  number_ = sighting.number;
  if (!is_finite(sighting.place)) return Verdict::kNotANumber;
  if (is_first || !is_same(sighting.place, newest_)) {
    newest_ = sighting.place;
    changed_s_ = sighting.received_s;
  }
  const double measured_s = sane_stamp(sighting);
  const Verdict verdict = judge(sighting, measured_s, flies, is_anothers);
  if (verdict == Verdict::kBelieved) believe(sighting.place, measured_s);
  return verdict;
}

PositionGate::Verdict PositionGate::judge(const Sighting& sighting, double measured_s, bool flies, bool is_anothers) {
  if (sighting.received_s - measured_s > parameters_.late_s) return Verdict::kLate;
  if (sighting.received_s - changed_s_ > parameters_.frozen_s) return Verdict::kFrozen;
  if (is_anothers) return Verdict::kAnothers;
  if (!has_seen_) return Verdict::kBelieved;
  if (measured_s - measured_s_ < kLeastStepS) return Verdict::kOlder;
  const double unseen_s = std::clamp(measured_s - measured_s_, 0.0, parameters_.most_reach_s);
  if (distance(sighting.place, place_) <= parameters_.slack_m + parameters_.reach_m_s * unseen_s) {
    settling_since_s_ = -1.0;
    return Verdict::kBelieved;
  }
  return !flies && is_settled(sighting) ? Verdict::kBelieved : Verdict::kJumped;
}

bool PositionGate::is_settled(const Sighting& sighting) {
  if (settling_since_s_ < 0.0 || distance(sighting.place, settling_) > parameters_.slack_m) {
    settling_ = sighting.place;
    settling_since_s_ = sighting.received_s;
  }
  return sighting.received_s - settling_since_s_ >= parameters_.settled_s;
}

void PositionGate::believe(const Point& place, double measured_s) {
  if (has_seen_) {
    const double dt_s = measured_s - measured_s_;
    const double share = dt_s / (dt_s + kSmoothingS);
    velocity_.x += share * ((place.x - place_.x) / dt_s - velocity_.x);
    velocity_.y += share * ((place.y - place_.y) / dt_s - velocity_.y);
    velocity_.z += share * ((place.z - place_.z) / dt_s - velocity_.z);
  }
  place_ = place;
  measured_s_ = measured_s;
  has_seen_ = true;
}

}  // namespace vigil::ros_bridge

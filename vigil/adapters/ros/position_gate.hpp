#pragma once

#include <cstdint>

#include "vigil/adapters/ros/crazyswarm_port.hpp"
#include "vigil/swarm/observation.hpp"

namespace vigil::ros_bridge {

struct GateParameters {
  double reach_m_s = 1.0;     ///< no drone is faster
  double slack_m = 0.1;       ///< what a tracker may err from one position to the next
  double most_reach_s = 0.5;  ///< a drone that was not seen for longer is looked for no farther away
  double late_s = 0.15;       ///< positions that took longer are not used
  double frozen_s = 0.25;     ///< the same bits for so long: the tracker repeats itself
  double settled_s =
      1.0;  ///< of a drone that does not fly (people carry it, it falls) a new place is believed after so long
};

/// Which of a tracker's positions are believed. One that is late, repeated to the last bit, not a number, or farther
/// from the last believed one than the drone can have flown, is as good as none: what is known only grows older. Two
/// bodies that swap their names jump, both of them, unless they are closer together than the slack. One thread.
class PositionGate {
 public:
  enum class Verdict : std::uint8_t { kNothingNew, kBelieved, kLate, kFrozen, kJumped, kNotANumber };

  explicit PositionGate(const GateParameters& parameters) : parameters_(parameters) {}

  /// `flies`: it follows setpoints, or climbs to where it will.
  Verdict look(const Sighting& sighting, bool flies);

  [[nodiscard]] bool has_seen() const { return has_seen_; }
  [[nodiscard]] const Point& place() const { return place_; }        ///< last believed
  [[nodiscard]] const Point& velocity() const { return velocity_; }  ///< by differences, smoothed over 50 ms
  /// Since the place was true; swarm::DroneObservation::kNever before the first.
  [[nodiscard]] double age_s(double now_s) const;

 private:
  [[nodiscard]] Verdict judge(const Sighting& sighting, double measured_s, bool flies);
  [[nodiscard]] bool is_settled(const Sighting& sighting);
  void believe(const Point& place, double measured_s);

  GateParameters parameters_;
  std::uint64_t number_ = 0;
  bool has_seen_ = false;
  Point place_;
  Point velocity_;
  double measured_s_ = 0.0;  ///< of place_
  Point newest_;             ///< believed or not
  double changed_s_ = 0.0;   ///< since when newest_ is what it is
  Point settling_;           ///< where it is seen although it cannot be there
  double settling_since_s_ = -1.0;
};

}  // namespace vigil::ros_bridge

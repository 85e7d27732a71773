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

/// Which of a tracker's positions are believed. One that is late, older than what is known, repeated to the last bit,
/// not a number, or farther from the last believed one than the drone can have flown, is as good as none: what is known
/// only grows older. So is one that is known to be of another drone's body (MistakenBodies), however near. One thread.
class PositionGate {
 public:
  enum class Verdict : std::uint8_t { kNothingNew, kBelieved, kLate, kOlder, kFrozen, kAnothers, kJumped, kNotANumber };

  explicit PositionGate(const GateParameters& parameters) : parameters_(parameters) {}

  /// `flies`: it follows setpoints, or climbs to where it will. `is_anothers`: the position is of another drone's body.
  Verdict look(const Sighting& sighting, bool flies, bool is_anothers = false);

  [[nodiscard]] bool has_seen() const { return has_seen_; }
  [[nodiscard]] const Point& place() const { return place_; }        ///< last believed
  [[nodiscard]] const Point& velocity() const { return velocity_; }  ///< by differences, smoothed over 50 ms
  /// Whether a position took no longer than those that are used may.
  [[nodiscard]] bool is_timely(const Sighting& sighting) const;
  /// Where the drone is expected when `sighting` was measured: at the last believed place, or a little further along.
  [[nodiscard]] Point expected(const Sighting& sighting) const;
  /// Since the place was true; swarm::DroneObservation::kNever before the first.
  [[nodiscard]] double age_s(double now_s) const;

 private:
  [[nodiscard]] Verdict judge(const Sighting& sighting, double measured_s, bool flies, bool is_anothers);
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

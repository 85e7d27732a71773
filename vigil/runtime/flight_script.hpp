#pragma once

#include <string>
#include <vector>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorder.hpp"
#include "vigil/swarm/command.hpp"

namespace vigil::runtime {

/// What became due at one tick.
struct DueEvents {
  std::vector<swarm::Command> commands;  ///< for the controller; no kSetTarget: that follows from targets_changed
  bool targets_changed = false;          ///< the mission's targets are others now
  std::vector<LoggedEvent> log;
};

/// Plays a mission file's events: what operators, pilots and the world do, at their times.
class FlightScript {
 public:
  /// Precondition: a mission that mission checks accepted; it and `fleet` outlive this.
  FlightScript(Mission& mission, VirtualFleet& fleet);

  /// Lets everything happen that is due at time_s: to the vehicles and to the mission's targets at once, to the
  /// controller by the commands that it returns.
  [[nodiscard]] DueEvents play(double time_s);

 private:
  void play_event(const EventEntry& event, DueEvents& due);
  void play_for_drones(const EventEntry& event, DueEvents& due);
  void edit_targets(const EventEntry& event, DueEvents& due);

  Mission& mission_;
  VirtualFleet& fleet_;
  std::size_t next_ = 0;
};

}  // namespace vigil::runtime

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
  std::vector<swarm::Command> commands;  ///< for the controller; no kSetTarget: that follows from target_edits
  std::vector<EventEntry> target_edits;  ///< to be applied by apply_edit(), or by an operator's rules
  std::vector<LoggedEvent> log;
};

/// Whether an event changes where to look.
[[nodiscard]] bool edits_targets(EventKind kind);

/// Whether an event befalls a drone, rather than that somebody wished it.
[[nodiscard]] bool is_of_the_world(EventKind kind);

/// Changes targets as one of a mission file's events for targets says. Precondition: the event fits them, as the
/// mission's checks found, unless somebody else has changed the targets since.
void apply_edit(TargetsSection& targets, const EventEntry& event);

/// Plays a mission file's events: what operators, pilots and the world do, at their times.
class FlightScript {
 public:
  /// Precondition: a mission that mission checks accepted; it and `fleet` outlive this.
  FlightScript(const Mission& mission, VirtualFleet& fleet);

  /// Lets everything happen that is due at time_s: to the vehicles at once, to the controller and the targets by what
  /// it returns. Allocates nothing where nothing is due.
  [[nodiscard]] DueEvents play(double time_s);
  /// Passes over all that was due before time_s.
  void skip_to(double time_s) noexcept;
  /// How many of the mission's events are over.
  [[nodiscard]] std::size_t played() const noexcept { return next_; }

 private:
  void play_event(const EventEntry& event, DueEvents& due);
  void play_for_drones(const EventEntry& event, DueEvents& due);

  [[nodiscard]] Mishap mishap_from(const EventEntry& event, MishapKind kind) const;

  const Mission& mission_;
  VirtualFleet& fleet_;
  std::size_t next_ = 0;
};

}  // namespace vigil::runtime

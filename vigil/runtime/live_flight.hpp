#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vigil/runtime/flight_audit.hpp"
#include "vigil/runtime/flight_script.hpp"
#include "vigil/runtime/flight_start.hpp"
#include "vigil/runtime/goal_script.hpp"
#include "vigil/runtime/hand_over.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/standing_orders.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// What somebody asks of a live flight. A ticket other than 0 is answered by one LiveEvent::Kind::kAnswer.
struct LiveCommand {
  /// The last two are for recordings alone.
  enum class Kind : std::uint8_t { kSwarm, kSetSpeed, kPause, kResumeClock, kSeek, kStep };
  Kind kind = Kind::kSwarm;
  swarm::Command swarm;        ///< kSwarm
  std::uint64_t revision = 0;  ///< kSwarm with kSetTarget: of the mission's targets
  double speed = 1.0;          ///< kSetSpeed: factor of real time, > 0
  double seek_s = 0.0;         ///< kSeek: to the last tick at this mission time or before, or the first
  std::int64_t steps = 0;      ///< kStep: so many kept ticks on, or back where negative; pauses
  std::uint64_t ticket = 0;    ///< shared by the commands that one message became; they stand next to each other
  bool is_last_of_ticket = true;
};

/// What a live flight has to tell, in the order in which it happened.
struct LiveEvent {
  enum class Kind : std::uint8_t {
    kSwarm,    ///< `event`, of the swarm; wishes with a ticket are told as kRefusal instead
    kScript,   ///< the mission's event number `index` was played; where it wants other targets, somebody sees to it
    kRefusal,  ///< a drone could not follow the command of `ticket`
    kAnswer    ///< the commands of `ticket` took effect; `accepted` drones follow, `refused` do not
  };
  Kind kind = Kind::kSwarm;
  std::uint64_t tick = 0;
  double time_s = 0.0;
  swarm::Event event;
  swarm::DroneSnapshot drone;  ///< kSwarm, kRefusal: how it was after the tick
  std::size_t active = 0;      ///< drones that covered in the tick
  std::size_t index = 0;
  std::uint64_t ticket = 0;
  std::uint64_t revision = 0;  ///< kAnswer: of the targets in effect
  std::size_t accepted = 0;
  std::size_t refused = 0;
};

/// A mission flown tick by tick, without an end of its own: script, fleet, tick, judge, recorder. The control thread
/// only. Nothing allocates but an event of the script.
class LiveFlight {
 public:
  /// Precondition: a mission that mission checks accepted; what is referred to outlives this. `world`: the fleet where
  /// it is a simulated one, otherwise null, and the script is not played; recorder and workers may be null.
  LiveFlight(const Mission& mission, Fleet& fleet, VirtualFleet* world, Recorder* recorder, const FlightStart& start,
             parallel::Workers* workers = nullptr);

  /// One tick under `commands`, all of kind kSwarm: events, observation, control, judgement, record, orders; in a
  /// simulated world dt passes. Writes all of `out` but what is the clock's. Precondition: events_of(commands) does not
  /// exceed event_budget().
  void step(std::span<const LiveCommand> commands, LiveFrame& out, Outbox<LiveEvent>& outbox) noexcept;

  [[nodiscard]] const swarm::SwarmState& state() const noexcept { return state_; }
  [[nodiscard]] double dt_s() const noexcept { return state_.parameters().dt_s; }
  /// How many events a command may cause in a tick, and how many of them one tick can tell apart.
  [[nodiscard]] std::size_t events_of(const LiveCommand& command) const noexcept;
  [[nodiscard]] std::size_t event_budget() const noexcept { return 2 * observations_.size() + 32; }

 private:
  void play_script(double time_s, Outbox<LiveEvent>& outbox) noexcept;
  void gather(std::span<const LiveCommand> commands) noexcept;
  void tell(std::span<const LiveCommand> commands, const swarm::Snapshot& snapshot, Outbox<LiveEvent>& outbox) noexcept;
  void judge_and_record(const swarm::Snapshot& snapshot) noexcept;
  void give_orders(const swarm::Snapshot& snapshot) noexcept;

  Fleet& fleet_;
  VirtualFleet* world_;
  Recorder* recorder_;
  parallel::Workers* workers_;
  swarm::SwarmState state_;
  std::optional<FlightScript> script_;
  std::optional<GoalScript> goals_;
  std::optional<swarm::Snapshot> last_;  ///< of the tick before, where there are goals
  std::optional<FlightAudit> audit_;
  StandingOrders standing_;
  std::uint64_t revision_ = 0;
  std::uint64_t newest_order_ = 0;
  std::vector<swarm::DroneObservation> observations_;
  std::vector<swarm::DroneOrder> orders_;
  std::vector<swarm::Command> commands_;  ///< of this tick: the script's, those of standing_, then the operators'
  std::size_t script_commands_ = 0;       ///< how many of them nobody here asked for: the script's and standing_'s
};

}  // namespace vigil::runtime

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vigil/adapters/recording/cdr_writer.hpp"
#include "vigil/runtime/flight_recording.hpp"

/// The program's own messages, protocol/vigil_msgs: all that a flight was given and decided, bit for bit. Those that
/// read throw RecordingError for bytes that are no such message; nothing in bytes makes them do worse.
namespace vigil::recording {

/// Most drones of a flight that is read.
inline constexpr std::size_t kMostDrones = 200'000;

/// vigil_msgs/msg/Mission
void write_head(CdrWriter& writer, const runtime::RecordingHead& head);
[[nodiscard]] runtime::RecordingHead read_head(std::span<const char> message);

/// vigil_msgs/msg/Tick. `fallback` and `clearances` stand for those that were left out before this one, too.
/// `is_thinned`: what was known of the drones is written instead of what was observed.
struct TickToWrite {
  const swarm::Snapshot& snapshot;
  std::span<const swarm::DroneObservation> observations;
  std::span<const runtime::TruthSample> truth;
  runtime::Clearances clearances;
  bool fallback = false;
  bool is_thinned = false;
};
void write_tick(CdrWriter& writer, const TickToWrite& tick);
/// All but the commands. Damage that leaves the message readable is noted in `into`.
void read_tick(std::span<const char> message, runtime::RecordedTick& into);

/// vigil_msgs/msg/Commands: those that a tick was given.
void write_commands(CdrWriter& writer, std::uint64_t tick, std::span<const swarm::Command> commands);
/// The tick's number, and its commands. Empty commands where the message is damaged.
struct CommandsRead {
  std::uint64_t tick = 0;
  std::vector<swarm::Command> commands{};
  bool is_damaged = false;
};
[[nodiscard]] CommandsRead read_commands(std::span<const char> message);

/// vigil_msgs/msg/Targets
void write_targets(CdrWriter& writer, double time_s, const runtime::MissionTargets& targets);
[[nodiscard]] runtime::RecordedTargets read_targets(std::span<const char> message);

/// vigil_msgs/msg/Event
void write_event(CdrWriter& writer, const runtime::LoggedEvent& event);
[[nodiscard]] runtime::LoggedEvent read_event(std::span<const char> message);

}  // namespace vigil::recording

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vigil/adapters/console/role.hpp"
#include "vigil/core/field/vec2.hpp"
#include "vigil/runtime/mission_text.hpp"
#include "vigil/runtime/target_edit.hpp"
#include "vigil/swarm/command.hpp"

/// What clients say, by protocol/README.md. Everything that arrives is checked here, once.
namespace vigil::console {

/// A mission file of the greatest size with all that JSON makes two characters of one (\" of "), and what stands around
/// it.
inline constexpr std::size_t kMostMessageBytes = 2 * runtime::kMostMissionBytes + 1024;

struct Hello {
  std::string name;
  std::string token;
  std::optional<Role> role;
  bool confirms = false;
  /// The page's own mark, the same over all its connections; empty where it has none.
  std::string page;
};
/// How many messages have come to the client since its connection began; not answered.
struct Confirm {
  std::uint64_t received = 0;
};
struct Ping {};
struct PreviewDensity {
  std::uint64_t based_on = 0;
  std::vector<runtime::TargetEdit> edits;
};
/// How the swarm would do, with these edits and without these drones.
struct Preview {
  double seconds = 60.0;
  std::optional<std::uint64_t> based_on;  ///< where there are edits
  std::vector<runtime::TargetEdit> edits;
  std::vector<std::string> without;  ///< ids
};
/// Why a drone flies as it does in the newest tick.
struct Why {
  std::string drone;  ///< its id
};
struct Editing {
  std::vector<runtime::TargetName> what;
};
/// The flight that somebody was looking at: what is given must be the one that is flown.
struct SeenFlight {
  std::optional<std::string> run;      ///< of `hello`
  std::optional<std::uint64_t> epoch;  ///< of `mission`
};
struct DroneWish {
  swarm::CommandKind kind = swarm::CommandKind::kHold;
  bool all = false;
  std::vector<std::string> drones;  ///< ids, where not all
  std::optional<Vec2> place_m;      ///< kGoTo: world frame; none: each drone's own start
  SeenFlight seen;
};
struct Edit {
  std::uint64_t based_on = 0;
  std::vector<runtime::TargetEdit> edits;
  SeenFlight seen;
};
struct Undo {
  std::uint64_t based_on = 0;
  SeenFlight seen;
};
struct Redo {
  std::uint64_t based_on = 0;
  SeenFlight seen;
};
struct StartAfresh {};
struct SetSpeed {
  double factor = 1.0;
};
struct Pause {};
struct ResumeClock {};
/// Recordings alone.
struct Seek {
  double time_s = 0.0;  ///< to the last tick then or before
};
/// Recordings alone.
struct StepTicks {
  std::int64_t ticks = 1;  ///< on, or back where negative; never 0
};
struct LoadMission {
  std::string yaml;
};

using MessageBody = std::variant<Hello, Confirm, Ping, PreviewDensity, Preview, Why, Editing, DroneWish, Edit, Undo,
                                 Redo, StartAfresh, SetSpeed, Pause, ResumeClock, Seek, StepTicks, LoadMission>;

struct ClientMessage {
  std::optional<std::uint64_t> id;  ///< always there but for Hello and Confirm
  std::string type;
  MessageBody body;
};

/// Why a message or command was not followed.
struct MessageRefusal {
  std::optional<std::uint64_t> id;  ///< where it could be read
  std::string_view code;            ///< one of the protocol's words
  std::string reason;               ///< one line, for people
};

/// Any bytes. Never throws but for want of memory.
[[nodiscard]] std::variant<ClientMessage, MessageRefusal> parse_client_message(std::string_view text);

/// The same of a `preview` without type and id: the body of POST /api/preview.
[[nodiscard]] std::variant<ClientMessage, MessageRefusal> parse_preview(std::string_view text);

/// The least role that may send a message.
[[nodiscard]] Role role_for(const MessageBody& body);

}  // namespace vigil::console

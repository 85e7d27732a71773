#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "vigil/adapters/console/client_message.hpp"
#include "vigil/adapters/console/role.hpp"
#include "vigil/runtime/event_words.hpp"
#include "vigil/runtime/ground_picture.hpp"
#include "vigil/runtime/mission_desk.hpp"

/// The JSON that the server says: protocol/README.md, member for member.
#include "vigil/swarm/snapshot.hpp"

namespace vigil::console {

inline constexpr double kMostSpeed = 20.0;

/// What stands in the log of events.
struct ConsoleEvent {
  std::uint64_t number = 0;
  std::uint32_t epoch = 0;  ///< of the flight in which it happened
  std::uint64_t tick = 0;
  double time_s = 0.0;
  double wall_ms = 0.0;
  std::string source{};
  std::string what{};
  std::string drone{};
  std::string was{};
  std::string by{};
  runtime::EventWords words{};
};

/// Somebody at a console.
struct Operator {
  std::uint32_t client = 0;
  std::string name;
  Role role = Role::kViewer;
  std::vector<runtime::TargetName> editing;
};

/// The state of a recording.
struct RecordingState {
  std::string folder;
  std::uint64_t ticks = 0;
  std::uint64_t lost_ticks = 0;
};

/// What a recording is, for those who look at it.
struct RecordingFacts {
  double begin_s = 0.0;  ///< mission time of its first tick
  double end_s = 0.0;    ///< of its last one
  std::uint64_t ticks = 0;
  double spacing_s = 0.0;  ///< between two of them
  std::string incomplete;  ///< why it is not whole, for people; empty: it is
};

/// Where a recording stands.
struct ReplayState {
  std::uint64_t number = 0;    ///< ticks that are behind
  bool is_recomputed = false;  ///< false: what is shown is what was recorded
  bool is_seeking = false;
  double progress = 1.0;  ///< how much of the way that it seeks is behind, [0, 1]
  bool is_at_end = false;
  std::string difference;  ///< what of the tick came out otherwise than recorded, for people; empty: nothing
};

/// An order that was acknowledged as pending, and has not been carried out.
struct WaitingOrder {
  std::string text;  ///< for people: "land cf1, cf2"
  std::string from;  ///< who gave it
};

/// Of the orders that wait, those that `status` lists.
inline constexpr std::size_t kMostWaitingShown = 8;

struct StatusContext {
  std::uint32_t epoch = 0;
  std::optional<RecordingState> recording;
  std::size_t lost_events = 0;
  std::size_t clients = 0;
  runtime::LatenessFigures lateness;
  runtime::LatenessFigures lateness_ever;
  bool waits_for_resume = false;
  std::vector<WaitingOrder> waiting;  ///< the oldest first, at most kMostWaitingShown
  std::size_t waiting_more = 0;       ///< how many wait besides
  std::optional<ReplayState> replay;
  /// Who is to be charged when; empty without stations. At most kMostPlanned are told of.
  std::span<const swarm::DroneSnapshot> plan = {};
};

/// The plan of so many drones is told, the first ones'.
inline constexpr std::size_t kMostPlanned = 200;

/// A command's answer, before its id.
struct Answer {
  std::uint64_t tick = 0;
  bool is_pending = false;
  std::optional<std::uint64_t> revision{};
  std::vector<std::pair<std::string, std::string>> refused_drones{};  ///< id, reason: of the first
  std::size_t refused_count = 0;                                      ///< of all that could not follow
};

using Json = nlohmann::ordered_json;

/// JSON knows no infinity.
[[nodiscard]] Json finite_or_null(double value);

[[nodiscard]] Json hello_json(const Operator& client, std::string_view program, std::string_view run, bool wants_login,
                              double steady_ms);
[[nodiscard]] Json mission_message(const runtime::Mission& mission, std::uint32_t epoch, bool has_real_drones);
[[nodiscard]] Json recorded_mission_message(const runtime::Mission& mission, std::uint32_t epoch,
                                            const RecordingFacts& recording);
[[nodiscard]] Json targets_json(const runtime::MissionDesk& desk, std::uint32_t epoch);
[[nodiscard]] Json event_json(const ConsoleEvent& event);
[[nodiscard]] Json events_json(const std::vector<Json>& events);
/// The same, in place of all that was told before.
[[nodiscard]] Json events_afresh_json(const std::vector<Json>& events);
[[nodiscard]] Json status_json(const std::vector<runtime::AreaState>& areas, const StatusContext& context);
[[nodiscard]] Json presence_json(const std::vector<Operator>& operators);
[[nodiscard]] Json ack_json(std::uint64_t id, const Answer& answer);
[[nodiscard]] Json refused_json(const MessageRefusal& refusal);
[[nodiscard]] Json pong_json(std::uint64_t id, double wall_ms, double steady_ms);
[[nodiscard]] Json bye_json(std::string_view code, std::string_view reason);

/// The protocol's word for why a desk refused.
[[nodiscard]] std::string_view code_of(runtime::Refusal::Code code);

/// For the wire. Text that is not UTF-8 (a file's name) is shown with replacement characters.
[[nodiscard]] std::string in_text(const Json& json);

}  // namespace vigil::console

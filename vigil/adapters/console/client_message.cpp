#include "vigil/adapters/console/client_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/edit_json.hpp"
#include "vigil/adapters/console/json_reader.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_text.hpp"
#include "vigil/runtime/preview.hpp"

namespace vigil::console {
namespace {

using swarm::CommandKind;

constexpr std::size_t kMostDrones = 100'000;
constexpr std::size_t kMostIdBytes = 64;
constexpr std::size_t kMostEditing = 20;
constexpr std::size_t kMostReasonBytes = 400;
constexpr double kMostSteps = 1e6;

struct WishWord {
  std::string_view word;
  CommandKind kind;
};
constexpr std::array<WishWord, 9> kWishes{{{"take_off", CommandKind::kTakeOff},
                                           {"land", CommandKind::kLand},
                                           {"hold", CommandKind::kHold},
                                           {"go_to", CommandKind::kGoTo},
                                           {"return", CommandKind::kGoTo},
                                           {"resume", CommandKind::kResume},
                                           {"mark_failed", CommandKind::kMarkFailed},
                                           {"give_back", CommandKind::kGiveBack},
                                           {"emergency_stop", CommandKind::kEmergencyStop}}};

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20U || c == '\x7F'; }

std::string name_in(const JsonReader& reader) {
  constexpr std::size_t kMostNameBytes = 128;
  std::string name = reader.text("name", kMostNameBytes);
  const auto starts_one = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  const auto characters = std::count_if(name.begin(), name.end(), starts_one);
  if (characters < 1 || characters > 32 || std::any_of(name.begin(), name.end(), is_control))
    reader.refuse("name", "must be one line of 1 to 32 characters");
  return name;
}

/// Too long to be met by chance, and not guessed.
std::string page_in(const JsonReader& reader) {
  constexpr std::size_t kPageBytes = 32;
  std::string page = reader.text("page", kPageBytes);
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (page.size() != kPageBytes || !std::ranges::all_of(page, is_hex))
    reader.refuse("page", "must be 32 digits of 0-9 and a-f, drawn at random when the page was opened");
  return page;
}

Hello hello_in(const JsonReader& reader) {
  constexpr std::size_t kMostTokenBytes = 512;
  reader.allow_only({"type", "name", "token", "role", "confirms", "page"});
  Hello hello;
  if (reader.has("name")) hello.name = name_in(reader);
  if (reader.has("token")) hello.token = reader.text("token", kMostTokenBytes);
  if (reader.has("role")) {
    hello.role = role_of(reader.text("role", kMostIdBytes));
    if (!hello.role) reader.refuse("role", fmt::format("must be one of: {}", fmt::join(kRoleWords, ", ")));
  }
  if (reader.has("confirms")) hello.confirms = reader.flag("confirms");
  if (reader.has("page")) hello.page = page_in(reader);
  return hello;
}

Confirm confirm_in(const JsonReader& reader) {
  reader.allow_only({"type", "received"});
  return {reader.whole("received")};
}

SeenFlight seen_in(const JsonReader& reader) {
  SeenFlight seen;
  if (reader.has("run")) seen.run = reader.text("run", kMostIdBytes);
  if (reader.has("epoch")) seen.epoch = reader.whole("epoch");
  return seen;
}

DroneWish wish_in(const JsonReader& reader, std::string_view type, CommandKind kind) {
  DroneWish wish{kind, false, {}, {}, {}};
  if (type == "go_to") {
    reader.allow_only({"type", "id", "run", "epoch", "drones", "place_m"});
    wish.place_m = reader.point("place_m");
  } else {
    reader.allow_only({"type", "id", "run", "epoch", "drones"});
  }
  wish.seen = seen_in(reader);
  if (!reader.is_text("drones")) {
    wish.drones = reader.texts("drones", kMostDrones, kMostIdBytes);
    if (wish.drones.empty()) reader.refuse("drones", "must name at least one drone");
    return wish;
  }
  wish.all = reader.text("drones", kMostIdBytes) == "all";
  if (!wish.all) reader.refuse("drones", "must be \"all\" or a list of ids");
  return wish;
}

Editing editing_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "what"});
  Editing editing;
  for (const JsonReader& entry : reader.objects("what", kMostEditing)) {
    entry.allow_only({"kind", "name"});
    editing.what.push_back(target_name_in(entry));
  }
  return editing;
}

PreviewDensity preview_density_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "based_on", "edits"});
  return {reader.whole("based_on"), edits_in(reader, "edits")};
}

Edit edit_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "run", "epoch", "based_on", "edits"});
  return {reader.whole("based_on"), edits_in(reader, "edits"), seen_in(reader)};
}

Preview preview_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "seconds", "based_on", "edits", "without"});
  Preview preview;
  if (reader.has("seconds")) preview.seconds = reader.number("seconds");
  if (!(preview.seconds >= 1.0 && preview.seconds <= runtime::kLongestPreviewS))
    reader.refuse("seconds", fmt::format("must be in [1, {}]", runtime::kLongestPreviewS));
  if (reader.has("edits")) {
    preview.based_on = reader.whole("based_on");
    preview.edits = edits_in(reader, "edits");
  } else if (reader.has("based_on")) {
    reader.refuse("based_on", "is the revision that edits are made to: give edits, or leave it out");
  }
  if (reader.has("without")) preview.without = reader.texts("without", kMostDrones, kMostIdBytes);
  return preview;
}

Why why_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "drone"});
  return {reader.text("drone", kMostIdBytes)};
}

LoadMission mission_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "yaml"});
  return {reader.text("yaml", runtime::kMostMissionBytes)};
}

SetSpeed speed_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "factor"});
  return {reader.number("factor")};
}

Seek seek_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "time_s"});
  return {reader.number("time_s")};
}

StepTicks step_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "ticks"});
  const double ticks = reader.number("ticks");
  if (ticks != std::trunc(ticks) || ticks == 0.0 || !(std::abs(ticks) <= kMostSteps))
    reader.refuse("ticks", fmt::format("must be a whole number in [-{0}, {0}], not 0", kMostSteps));
  return {static_cast<std::int64_t>(ticks)};
}

template <typename Body>
Body step_back_in(const JsonReader& reader) {
  reader.allow_only({"type", "id", "run", "epoch", "based_on"});
  return {reader.whole("based_on"), seen_in(reader)};
}

template <typename Body>
Body nothing_in(const JsonReader& reader) {
  reader.allow_only({"type", "id"});
  return {};
}

std::optional<MessageBody> body_in(const JsonReader& reader, std::string_view type) {
  for (const WishWord& wish : kWishes)
    if (wish.word == type) return wish_in(reader, type, wish.kind);
  if (type == "hello") return hello_in(reader);
  if (type == "confirm") return confirm_in(reader);
  if (type == "ping") return nothing_in<Ping>(reader);
  if (type == "preview_density") return preview_density_in(reader);
  if (type == "preview") return preview_in(reader);
  if (type == "why") return why_in(reader);
  if (type == "editing") return editing_in(reader);
  if (type == "edit") return edit_in(reader);
  if (type == "undo") return step_back_in<Undo>(reader);
  if (type == "redo") return step_back_in<Redo>(reader);
  if (type == "start_afresh") return nothing_in<StartAfresh>(reader);
  if (type == "set_speed") return speed_in(reader);
  if (type == "pause") return nothing_in<Pause>(reader);
  if (type == "resume_clock") return nothing_in<ResumeClock>(reader);
  if (type == "seek") return seek_in(reader);
  if (type == "step") return step_in(reader);
  if (type == "load_mission") return mission_in(reader);
  if (type == "land_all") {
    reader.allow_only({"type", "id"});
    return DroneWish{CommandKind::kLand, true, {}, {}, {}};
  }
  return std::nullopt;
}

bool has_no_id(const MessageBody& body) {
  return std::holds_alternative<Hello>(body) || std::holds_alternative<Confirm>(body);
}

/// The id, where the message has one that can be read, for the refusal of all else.
std::optional<std::uint64_t> id_in(const nlohmann::json& message) {
  try {
    return JsonReader(message, "").whole("id");
  } catch (const JsonFault&) {
    return std::nullopt;
  }
}

std::variant<ClientMessage, MessageRefusal> message_in(const nlohmann::json& message) {
  const std::optional<std::uint64_t> id = id_in(message);
  try {
    const JsonReader reader(message, "");
    std::string type = reader.text("type", kMostIdBytes);
    std::optional<MessageBody> body = body_in(reader, type);
    if (!body)
      return MessageRefusal{id, "unknown_type",
                            fmt::format("type: \"{}\" is not known to {}", runtime::on_one_line(type, 60), "vigil.v1")};
    if (has_no_id(*body)) return ClientMessage{{}, std::move(type), *std::move(body)};
    return ClientMessage{reader.whole("id"), std::move(type), *std::move(body)};
  } catch (const JsonFault& fault) {
    return MessageRefusal{id, "malformed", runtime::on_one_line(fault.what(), kMostReasonBytes)};
  }
}

}  // namespace

std::variant<ClientMessage, MessageRefusal> parse_client_message(std::string_view text) {
  if (text.size() > kMostMessageBytes)
    return MessageRefusal{{}, "too_large", fmt::format("a message has at most {} bytes", kMostMessageBytes)};
  const ParsedJson message = parse_json(text);
  if (const std::string problem = message.problem(); !problem.empty())
    return MessageRefusal{message.twice == "id" ? std::nullopt : id_in(message.value), "malformed", problem};
  return message_in(message.value);
}

std::variant<ClientMessage, MessageRefusal> parse_preview(std::string_view text) {
  ParsedJson parsed = parse_json(text);
  if (!parsed.twice.empty()) return MessageRefusal{{}, "malformed", parsed.problem()};
  nlohmann::json& message = parsed.value;
  if (!message.is_object()) return MessageRefusal{{}, "malformed", "it is not a JSON object in UTF-8"};
  if (message.contains("type") || message.contains("id"))
    return MessageRefusal{{}, "malformed", "type, id: are no members here; see protocol/openapi.json"};
  message["type"] = "preview";
  message["id"] = 0U;
  return message_in(message);
}

Role role_for(const MessageBody& body) {
  if (const auto* wish = std::get_if<DroneWish>(&body))
    return wish->kind == CommandKind::kEmergencyStop ? Role::kSafetyPilot : Role::kOperator;
  const bool only_looks = has_no_id(body) || std::holds_alternative<Ping>(body) ||
                          std::holds_alternative<PreviewDensity>(body) || std::holds_alternative<Preview>(body) ||
                          std::holds_alternative<Why>(body);
  return only_looks ? Role::kViewer : Role::kOperator;
}

}  // namespace vigil::console

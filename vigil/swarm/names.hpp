#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "vigil/swarm/snapshot.hpp"

/// The enumerators' words, snake_case, in recordings, logs and on the wire.
namespace vigil::swarm {

inline constexpr std::array<std::string_view, 8> kModeWords{"unknown", "grounded", "taking_off", "flying",
                                                            "landing", "falling",  "manual",     "failed"};
inline constexpr std::array<std::string_view, 20> kActivityWords{
    "active",        "never_seen",        "grounded",      "taking_off", "landing",     "emergency_stop", "overridden",
    "marked_failed", "vehicle_failed",    "tracking_lost", "link_lost",  "battery_low", "held",           "recovering",
    "travelling",    "about_to_take_off", "not_following", "outside",    "returning",   "charging"};
inline constexpr std::array<std::string_view, 8> kFaultWords{"none",        "frozen",        "jumped",  "swapped",
                                                             "disagreeing", "not_following", "outside", "own_mode"};
inline constexpr std::array<std::string_view, 5> kActionWords{"none", "take_off", "land", "velocity", "stop_motors"};
inline constexpr std::array<std::string_view, 11> kCommandWords{
    "take_off",       "land",     "hold",      "go_to",      "resume",      "mark_failed",
    "emergency_stop", "override", "give_back", "set_target", "start_afresh"};
inline constexpr std::array<std::string_view, 11> kIntentWords{
    "stay_down",   "take_off",       "cover",    "land",        "hold",    "go_to",
    "mark_failed", "emergency_stop", "override", "called_back", "recharge"};
inline constexpr std::array<std::string_view, 3> kIdleWords{"none", "no_targets", "no_active_drone"};

/// The words of an enumeration, in its own order.
template <typename Enum>
inline constexpr std::span<const std::string_view> kWords{};
template <>
inline constexpr std::span<const std::string_view> kWords<VehicleMode> = kModeWords;
template <>
inline constexpr std::span<const std::string_view> kWords<Activity> = kActivityWords;
template <>
inline constexpr std::span<const std::string_view> kWords<Fault> = kFaultWords;
template <>
inline constexpr std::span<const std::string_view> kWords<Action> = kActionWords;
template <>
inline constexpr std::span<const std::string_view> kWords<CommandKind> = kCommandWords;
template <>
inline constexpr std::span<const std::string_view> kWords<Intent> = kIntentWords;
template <>
inline constexpr std::span<const std::string_view> kWords<Idle> = kIdleWords;

/// The word of a value. Precondition: one of the enumeration's.
template <typename Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  return kWords<Enum>[static_cast<std::size_t>(value)];
}

/// The value of a word; empty for a word that is none.
template <typename Enum>
[[nodiscard]] constexpr std::optional<Enum> value_of(std::string_view word) {
  for (std::size_t i = 0; i < kWords<Enum>.size(); ++i)
    if (kWords<Enum>[i] == word) return static_cast<Enum>(i);
  return std::nullopt;
}

static_assert(name_of(VehicleMode::kFailed) == kModeWords.back());
static_assert(name_of(Activity::kCharging) == kActivityWords.back());
static_assert(name_of(Fault::kOwnMode) == kFaultWords.back());
static_assert(name_of(Action::kStopMotors) == kActionWords.back());
static_assert(name_of(CommandKind::kStartAfresh) == kCommandWords.back());
static_assert(name_of(Intent::kRecharge) == kIntentWords.back());
static_assert(name_of(Idle::kNoActiveDrone) == kIdleWords.back());

}  // namespace vigil::swarm

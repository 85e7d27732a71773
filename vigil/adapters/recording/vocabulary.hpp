#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/snapshot.hpp"

/// The words and headers of a recording's files: what the writer writes and the reader accepts. docs/recording.md
/// explains each column.
namespace vigil::recording {

inline constexpr std::string_view kTickHeader =
    "t_s,metric,metric_percent,active,idle,fallback,min_separation_airborne_m,min_separation_active_m,"
    "min_wall_distance_m,min_no_fly_distance_m";
inline constexpr std::string_view kDroneHeader =
    "t_s,drone,mode,activity,x_m,y_m,height_m,vx_m_s,vy_m_s,age_s,nominal_x_m_s,nominal_y_m_s,action,command_x_m_s,"
    "command_y_m_s,held_by,held_distance_m,fallback,true_x_m,true_y_m,true_height_m";
inline constexpr std::string_view kTargetHeader = "t_s,kind,name,weight,x_m,y_m";
inline constexpr std::string_view kEventHeader = "t_s,source,what,drone,detail";

inline constexpr std::string_view kMissionFile = "mission.yaml";
inline constexpr std::string_view kTickFile = "ticks.csv";
inline constexpr std::string_view kDroneFile = "drones.csv";
inline constexpr std::string_view kTargetFile = "targets.csv";
inline constexpr std::string_view kEventFile = "events.csv";

/// The last line of events.csv, by which a reader knows that nothing is missing.
inline constexpr std::string_view kRecorderSource = "recorder";
inline constexpr std::string_view kFinished = "finished";

inline constexpr std::string_view kDronePrefix = "drone:";
inline constexpr std::string_view kWallPrefix = "wall:";
inline constexpr std::string_view kNoFlyPrefix = "no_fly:";
inline constexpr std::array<std::string_view, 4> kWallWords{"left", "right", "bottom", "top"};

/// The words of an enumeration, in its own order.
template <class Enum>
inline constexpr std::span<const std::string_view> kWords{};

inline constexpr std::array<std::string_view, 8> kModeWords{"unknown", "grounded", "taking_off", "flying",
                                                            "landing", "falling",  "manual",     "failed"};
inline constexpr std::array<std::string_view, 14> kActivityWords{
    "active",        "never_seen",     "grounded",      "taking_off", "landing",     "emergency_stop", "overridden",
    "marked_failed", "vehicle_failed", "tracking_lost", "link_lost",  "battery_low", "held",           "recovering"};
inline constexpr std::array<std::string_view, 5> kActionWords{"none", "take_off", "land", "velocity", "stop_motors"};
inline constexpr std::array<std::string_view, 3> kIdleWords{"none", "no_targets", "no_active_drone"};

template <>
inline constexpr std::span<const std::string_view> kWords<swarm::VehicleMode> = kModeWords;
template <>
inline constexpr std::span<const std::string_view> kWords<swarm::Activity> = kActivityWords;
template <>
inline constexpr std::span<const std::string_view> kWords<swarm::Action> = kActionWords;
template <>
inline constexpr std::span<const std::string_view> kWords<swarm::Idle> = kIdleWords;

/// The word of a value. Precondition: one of the enumeration's.
template <class Enum>
[[nodiscard]] constexpr std::string_view word(Enum value) {
  return kWords<Enum>[static_cast<std::size_t>(value)];
}

/// The value of a word; empty for a word that is none.
template <class Enum>
[[nodiscard]] constexpr std::optional<Enum> value_of(std::string_view text) {
  for (std::size_t i = 0; i < kWords<Enum>.size(); ++i) {
    if (kWords<Enum>[i] == text) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

static_assert(word(swarm::VehicleMode::kFailed) == kModeWords.back());
static_assert(word(swarm::Activity::kRecovering) == kActivityWords.back());
static_assert(word(swarm::Action::kStopMotors) == kActionWords.back());
static_assert(word(swarm::Idle::kNoActiveDrone) == kIdleWords.back());

}  // namespace vigil::recording

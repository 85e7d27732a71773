#pragma once

#include <array>
#include <string_view>

/// The words and headers of a recording's files: what the writer writes and the reader accepts. docs/recording.md
/// explains each column.
namespace vigil::recording {

inline constexpr std::string_view kTickHeader =
    "t_s,metric,metric_percent,active,idle,fallback,min_separation_airborne_m,min_separation_active_m,"
    "min_wall_distance_m,min_no_fly_distance_m";
inline constexpr std::string_view kDroneHeader =
    "t_s,drone,mode,activity,x_m,y_m,height_m,vx_m_s,vy_m_s,age_s,nominal_x_m_s,nominal_y_m_s,action,command_x_m_s,"
    "command_y_m_s,held_by,held_distance_m,fallback,true_x_m,true_y_m,true_height_m";
inline constexpr std::string_view kTargetHeader = "t_s,kind,name,weight,revisit_s,soft_edge_m,protect,x_m,y_m";
inline constexpr std::string_view kEventHeader = "t_s,source,what,drone,detail";

inline constexpr std::string_view kFolder = "recording";
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

}  // namespace vigil::recording

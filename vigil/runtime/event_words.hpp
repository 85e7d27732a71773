#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

enum class Severity : std::uint8_t { kInfo, kWarning, kAlarm };

/// "info", "warning", "alarm"
[[nodiscard]] std::string_view name_of(Severity severity);

/// An event for people: what happened, what it does to the swarm, what to do next. The last two may be empty.
struct EventWords {
  Severity severity = Severity::kInfo;
  std::string text{};
  std::string effect{};
  std::string next{};
};

/// A drone's activity became another one. `active` of `drones` cover now.
[[nodiscard]] EventWords words_for(std::string_view id, swarm::Activity after, const swarm::DroneSnapshot& drone,
                                   std::size_t active, std::size_t drones);

/// A station stopped or began again to charge, as drones there notice.
[[nodiscard]] EventWords words_for_station(std::string_view name, bool works);

/// Something was found to be wrong with a drone while its activity stayed what it was.
[[nodiscard]] EventWords words_for_fault(std::string_view id, const swarm::DroneSnapshot& drone, std::size_t active,
                                         std::size_t drones);

/// What drones do once a program that died is started again with its state.
[[nodiscard]] std::string_view after_restart(bool has_real_drones);

/// Why a drone in this state could not do what somebody wished: "cf2 is in the air; only a drone on the ground takes
/// off".
[[nodiscard]] std::string refusal_words(std::string_view id, swarm::CommandKind wish,
                                        const swarm::DroneSnapshot& drone);

}  // namespace vigil::runtime

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace vigil::console {

/// What a person at a console may do; each may do what those before it may.
enum class Role : std::uint8_t {
  kViewer,      ///< look
  kOperator,    ///< change targets, command drones, turn the clock
  kSafetyPilot  ///< stop motors
};

inline constexpr std::array<std::string_view, 3> kRoleWords{"viewer", "operator", "safety_pilot"};

[[nodiscard]] constexpr std::string_view name_of(Role role) { return kRoleWords[static_cast<std::size_t>(role)]; }

[[nodiscard]] constexpr std::optional<Role> role_of(std::string_view word) {
  for (std::size_t i = 0; i < kRoleWords.size(); ++i)
    if (kRoleWords[i] == word) return static_cast<Role>(i);
  return std::nullopt;
}

}  // namespace vigil::console

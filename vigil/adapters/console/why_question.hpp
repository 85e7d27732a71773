#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace vigil::console {

/// Somebody wants to know why a drone flies as it does.
struct WhyQuestion {
  std::uint64_t ticket = 0;
  std::uint64_t asker = 0;  ///< a newer question of the same asker supersedes it
  std::size_t drone = 0;    ///< of the mission's drones
};

inline constexpr std::string_view kNewerQuestion = "a newer question was asked";
inline constexpr const char* kTooManyQuestions = "too many questions wait; try again";

}  // namespace vigil::console

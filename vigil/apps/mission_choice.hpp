#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// Values of a mission that have an option of their own, as written.
struct Shorthands {
  std::optional<std::string> seconds;  ///< --seconds: simulation.duration_s
  std::optional<std::string> seed;     ///< --seed: simulation.seed
};

/// The mission of a file with settings of the form key=value and shorthands applied. Throws runtime::MissionError, or
/// Failure for a value that both a setting and a shorthand give.
[[nodiscard]] runtime::Mission choose_mission(const std::filesystem::path& path,
                                              const std::vector<std::string>& settings,
                                              const Shorthands& shorthands = {});

}  // namespace vigil::apps

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// The mission of a file with settings of the form key=value applied. Throws runtime::MissionError, or Failure for a
/// setting that has no `=`.
[[nodiscard]] runtime::Mission choose_mission(const std::filesystem::path& path,
                                              const std::vector<std::string>& settings);

}  // namespace vigil::apps

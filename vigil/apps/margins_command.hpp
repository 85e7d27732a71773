#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vigil::apps {

struct MarginsOptions {
  std::filesystem::path mission;
  std::vector<std::string> settings;  ///< key=value
  bool json = false;
};

/// `vigil margins`: prints what lag, gains and margins a mission's vehicles need, what of, and how to write them into
/// its file. Returns the exit code, or throws what is wrong with the mission.
[[nodiscard]] int margins(const MarginsOptions& options);

}  // namespace vigil::apps

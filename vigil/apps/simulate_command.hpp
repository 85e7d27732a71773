#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vigil/apps/mission_choice.hpp"
#include "vigil/apps/recording_options.hpp"

namespace vigil::apps {

struct SimulateOptions {
  std::filesystem::path mission;
  std::filesystem::path out;
  Shorthands shorthands;              ///< instead of what the mission says
  std::vector<std::string> settings;  ///< key=value
  RecordingOptions recording;
  std::size_t threads = 0;  ///< 0: as many as the swarm is worth
  bool json = false;        ///< the summary to standard output
};

/// `vigil simulate`: flies the mission as fast as it can and leaves `recording/` and `summary.json` in options.out.
/// Returns the exit code; throws what main() turns into one line and an exit code.
[[nodiscard]] int simulate(const SimulateOptions& options);

}  // namespace vigil::apps

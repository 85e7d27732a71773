#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vigil::apps {

struct LaboratoryOptions {
  std::filesystem::path mission;
  std::string only;                   ///< "crazyswarm", "vicon"; empty: both
  std::filesystem::path out;          ///< where the judgement goes; empty: nowhere
  std::vector<std::string> settings;  ///< key=value
};

/// `vigil laboratory`: the mission's drones simulated behind the topics of Crazyswarm and vicon_bridge, on the ground
/// at first, in real time, until Ctrl-C; judged by what they really did. Throws Failure, runtime::MissionError.
[[nodiscard]] int laboratory(const LaboratoryOptions& options);

}  // namespace vigil::apps

#pragma once

#include <cstddef>
#include <vector>

#include "vigil/adapters/recording/bag_file.hpp"

/// The topics of the program's own messages: the first ones of every bag.
namespace vigil::recording {

inline constexpr std::size_t kMissionTopic = 1;
inline constexpr std::size_t kTickTopic = 2;
inline constexpr std::size_t kCommandsTopic = 3;
inline constexpr std::size_t kTargetsTopic = 4;
inline constexpr std::size_t kEventTopic = 5;

[[nodiscard]] inline std::vector<Topic> own_topics() {
  return {{"/vigil/mission", "vigil_msgs/msg/Mission"},
          {"/vigil/tick", "vigil_msgs/msg/Tick"},
          {"/vigil/commands", "vigil_msgs/msg/Commands"},
          {"/vigil/targets", "vigil_msgs/msg/Targets"},
          {"/vigil/event", "vigil_msgs/msg/Event"}};
}

}  // namespace vigil::recording

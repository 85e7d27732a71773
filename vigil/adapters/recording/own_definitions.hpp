#pragma once

#include <span>
#include <string_view>

namespace vigil::recording {

/// What a message type is made of.
struct Definition {
  std::string_view type;  ///< as definitions name each other, without "msg/": "vigil_msgs/Tick"
  std::string_view text;
};

/// The program's own ones, as the build takes them from protocol/vigil_msgs/msg.
[[nodiscard]] std::span<const Definition> own_definitions();

}  // namespace vigil::recording

#pragma once

#include <string>
#include <string_view>

namespace vigil::recording {

/// The definition of a message type such as "vigil_msgs/msg/Tick", with those of all types that it is made of, as bags
/// keep them (encoding ros2msg). Precondition: a type that the recorder writes.
[[nodiscard]] std::string whole_definition(std::string_view type);

}  // namespace vigil::recording

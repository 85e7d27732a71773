#pragma once

#include <string>

namespace vigil::ros_bridge {

/// From now on the service is registered anew with every new master. Any thread.
void note_service(const std::string& name);

/// Tells a master that does not know this node of all its topics and services, and this node of whom the master knows.
/// Connections that are there stay. False where the master did not take all of it.
[[nodiscard]] bool register_everything();

}  // namespace vigil::ros_bridge

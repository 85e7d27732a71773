#pragma once

#include <cstdint>

#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/runtime/recorder.hpp"

namespace vigil::console {

/// An event of a recording, as a live console would have told it as far as the recording says. number: its place in the
/// recording, from 1; dt_s: the length of a
/// tick.
[[nodiscard]] ConsoleEvent recorded_event(const runtime::LoggedEvent& event, std::uint64_t number, double dt_s);

}  // namespace vigil::console

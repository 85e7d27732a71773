#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// What a mission means, in several lines for people: field, targets with their share of attention, swarm, control,
/// safety with every derived value, events, and what is worth a second look.
/// Precondition of all: a mission that load_mission or parse_mission returned.
[[nodiscard]] std::string explain(const Mission& mission);

/// The same facts for programs: `mission`, `field`, `attention`, `drones`, `control`, `safety`, `events`, `notes`.
[[nodiscard]] nlohmann::ordered_json explanation_json(const Mission& mission);

/// What is allowed but may not be meant, one sentence each.
[[nodiscard]] std::vector<std::string> notes_on(const Mission& mission);

}  // namespace vigil::runtime

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_source.hpp"

namespace vigil::runtime {

/// The mission that `text` (YAML) says, with the overrides applied: read, checked, its drone_grid resolved to drones.
/// `name` stands for the file in messages. Events later than a simulation.duration_s that an override set are dropped.
/// Throws MissionError, and nothing else but std::bad_alloc.
[[nodiscard]] Mission parse_mission(std::string_view text, const std::string& name,
                                    std::span<const Override> overrides = {});

/// The same for a file.
[[nodiscard]] Mission load_mission(const std::filesystem::path& path, std::span<const Override> overrides = {});

}  // namespace vigil::runtime

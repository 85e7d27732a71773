#pragma once

#include <filesystem>
#include <string>

#include "vigil/apps/console_options.hpp"

namespace vigil::apps {

/// `vigil replay DIR`: serves the console on a recording, until Ctrl-C. Throws Failure, RecordingError, MissionError.
[[nodiscard]] int replay_in_console(const std::filesystem::path& directory, const ConsoleOptions& options,
                                    const std::string& version);

}  // namespace vigil::apps

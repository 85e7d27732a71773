#pragma once

#include <string>

namespace vigil::runtime {

/// docs/mission-file.md: every section and key of a mission file, with unit, range, default and meaning.
[[nodiscard]] std::string mission_reference_markdown();

}  // namespace vigil::runtime

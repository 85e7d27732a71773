#pragma once

#include <map>
#include <string>

namespace vigil::console {

/// The conformance vectors of protocol/: file name and contents, as this program's own code makes them.
[[nodiscard]] std::map<std::string, std::string> protocol_vectors();

}  // namespace vigil::console

#pragma once

#include <filesystem>
#include <string_view>

namespace vigil::apps {

/// Writes the file whole or not at all: under another name first, renamed when it is complete. Throws Failure
/// (kComponentFailed).
void write_whole(const std::filesystem::path& path, std::string_view text);

}  // namespace vigil::apps

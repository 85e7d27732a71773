#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace vigil::apps {

/// Writes the file whole or not at all: under another name first, renamed when it is complete. Throws Failure
/// (kComponentFailed).
void write_whole(const std::filesystem::path& path, std::string_view text);

/// The file's bytes. Throws Failure (kComponentFailed) where it cannot be read or has more than most_bytes.
[[nodiscard]] std::string read_whole(const std::filesystem::path& path, std::uintmax_t most_bytes);

}  // namespace vigil::apps

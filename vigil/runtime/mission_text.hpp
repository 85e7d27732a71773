#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vigil::runtime {

/// The most bytes that a mission file may have.
inline constexpr std::size_t kMostMissionBytes = std::size_t{1} << 20U;

/// The bytes of a regular file of at most kMostMissionBytes. Size and kind are looked at before anything is read, so
/// that a huge file, a device, a pipe or a directory is refused at once. Throws MissionError.
[[nodiscard]] std::string read_mission_text(const std::filesystem::path& path);

/// Throws MissionError, with `name` for the place, unless `text` is UTF-8 of at most kMostMissionBytes without NUL and
/// without control characters other than tab and line ends, and no line is indented with a tab.
void require_plain_text(std::string_view text, const std::string& name);

/// `text` without a UTF-8 byte order mark at its start.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

}  // namespace vigil::runtime

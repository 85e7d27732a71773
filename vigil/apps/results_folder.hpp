#pragma once

#include <filesystem>
#include <string>

namespace vigil::apps {

/// A path for a line of text, however it is called.
[[nodiscard]] std::string in_words(const std::filesystem::path& path);

/// Refuses what is there already, so that nothing overwrites anything. `option`: a literal such as "--out". Throws
/// Failure (kBadInput).
void refuse_existing(const char* option, const std::filesystem::path& path);

/// Creates the directory of results, which must not be there. Throws Failure (kBadInput).
void create_results(const char* option, const std::filesystem::path& path);

}  // namespace vigil::apps

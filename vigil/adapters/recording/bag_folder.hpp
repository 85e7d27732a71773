#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vigil::recording {

/// Which of a bag's files are there.
struct BagFolder {
  std::vector<std::filesystem::path> files;  ///< in the order in which they were written; at least one
  std::vector<std::string> missing;          ///< names of those before, between and, by metadata.yaml, after them
};

/// Looks into DIRECTORY/recording/. RecordingError where there is no file of a recording at all. metadata.yaml is only
/// a hint: what it says beyond names is not looked at, and where it cannot be read it says nothing.
[[nodiscard]] BagFolder look_into(const std::filesystem::path& folder);

}  // namespace vigil::recording

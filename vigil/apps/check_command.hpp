#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vigil::apps {

struct CheckOptions {
  std::filesystem::path mission;
  std::vector<std::string> settings;  ///< key=value
  bool json = false;
};

/// `vigil check`: prints what the mission means, or throws what is wrong with it. Returns the exit code.
[[nodiscard]] int check(const CheckOptions& options);

/// `vigil schema`: prints the JSON Schema of mission files. Returns the exit code.
[[nodiscard]] int print_schema();

}  // namespace vigil::apps

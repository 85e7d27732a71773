#pragma once

#include <stdexcept>
#include <string>

#include "vigil/apps/exit_code.hpp"

namespace vigil::apps {

/// Ends the program with one line on stderr and an exit code.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace vigil::apps

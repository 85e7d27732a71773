#pragma once

#include <stdexcept>

namespace vigil::recording {

/// A recording that cannot be written or read: one line with the place, what is wrong there and what to do.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vigil::recording

#pragma once

namespace vigil::apps {

/// What the program's exit says to its caller.
enum ExitCode : int {
  kDone = 0,
  kCheckFailed = 1,
  kBadInput = 2,         ///< arguments or mission file
  kComponentFailed = 3,  ///< something that is needed is missing or failed: gnuplot, a disk
  kInterrupted = 130     ///< Ctrl-C or SIGTERM: a valid partial result was written
};

}  // namespace vigil::apps

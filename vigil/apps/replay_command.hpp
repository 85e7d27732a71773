#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vigil/apps/console_options.hpp"

namespace vigil::apps {

/// What `vigil replay` is asked to do.
struct ReplayOptions {
  std::filesystem::path directory;  ///< that simulate or serve --record wrote
  bool verify = false;
  std::optional<double> from_s;       ///< fly on from there
  std::vector<std::string> settings;  ///< key=value, from there on
  std::string why;                    ///< a drone whose velocity is explained; empty: none
  std::optional<double> at_s;         ///< when; the end where absent
  std::filesystem::path out;          ///< for the flight that would have been; empty: it is not recorded
  bool json = false;
  ConsoleOptions console;         ///< without verify, from_s and why
  bool asks_for_console = false;  ///< any of its options was given
};

/// `vigil replay --verify`: recomputes every tick of a recording and compares what it decided, bit for bit. kDone where
/// all of it is the same, kCheckFailed at the first difference, or where the recording cannot be recomputed to its end.
/// `--from`: flies on from a moment by other rules, and says what happened and what would have.
/// `--why DRONE --at T`: what coverage wanted of it then, every row of the safety filter, and what came of it.
/// With none of them: serves the console on the recording, until Ctrl-C. Throws Failure, RecordingError, MissionError.
[[nodiscard]] int replay(const ReplayOptions& options, const std::string& version);

}  // namespace vigil::apps

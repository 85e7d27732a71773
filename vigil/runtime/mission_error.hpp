#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vigil::runtime {

/// What is wrong with a mission, in parts. Texts are as found or written; MissionError makes them fit on one line.
struct MissionFault {
  std::string place;    ///< "missions/x.yaml:31:17" (line and column from 1), or "--set safety.separation_m"
  std::string key;      ///< "drones[1].start_m", list entries from 0; empty where the fault is not about a key
  std::string value;    ///< as written; empty where nothing was written
  std::string problem;  ///< "is not a number"; empty where `valid` says it all
  std::string valid;    ///< "must be in (0, 3] m"
  std::string advice;   ///< what to do about it
};

/// A mission that is refused. what() is one line without control characters:
/// `missions/x.yaml:31:17: safety.separation_m = -0.2: must be in (0, 3] m; give the least distance ...`.
class MissionError : public std::runtime_error {
 public:
  explicit MissionError(MissionFault fault);

  [[nodiscard]] const MissionFault& fault() const noexcept { return *fault_; }

 private:
  std::shared_ptr<const MissionFault> fault_;  // shared: copying an exception must not throw
};

/// `text` for a line of a message: control characters escaped, cut to about `most_bytes` between two characters.
[[nodiscard]] std::string on_one_line(std::string_view text, std::size_t most_bytes);

}  // namespace vigil::runtime

#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::runtime {

/// A small mission that uses every section and is right.
[[nodiscard]] std::string right_mission();

/// right_mission() with `found` (which must be there) replaced.
[[nodiscard]] std::string right_mission_but(std::string_view found, std::string_view replacement);

enum class Fault : std::uint8_t {
  kText,       ///< no YAML document that another program could judge
  kStructure,  ///< against the schema
  kMeaning     ///< the schema cannot say it: values do not fit together
};

struct MalformedMission {
  std::string name;
  std::string text;
  Fault fault;
  std::string key;      ///< that the refusal must name
  std::string message;  ///< that the refusal must contain
};

/// For GoogleTest's messages.
inline std::ostream& operator<<(std::ostream& out, const MalformedMission& mission) { return out << mission.name; }

[[nodiscard]] std::vector<MalformedMission> malformed_missions();

}  // namespace vigil::runtime

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

enum class VariationKind : std::uint8_t {
  kSeed,     ///< `seed`: of everything random in a run; on, whether asked for or not
  kStarts,   ///< `starts`: legal places, apart from each other, the walls and no-fly polygons
  kTargets,  ///< `targets`: as many clusters and points as the mission has, elsewhere
  kFaults,   ///< `faults`, `faults=3` or `faults=3:fail,land`: so many incidents a run, of these kinds
  kRange,    ///< `key=a..b`: uniform
  kChoice    ///< `key=a|b|c`: each as likely
};

/// What differs from run to run of a campaign.
struct Variation {
  std::string text;  ///< as written
  VariationKind kind = VariationKind::kSeed;
  std::string key;                   ///< kRange, kChoice: the path of a mission's key
  double low = 0.0;                  ///< kRange
  double high = 0.0;                 ///< kRange, >= low
  bool is_whole = false;             ///< kRange: the key takes whole numbers
  std::vector<std::string> choices;  ///< kChoice, at least two; YAML
  std::size_t incidents = 0;         ///< kFaults
  std::vector<EventKind> kinds;      ///< kFaults, at least one: land, fail, override, lose_tracking, hold, mark_failed
  friend bool operator==(const Variation&, const Variation&) = default;
};

/// Throws MissionError where the text is none of the forms above. Whether a key exists and its values are allowed is
/// found out by the mission's own checks, when a run is drawn.
[[nodiscard]] Variation parse_variation(std::string_view text);

}  // namespace vigil::runtime

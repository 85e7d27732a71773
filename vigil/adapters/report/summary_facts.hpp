#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vigil/adapters/report/findings.hpp"
#include "vigil/adapters/report/flight_data.hpp"

namespace vigil::report {

/// What the report says in its tiles and tables: from summary.json where there is one (every tick, ground truth), and
/// from the recording for what it lacks.
struct SummaryFacts {
  /// A figure in large type and what it is.
  struct Tile {
    std::string value;
    std::string what;
  };
  std::vector<Tile> tiles;
  std::vector<std::vector<std::string>> safety;    ///< rows of a table: what, value, asked for, verdict
  std::vector<std::vector<std::string>> coverage;  ///< rows: what, value
  std::vector<std::vector<std::string>> faults;    ///< rows: what, value; none where nothing befell or was noticed
  std::vector<std::vector<std::string>> timing;    ///< rows: what, value
  std::vector<Finding> deadlines;                  ///< one for each cluster or area that has revisit_s
  std::vector<std::string> warnings;               ///< a flight cut short, a summary that cannot be read, ...
};

/// summary_json: the text of summary.json; none where there is no such file.
[[nodiscard]] SummaryFacts summary_facts(const FlightData& data, const std::optional<std::string>& summary_json);

}  // namespace vigil::report

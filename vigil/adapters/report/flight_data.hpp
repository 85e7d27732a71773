#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::report {

/// A tick at which other drones were active than at the kept tick before.
struct ActiveChange {
  std::size_t tick = 0;
  std::vector<std::size_t> lost;      ///< active before, not active from here on
  std::vector<std::size_t> returned;  ///< the other way round
};

/// A recorded flight as figures and findings need it: field frame, ground truth where there is any.
/// The flight and the mission outlive it.
struct FlightData {
  const runtime::RecordedFlight& flight;
  const runtime::Mission& mission;  ///< with the targets of the flight's end
  field::Field field;
  bool has_truth = false;
  std::vector<Vec2> positions;  ///< by RecordedFlight::row(); NaN where unknown
  std::vector<Vec2> commands;   ///< by RecordedFlight::row()
  std::vector<double> steps_s;  ///< for how long each kept tick stands
  std::vector<ActiveChange> changes;
  std::vector<std::size_t> drawn;  ///< the drones that maps show, ascending: all of them, or kMostDrawn, evenly chosen

  [[nodiscard]] std::size_t ticks() const { return flight.tick_count(); }
  [[nodiscard]] std::size_t drones() const { return flight.drones.size(); }
  [[nodiscard]] bool draws_all() const { return drawn.size() == drones(); }
  [[nodiscard]] double time_s(std::size_t tick) const { return flight.ticks.time_s[tick]; }
  /// When the last kept tick's time is over.
  [[nodiscard]] double end_s() const { return flight.ticks.time_s.back() + steps_s.back(); }
  /// The last kept tick that is not after time_s.
  [[nodiscard]] std::size_t tick_at(double time_s) const;
  /// The first change by which a drone was lost; none where none was.
  [[nodiscard]] const ActiveChange* first_loss() const;
  /// "cf2 landing", "5 drones lost", "cf2 back".
  [[nodiscard]] std::string describe(const ActiveChange& change) const;
};

/// More than this, and a map shows colour in place of drones, and takes minutes to draw.
inline constexpr std::size_t kMostDrawn = 400;

/// ReportError where the flight has no tick or its drones are not the mission's.
[[nodiscard]] FlightData prepare(const runtime::RecordedFlight& flight, const runtime::Mission& mission);

}  // namespace vigil::report

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/adapters/console/shown_drones.hpp"
#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/core/field/seen_map.hpp"
#include "vigil/runtime/flight_history.hpp"
#include "vigil/runtime/live_frame.hpp"

/// The binary frames of protocol/README.md, as bytes. Field frame.
namespace vigil::console {

/// What a snapshot frame says beside the swarm's own snapshot.
struct SnapshotContext {
  std::uint32_t epoch = 0;
  double wall_ms = 0.0;          ///< when the tick was computed, since 1970
  double age_s = 0.0;            ///< how long ago that was
  double worst_age_s = 0.0;      ///< NaN: no area
  double speed_limit_m_s = 0.0;  ///< u_max: velocities are sent to 1/8000 of it, up to four times of it
  double steady_ms = 0.0;        ///< when what it shows was true, by the program's steady clock
  std::uint32_t lost_ticks = 0;
};

/// Arrays are of the shown drones, figures of all.
[[nodiscard]] std::string snapshot_frame(const runtime::LiveFrame& frame, const runtime::ClockState& clock,
                                         const SnapshotContext& context, const ShownDrones& shown);

struct DensityContext {
  std::uint32_t epoch = 0;
  std::uint32_t revision = 0;
  bool is_preview = false;
  std::uint64_t request = 0;
};

/// No density: nothing to look at.
[[nodiscard]] std::string density_frame(const field::Field& field, const std::optional<field::DensityGrid>& density,
                                        const DensityContext& context);

[[nodiscard]] std::string coverage_frame(const field::Field& field, const runtime::LiveFrame& frame,
                                         std::uint32_t epoch);

[[nodiscard]] std::string age_frame(const field::SeenMap& seen, double now_s, std::uint32_t epoch);

/// Where each drone has been: points of all drones at the same moments, spacing_s apart.
struct Trails {
  std::size_t drones = 0;
  std::size_t points = 0;  ///< of each drone
  double spacing_s = 0.0;
  double newest_s = 0.0;
  std::vector<float> xy;  ///< drone by drone, oldest first; NaN: not known
};

/// Some of the bytes of a message that goes in several. Precondition: they are there.
struct Part {
  std::uint8_t stream = 0;  ///< messages of one stream come one after the other
  std::size_t offset = 0;
  std::size_t size = 0;
};

[[nodiscard]] std::string part_frame(std::string_view whole, const Part& part);

[[nodiscard]] std::string trails_frame(const Trails& trails, std::uint32_t epoch);

[[nodiscard]] std::string history_frame(const runtime::FlightHistory& history, std::uint32_t epoch);

}  // namespace vigil::console

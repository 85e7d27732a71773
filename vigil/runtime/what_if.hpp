#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/preview.hpp"

namespace vigil::runtime {

/// What somebody wants to know of the time to come. A value.
struct WhatIf {
  double seconds = 60.0;                ///< in (0, kLongestPreviewS]
  std::optional<Mission> targets;       ///< the mission with other targets; none: the present ones
  std::vector<swarm::DroneId> without;  ///< drones that would land now
  [[nodiscard]] bool changes_anything() const { return targets.has_value() || !without.empty(); }
};

/// The futures side by side.
struct Outlooks {
  std::uint64_t tick = 0;  ///< how many ticks had been run
  double time_s = 0.0;     ///< of the mission, then
  Outlook as_is;
  std::optional<Outlook> what_if;  ///< none where nothing was to change
};

/// The mission's targets for a model, as coverage_target() makes them for a flight but on a coarser grid, which is the
/// same within a hundredth and takes milliseconds. Null phi_k and has_targets false where there is nothing to look at.
[[nodiscard]] std::shared_ptr<const swarm::CoverageTarget> previewed_target(const Mission& mission,
                                                                            const ergodic::Basis& basis);

/// Both futures from the same moment. None where `cancelled` became true. Precondition: as of look_into_future().
[[nodiscard]] std::optional<Outlooks> look_ahead(const PreviewStart& start, const WhatIf& question,
                                                 const std::atomic<bool>& cancelled);

}  // namespace vigil::runtime

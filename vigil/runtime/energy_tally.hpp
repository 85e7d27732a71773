#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

#include "vigil/runtime/flight_audit.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// What became of the energy of a flight with stations, or with batteries at all.
class EnergyTally {
 public:
  void add(const swarm::Snapshot& snapshot);

  /// charges: how often a drone left a pad charged; away: drones at a time that are on their way to a pad, there, or
  /// about to leave it; stations_failed: as drones noticed; ran_empty and least_charge by ground truth.
  [[nodiscard]] nlohmann::ordered_json to_json(const AuditTotals& audit) const;

 private:
  std::uint64_t ticks_ = 0;
  std::uint64_t charges_ = 0;
  std::uint64_t stations_failed_ = 0;
  std::uint64_t away_ticks_ = 0;
  std::uint64_t most_away_ = 0;
};

}  // namespace vigil::runtime

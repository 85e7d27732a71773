#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vigil/adapters/recording/bag_writer.hpp"
#include "vigil/adapters/recording/cdr_writer.hpp"
#include "vigil/adapters/recording/standard_messages.hpp"
#include "vigil/runtime/mission_targets.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::recording {

/// What other tools show of a flight: positions, trails, targets, how the drones are. Much less often than there are
/// ticks, and the less often the more drones there are: the flight itself stands in the program's own messages.
class StandardTopics {
 public:
  /// Drones that have topics of their own; those after them show in markers and diagnostics only.
  static constexpr std::size_t kMostNamed = 200;
  /// Poses in a second, at most, of all drones.
  static constexpr double kMostPosesPerS = 200.0;

  /// `before`: how many topics the bag has before these. Precondition: a mission that mission checks accepted.
  StandardTopics(const runtime::Mission& mission, std::size_t before);

  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }
  /// What is due at this tick.
  void write_tick(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);
  /// The importance map, and the targets as markers.
  void write_targets(const runtime::MissionTargets& targets, std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);

 private:
  /// Something that is due every so often. The first time at the first tick.
  struct Beat {
    double period_s = 1.0;
    double next_s = -1e300;
    [[nodiscard]] bool is_due(double time_s);
  };

  [[nodiscard]] Place place_of(const swarm::DroneSnapshot& drone) const;
  void write_places(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);
  void write_paths(std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);
  void write_trails(std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);
  void write_health(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag);
  void extend_trails(const swarm::Snapshot& snapshot);
  [[nodiscard]] std::size_t topic_of(std::size_t drone, std::size_t which) const;

  runtime::Mission mission_;
  field::WorldFrame frame_;
  double size_m_;  ///< of what is drawn
  std::size_t before_;
  std::size_t named_;
  std::vector<Topic> topics_;
  std::vector<std::vector<Place>> trails_;  ///< of each drone, the oldest place first
  Beat places_;
  Beat trail_points_;
  Beat trails_shown_;
  Beat paths_;
  Beat health_;
};

}  // namespace vigil::recording

#pragma once

#include <string>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/runtime/recorder.hpp"

namespace vigil::geography {

/// Where a drone was known to be at one moment.
struct TrackPoint {
  double time_s = 0.0;          ///< since the first tick that was kept
  Vec2 place_m = Vec2::Zero();  ///< world frame
  double height_m = 0.0;        ///< above the ground from which it started
};

/// Where one drone was, in pieces: between them nobody knew. At least two points a piece.
struct Track {
  std::string drone;
  std::vector<std::vector<TrackPoint>> pieces;
};

/// Takes from a flight what is drawn on maps: tracks, thinned out, and the targets at its end. One thread at a time.
class TrackRecorder final : public runtime::Recorder {
 public:
  /// A point of each track at least every `step_s` where ticks come as often. Precondition: step_s > 0.
  explicit TrackRecorder(double step_s) : step_s_(step_s) {}

  void begin(const runtime::Mission& mission, const runtime::FlightStart& start) override;
  void record(const runtime::TickRecord& tick) noexcept override;
  void log(const runtime::LoggedEvent& event) noexcept override;
  void targets(double time_s, const runtime::MissionTargets& targets) noexcept override;
  void finish() override;

  /// Of all drones, in the mission's order; after finish().
  [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }
  [[nodiscard]] const runtime::MissionTargets& last_targets() const { return last_targets_; }

 private:
  void add(const swarm::Snapshot& snapshot);

  double step_s_;
  double freshness_s_ = 0.0;  ///< an older position is no place where a drone is
  field::WorldFrame frame_;
  bool has_begun_ = false;
  double began_s_ = 0.0;
  double next_s_ = 0.0;
  std::vector<Track> tracks_;
  std::vector<bool> is_known_;  ///< at the step before
  runtime::MissionTargets last_targets_;
  bool is_short_of_memory_ = false;
};

}  // namespace vigil::geography

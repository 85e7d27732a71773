#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "vigil/runtime/checkpoints.hpp"
#include "vigil/runtime/flight_history.hpp"
#include "vigil/runtime/ground_picture.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/replayed_flight.hpp"

namespace vigil::runtime {

/// All that a display shows of a recording at one of its ticks: what the controller knew and decided, the targets that
/// held, what had been seen of the ground by then. One thread at a time; throws what the recording throws.
class ReplayScene {
 public:
  /// Opens the recording once more: to look elsewhere in it without leaving the tick that is shown.
  using Open = std::function<std::unique_ptr<FlightRecording>()>;

  /// Shows the first tick. `mission`: that the recording began with. Throws std::runtime_error where there is no tick,
  /// or another number of drones.
  ReplayScene(Mission mission, const Open& open);

  [[nodiscard]] const ReplayedFlight& flight() const noexcept { return flight_; }
  [[nodiscard]] const FlightRecording& recording() const noexcept { return flight_.recording(); }
  [[nodiscard]] const GroundPicture& ground() const noexcept { return ground_; }
  /// As it was at first.
  [[nodiscard]] const Mission& first_mission() const noexcept { return first_; }
  /// With the targets of the tick that is shown, and their revision, from 1 on.
  [[nodiscard]] const Mission& mission() const noexcept { return mission_; }
  [[nodiscard]] std::uint64_t revision() const noexcept { return targets_ + 1; }
  [[nodiscard]] double time_s() const noexcept { return flight_.snapshot().time_s; }
  [[nodiscard]] double begin_s() const noexcept { return begin_s_; }  ///< time of the first tick
  [[nodiscard]] double end_s() const noexcept { return end_s_; }      ///< time of the last one
  /// Between two kept ticks.
  [[nodiscard]] double spacing_s() const noexcept;

  /// Goes on by one tick; false, and nothing changed, at the end.
  bool step();
  /// Goes to the place from which step() comes to the tick `number`, counted from 1, soonest. What is shown makes sense
  /// again after the next step().
  void approach(std::uint64_t number);

  /// The number, from 1 on, of the last tick at time_s or before; 1 where there is none.
  [[nodiscard]] std::uint64_t number_at(double time_s);
  /// Shows what was known at ticks since time_s up to the one that is shown, at most `most`, the last of them that one.
  void recall(double since_s, std::uint64_t most, const std::function<void(const swarm::Snapshot&)>& show);
  /// What plots show, up to the latest tick that was ever shown: later than the present one after going back.
  [[nodiscard]] const FlightHistory& history() const noexcept { return history_; }
  /// Writes all of `out` but what is the clock's.
  void write(LiveFrame& out) const;

 private:
  struct Checkpoint {
    GroundPicture ground;
    std::size_t targets = 0;
  };

  void retarget();
  void look();
  void keep_checkpoint();
  void note_history();
  [[nodiscard]] double worst_age_s() const;
  [[nodiscard]] double time_of(std::uint64_t number);

  Mission first_;
  Mission mission_;
  ReplayedFlight flight_;
  std::unique_ptr<FlightRecording> elsewhere_;
  RecordedTick tick_elsewhere_;
  GroundPicture ground_;
  FlightHistory history_;
  std::uint64_t noted_ = 0;  ///< the last tick that history_ knows of
  std::size_t targets_ = 0;  ///< how many of the recording's lists of targets are past
  std::uint64_t look_every_ = 1;
  double begin_s_ = 0.0;
  double end_s_ = 0.0;
  Checkpoints<Checkpoint> checkpoints_;
};

}  // namespace vigil::runtime

#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vigil/adapters/console/client_message.hpp"
#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/adapters/console/trail_ring.hpp"
#include "vigil/adapters/console/why_question.hpp"
#include "vigil/runtime/deadline_foresight.hpp"
#include "vigil/runtime/flight_history.hpp"
#include "vigil/runtime/ground_picture.hpp"
#include "vigil/runtime/live_mission.hpp"
#include "vigil/runtime/mission_desk.hpp"
#include "vigil/runtime/preview_thread.hpp"
#include "vigil/runtime/saved_flight.hpp"
#include "vigil/runtime/shown_flight.hpp"

namespace vigil::console {

/// Bytes that are sent to many.
using SharedBytes = std::shared_ptr<const std::string>;

/// Another mission is flown from now on.
struct FlightNews {
  std::shared_ptr<runtime::LiveMission> flight;
  SharedBytes mission;  ///< the message
  bool is_restored = false;
  bool is_kept = false;  ///< a restart goes on with it: no order is done before Desk::keep has kept it
};
/// A recording is shown from now on.
struct RecordingNews {
  std::shared_ptr<runtime::ShownFlight> recording;
  SharedBytes mission;  ///< the message
};
/// What led to the tick of a recording that is shown.
struct HistoryNews {
  ReplayState state;
  std::vector<ConsoleEvent> events;             ///< those that came to what was told, or all
  bool is_afresh = false;                       ///< all of it: what was told before is of elsewhere
  std::optional<TrailRing> trails;              ///< there where is_afresh
  std::optional<runtime::FlightHistory> plots;  ///< up to that tick; none while it is on its way to another
};
/// Other targets hold from now on.
struct TargetsNews {
  SharedBytes targets;  ///< the message
  SharedBytes density;  ///< the frame
  std::uint64_t revision = 0;
  std::string by;
  std::string what;
  runtime::Mission mission;  ///< with these targets
};
/// What has been seen of the ground.
struct GroundNews {
  std::vector<runtime::AreaState> areas;
  std::vector<runtime::DeadlineChange> deadlines;
  std::optional<runtime::EventWords> foresight;  ///< who will miss a deadline, where that is news
  SharedBytes coverage;
  SharedBytes age;
  std::uint64_t tick = 0;
  double time_s = 0.0;
};
/// A change or another mission was refused.
struct DeskRefusal {
  std::uint64_t ticket = 0;
  std::string_view code;
  std::string reason;
};
/// A change was accepted, and is saved where a state is kept and can be written; the control loop answers its ticket
/// when it takes effect.
struct DeskAcceptance {
  std::uint64_t ticket = 0;
};
/// A preview, or a mission that was loaded: done, there is nothing to wait for.
struct DeskAnswer {
  std::uint64_t ticket = 0;
  std::uint64_t revision = 0;
  SharedBytes preview;  ///< the frame; null but for previews
};
/// A look ahead is done, or a question answered.
struct PreviewNews {
  std::uint64_t ticket = 0;
  Json answer;  ///< without its id
};
/// These orders to drones are saved, or cannot be.
struct OrdersKept {
  std::vector<std::uint64_t> tickets;
};
/// Something went wrong that people should know of.
struct DeskTrouble {
  std::string text;
};
using DeskNews = std::variant<FlightNews, RecordingNews, HistoryNews, TargetsNews, GroundNews, DeskRefusal,
                              DeskAcceptance, DeskAnswer, PreviewNews, OrdersKept, DeskTrouble>;

/// An order to drones, as a flight was given it.
struct GivenOrder {
  std::uint64_t ticket = 0;
  std::vector<swarm::Command> commands;
};

/// Everything of a live flight that takes its time and must not hold up the control thread or the sockets: editing
/// targets, drawing densities, keeping the picture of the ground, saving the state. All on one thread, the desk's.
class Desk {
 public:
  /// Makes what flies a mission. `saved`: what an earlier run left, or null.
  using MakeFlight = std::function<std::shared_ptr<runtime::LiveMission>(runtime::Mission mission, std::uint32_t epoch,
                                                                         const runtime::SavedFlight* saved)>;
  using Tell = std::function<void(DeskNews)>;

  /// `tell` is called on the desk's thread, and on those of its own for looks ahead and for questions. store: null
  /// where nothing is kept.
  Desk(MakeFlight make_flight, Tell tell, std::shared_ptr<runtime::FlightStore> store);

  /// Flies a mission: tells FlightNews and TargetsNews. Throws what making a flight throws.
  void begin(const runtime::Mission& mission, const runtime::SavedFlight* saved);

  /// Whether the flight of this epoch is still the one that is flown; where it is not, the ticket is refused.
  [[nodiscard]] bool still_flies(std::uint32_t epoch, std::uint64_t ticket);
  void edit(std::uint64_t ticket, const std::vector<runtime::TargetEdit>& edits, std::uint64_t based_on,
            const std::string& by);
  void undo(std::uint64_t ticket, std::uint64_t based_on, const std::string& by);
  void redo(std::uint64_t ticket, std::uint64_t based_on, const std::string& by);
  /// newest: the ticket of the newest preview that the same client asked for; all others are superseded.
  void preview(std::uint64_t ticket, const std::atomic<std::uint64_t>& newest, std::uint64_t request,
               const std::vector<runtime::TargetEdit>& edits, std::uint64_t based_on);
  /// Lets a thread of its own look ahead; a newer request of the same asker supersedes it. without: drones' indices.
  void look_ahead(std::uint64_t ticket, std::uint64_t asker, const Preview& request,
                  const std::vector<std::size_t>& without);
  /// Lets another thread of its own say why a drone flies as it does.
  void explain(const WhyQuestion& question);
  void load_mission(std::uint64_t ticket, const std::string& yaml);
  /// An event of the mission file wants other targets.
  void play(std::uint32_t epoch, std::size_t event_index);
  /// Saves orders that the flight of this epoch was given, whether it has taken them yet or not, then tells OrdersKept.
  /// Their tickets grow from call to call.
  void keep(std::uint32_t epoch, std::vector<GivenOrder> orders);
  /// To be called five times a second: takes in the newest frame, tells GroundNews, and saves once a second, or as
  /// often as it is called where a second of the mission is shorter.
  void look();
  /// Writes the state, where one is kept.
  void save();
  /// Takes a last look, saves, and ends the flight; what its recorder throws.
  void end();

 private:
  void finish_change(std::uint64_t ticket, const std::optional<runtime::Refusal>& refusal);
  void retarget(std::uint64_t ticket);
  void finish_flight();
  void read_frame();
  void note_drones();
  [[nodiscard]] std::vector<runtime::SavedFlight::Drone> ordered_drones() const;
  void submit_target();
  void refuse(std::uint64_t ticket, std::string_view code, std::string reason);
  void look_for_deadlines();
  void take_foreseen(GroundNews& news);

  /// What a thread of the desk's own has seen ahead, for the desk to fetch.
  struct Foreseen {
    std::mutex mutex;
    std::optional<std::vector<runtime::AreaOutlook>> areas;
    std::uint64_t revision = 0;  ///< of the targets
    std::uint32_t epoch = 0;
    std::size_t active = 0;
  };

  MakeFlight make_flight_;
  Tell tell_;
  std::shared_ptr<runtime::FlightStore> store_;
  std::uint32_t epoch_ = 0;
  std::shared_ptr<runtime::LiveMission> flight_;
  std::string mission_text_;
  std::optional<runtime::MissionDesk> desk_;
  std::optional<runtime::GroundPicture> ground_;
  runtime::DeadlineForesight foresight_;
  std::shared_ptr<Foreseen> foreseen_ = std::make_shared<Foreseen>();
  std::optional<runtime::LiveFrame> frame_;
  std::size_t frame_version_ = 0;
  bool has_new_frame_ = false;                       ///< nobody has looked at it
  std::vector<runtime::SavedFlight::Drone> drones_;  ///< where they were last known to be, and under which orders
  std::deque<GivenOrder> untaken_;                   ///< orders that frame_ does not know yet
  std::optional<runtime::LiveCommand> unsent_;       ///< a target that found the control loop's queue full
  /// The control thread must not be the last to let go of one.
  std::deque<std::shared_ptr<const swarm::CoverageTarget>> recent_targets_;
  int looks_since_save_ = 0;
  double saved_at_s_ = 0.0;  ///< mission time
  bool save_failed_ = false;
  // Last: they end before what they tell is gone.
  runtime::PreviewThread previews_;
  runtime::PreviewThread outlooks_;   ///< apart: nobody waits for what nobody asked for
  runtime::PreviewThread questions_;  ///< apart: an answer takes a moment, a look ahead may take a second
};

}  // namespace vigil::console

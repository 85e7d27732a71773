#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "vigil/adapters/console/access.hpp"
#include "vigil/adapters/console/client_message.hpp"
#include "vigil/adapters/console/desk.hpp"
#include "vigil/adapters/console/rate_limit.hpp"
#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/adapters/console/shown_drones.hpp"
#include "vigil/adapters/console/trail_ring.hpp"

namespace vigil::console {

/// A connection, as the hub sees it. Neither call waits; both may be made after the connection broke.
class ClientLine {
 public:
  /// Kinds of bytes of which only the newest counts.
  enum class Latest : std::uint8_t {
    kSnapshot,
    kDensity,
    kPreview,
    kCoverage,
    kAge,
    kTrails,
    kHistory,
    kStatus,
    kCount
  };

  virtual ~ClientLine() = default;
  /// Never dropped, in order.
  virtual void say(SharedBytes text) = 0;
  /// Replaces what of this kind still waits.
  virtual void show(Latest kind, SharedBytes bytes) = 0;
  /// After what was said.
  virtual void close() = 0;
  /// From now on the client confirms what it has read, and no more is sent than it keeps up with. Before anything is
  /// said.
  virtual void pace() = 0;
  /// The client has read so many messages. False where that cannot be.
  [[nodiscard]] virtual bool confirm(std::uint64_t received) = 0;
};

/// What the hub needs of the rest of the program.
struct HubLinks {
  std::function<std::chrono::nanoseconds()> now;  ///< monotonic
  std::function<double()> wall_ms;                ///< since 1970
  /// Lets the desk's thread do it; false where its queue is full.
  std::function<bool(std::function<void(Desk&)>)> at_desk;
  /// Lets a recording's thread answer; false where too many wait. Empty where no recording is shown.
  std::function<bool(const WhyQuestion&)> at_recording = {};
};

struct HubSetup {
  std::string program;           ///< "vigil 0.1.0"
  std::optional<Tokens> tokens;  ///< none: whoever comes may be a safety pilot
  std::string recording_folder;  ///< empty: nothing is recorded
  std::string run;               ///< tells this run of the program from every other
};

/// Everybody who looks at or commands the flight, and what they are told: the console's side of the program without its
/// sockets. One thread, the sockets'; nothing in it waits.
class Hub {
 public:
  using ClientId = std::uint32_t;
  using Reply = std::function<void(const Json&)>;

  Hub(HubSetup setup, HubLinks links);

  ClientId connect(std::shared_ptr<ClientLine> line);
  void disconnect(ClientId client);
  /// A text message of a client, whatever is in it.
  void receive(ClientId client, std::string_view text);
  /// A message that cannot be one: too large, or binary.
  void refuse_message(ClientId client, std::string_view code, std::string_view reason);
  /// A command that came otherwise; `reply` is called once, now or later.
  void command(const ClientMessage& message, Role role, const std::string& by, Reply reply);

  /// From the desk.
  void take(DeskNews news);
  /// To be called every few milliseconds: passes on what happened, answers, and frames that are due.
  void poll();
  /// Says goodbye to everybody.
  void end();

  [[nodiscard]] std::optional<Role> role_for(std::string_view token) const;
  [[nodiscard]] bool wants_login() const { return setup_.tokens.has_value(); }
  [[nodiscard]] const std::string& program() const { return setup_.program; }
  /// Whether the client has said who it is, and what it said was good enough.
  [[nodiscard]] bool knows(ClientId client) const;
  [[nodiscard]] std::size_t clients() const { return clients_.size(); }

  /// Whether there is a tick of the flight to show.
  [[nodiscard]] bool has_ticked() const { return flight_ && frame_->has_ticked; }

  // For REST: the newest of everything; null before there is any.
  [[nodiscard]] Json state() const;
  [[nodiscard]] const runtime::Mission* mission() const { return mission_ ? &*mission_ : nullptr; }
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

 private:
  struct Client {
    Operator who;
    std::shared_ptr<ClientLine> line;
    std::chrono::nanoseconds connected_at{0};
    bool has_said_hello = false;
    RateLimit rate;
    std::size_t refused_for_rate = 0;
    /// The ticket of its newest preview; the desk looks at it, too.
    std::shared_ptr<std::atomic<std::uint64_t>> newest_preview = std::make_shared<std::atomic<std::uint64_t>>(0);
    std::string page = {};  ///< see Hello
  };
  /// A command that waits for its answer.
  struct Waiting {
    std::uint64_t id = 0;
    std::string what;  ///< the message's type
    std::string by;
    Reply reply;
    Answer answer;
    std::vector<std::pair<std::string, std::string>> refused;
    bool wants_revision = false;
    bool is_at_control = false;                         ///< the control loop has it, and will answer
    std::optional<std::chrono::nanoseconds> answer_by;  ///< then it is answered as pending
    bool is_kept = true;                                ///< false: it waits to be saved, and its answer for that
    std::optional<runtime::LiveEvent> outcome;          ///< what its answer will be once it is saved
    ClientId preview_for = 0;
    std::string drones;  ///< in words, for the log
  };
  struct Author {
    ClientId client = 0;
    Role role = Role::kViewer;
    std::string name;
  };

  /// Whether it is a confirmation that can be.
  static bool confirms(const Client& client, const std::variant<ClientMessage, MessageRefusal>& parsed);
  void hear(Client& client, std::variant<ClientMessage, MessageRefusal> parsed);
  void greet(Client& client, const Hello& hello);
  void replace(const std::string& page);
  void show_everything(Client& client);
  void part_with(ClientId id, std::string_view code, std::string_view reason);
  void execute(const ClientMessage& message, const Author& author, Reply reply);
  std::uint64_t expect(const ClientMessage& message, const Author& author, Reply reply);
  void dispatch(const ClientMessage& message, const Author& author, std::uint64_t ticket);
  void wish(const DroneWish& wish, std::uint64_t ticket);
  [[nodiscard]] bool is_of_this_flight(const SeenFlight& seen) const;
  [[nodiscard]] std::optional<std::vector<std::size_t>> drones_of(const DroneWish& wish, std::uint64_t ticket);
  [[nodiscard]] std::optional<std::size_t> drone_named(const std::string& id, std::uint64_t ticket);
  void submit(std::vector<runtime::LiveCommand> commands, std::uint64_t ticket);
  /// Lets the desk save the orders that wait for that, all at once and one lot at a time.
  void keep_orders();
  void ask_desk(std::uint64_t ticket, std::function<void(Desk&)> task);
  void refuse(std::uint64_t ticket, std::string_view code, std::string reason);
  [[nodiscard]] bool is_marked_failed(std::size_t drone) const;
  void change_targets(const SeenFlight& seen, std::uint64_t ticket, std::function<void(Desk&)> change);
  void preview(const PreviewDensity& body, const Author& author, std::uint64_t request, std::uint64_t ticket);
  void look_ahead(const Preview& body, const Author& author, std::uint64_t ticket);
  void explain(const Why& body, const Author& author, std::uint64_t ticket);
  void wait_for_control(Waiting& waiting) const;
  void set_editing(ClientId client, const Editing& editing);
  void tell_presence();

  void take(const FlightNews& news);
  void take(const RecordingNews& news);
  void take(const HistoryNews& news);
  void show_flight(std::shared_ptr<runtime::ShownFlight> flight, SharedBytes mission);
  void set_speed(double factor, std::uint64_t ticket);
  void give_up_waiting();
  void take(const TargetsNews& news);
  void take(const GroundNews& news);
  void take(const DeskAnswer& news);
  void take(const OrdersKept& news);
  void take(const PreviewNews& news);
  void hear_all(const std::vector<runtime::LiveEvent>& events);
  void hear(const runtime::LiveEvent& event);
  void hear_swarm(const runtime::LiveEvent& event);
  void hear_script(const runtime::LiveEvent& event);
  void hear_answer(const runtime::LiveEvent& event);
  void answer_pending(std::chrono::nanoseconds now);
  void log(ConsoleEvent event);
  void keep_event(Json event);
  void tell_of_untold();
  void send_events();
  void send_snapshot(std::chrono::nanoseconds now);
  void send_status();
  /// Tells once what keeps the flight from being recorded, or recorded whole.
  void watch_recorder();
  void drop_the_silent(std::chrono::nanoseconds now);
  void say_to_all(const Json& json);
  void show_to_all(ClientLine::Latest kind, const SharedBytes& bytes);
  [[nodiscard]] std::string drone_id(std::size_t index) const;
  [[nodiscard]] Json status() const;
  /// Adds the orders that wait for the next tick to what `status` tells.
  void list_waiting(StatusContext& context) const;
  /// The program's steady clock, as the protocol tells it.
  [[nodiscard]] double steady_ms() const;

  HubSetup setup_;
  HubLinks links_;
  std::map<ClientId, Client> clients_;
  ClientId next_client_ = 1;
  std::unordered_map<std::uint64_t, Waiting> waiting_;
  std::uint64_t next_ticket_ = 1;
  bool is_kept_ = false;            ///< a restart goes on with the flight and its orders
  std::vector<GivenOrder> unkept_;  ///< orders that nobody has asked the desk to save yet
  bool is_keeping_ = false;         ///< the desk was asked to save some, and has not said that it did

  std::shared_ptr<runtime::ShownFlight> flight_;
  std::optional<ReplayState> replay_;  ///< where flight_ is a recording
  std::unordered_map<std::string, std::size_t> drone_index_;
  SharedBytes mission_message_;
  SharedBytes targets_message_;
  std::optional<runtime::Mission> mission_;
  std::uint64_t revision_ = 0;
  SharedBytes density_;
  SharedBytes coverage_;
  SharedBytes age_;
  std::vector<runtime::AreaState> areas_;
  std::optional<ShownDrones> shown_;
  std::optional<TrailRing> trails_;
  std::optional<runtime::FlightHistory> history_;
  std::optional<runtime::LiveFrame> frame_;
  std::size_t frame_version_ = 0;
  runtime::ClockState clock_;
  std::size_t clock_version_ = 0;
  bool waits_for_resume_ = false;
  bool has_told_lost_ticks_ = false;
  bool has_told_trouble_ = false;
  std::deque<Json> events_;  ///< the newest
  std::vector<Json> new_events_;
  RateLimit swarm_events_;           ///< of those that clients are told
  std::uint64_t untold_events_ = 0;  ///< since they were last told how many there were
  std::uint64_t next_event_ = 1;
  std::chrono::nanoseconds next_snapshot_{0};
  std::chrono::nanoseconds next_status_{0};
};

}  // namespace vigil::console

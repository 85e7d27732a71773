#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "vigil/adapters/console/hub.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::console {

/// A client's connection that keeps what it is told.
class RecordedLine final : public ClientLine {
 public:
  void say(SharedBytes text) override { said.push_back(Json::parse(*text)); }
  void show(Latest kind, SharedBytes bytes) override {
    ++shows[kind];
    shown[kind] = std::move(bytes);
  }
  void close() override { is_closed = true; }
  void pace() override { is_paced = true; }
  /// As if everything that was said and shown had been sent.
  [[nodiscard]] bool confirm(std::uint64_t count) override {
    if (!is_paced || count <= confirmed) return false;
    confirmed = count;
    return true;
  }

  /// What was said of one type, oldest first.
  [[nodiscard]] std::vector<Json> of(std::string_view type) const {
    std::vector<Json> found;
    for (const Json& message : said)
      if (message.at("type") == type) found.push_back(message);
    return found;
  }
  /// The answer to the command with this id; null where there is none yet.
  [[nodiscard]] Json answer(std::uint64_t id) const {
    for (const Json& message : said)
      if (is_answer(message) && message.at("id") == id) return message;
    return nullptr;
  }
  /// The ids of all answers, in their order.
  [[nodiscard]] std::vector<std::uint64_t> answered() const {
    std::vector<std::uint64_t> ids;
    for (const Json& message : said)
      if (is_answer(message) && message.at("id").is_number()) ids.push_back(message.at("id"));
    return ids;
  }
  /// The newest event whose "what" this is, of any drone or of one; null where there is none.
  [[nodiscard]] Json event(std::string_view what, std::string_view drone = "") const {
    Json found;
    for (const Json& message : of("events"))
      for (const Json& one : message.at("events"))
        if (one.at("what") == what && (drone.empty() || one.at("drone") == drone)) found = one;
    return found;
  }

  std::vector<Json> said;
  std::map<Latest, SharedBytes> shown;
  std::map<Latest, int> shows;
  bool is_closed = false;
  bool is_paced = false;
  std::uint64_t confirmed = 0;

 private:
  static bool is_answer(const Json& message) {
    const Json& type = message.at("type");
    return type == "ack" || type == "refused" || type == "pong" || type == "preview" || type == "why";
  }
};

/// A flight of obedient drones whose control loop only the test turns; it begins at `now`.
[[nodiscard]] inline std::shared_ptr<runtime::LiveMission> flight_by_hand(const runtime::Mission& mission,
                                                                          std::uint32_t epoch,
                                                                          const runtime::SavedFlight* saved,
                                                                          std::chrono::nanoseconds now) {
  runtime::FlightStart start{runtime::first_intent(mission), {}};
  if (saved != nullptr) start = {swarm::Intent::kHold, saved->past, {}};
  if (saved != nullptr)
    for (const runtime::SavedFlight::Drone& drone : saved->drones) start.standing.push_back(drone.order);
  auto fleet = std::make_unique<runtime::ObedientFleet>(runtime::starts_in_field(mission));
  runtime::VirtualFleet* const world = fleet.get();
  auto flight = std::make_shared<runtime::LiveMission>(mission, std::move(fleet), world, nullptr, start, epoch,
                                                       [](const std::stop_token&, runtime::ControlLoop&) {});
  flight->loop().begin(now);
  return flight;
}

/// The frame of its newest tick. Precondition: there was one.
[[nodiscard]] inline runtime::LiveFrame newest_frame(const runtime::LiveMission& flight) {
  runtime::LiveFrame frame(flight.mission().drones.size());
  std::size_t version = 0;
  flight.loop().read(frame, version);
  return frame;
}

/// A console's server without sockets, threads and clocks: hub, desk and control loop, in a world of three obedient
/// drones whose time only the test turns.
class ConsoleForTests {
 public:
  using Time = std::chrono::nanoseconds;

  explicit ConsoleForTests(std::optional<Tokens> tokens = {}, std::shared_ptr<runtime::FlightStore> store = nullptr)
      : hub({"vigil test", std::move(tokens), "", "this run"},
            {[this] { return now; }, [this] { return std::chrono::duration<double, std::milli>(now).count(); },
             [this](std::function<void(Desk&)> task) { return post(std::move(task)); }}),
        desk([this](const runtime::Mission& mission, std::uint32_t epoch,
                    const runtime::SavedFlight* saved) { return make_flight(mission, epoch, saved); },
             [this](DeskNews news) { keep(std::move(news)); }, std::move(store)) {}

  /// Flies the small mission, with more lines of YAML at its end, up to its first tick.
  void fly(const std::string& more = "") {
    desk.begin(runtime::small_mission(more), nullptr);
    pass(std::chrono::milliseconds(20));
  }

  /// Lets time pass in steps of 5 ms, at each of which everybody does what is due.
  void pass(Time time) {
    constexpr Time kStep = std::chrono::milliseconds(5);
    constexpr Time kLookEvery = std::chrono::milliseconds(200);
    for (const Time until = now + time; now < until; now += kStep) {
      if (flight) flight->loop().turn(now);
      if (is_desk_at_work) work();
      if (is_desk_at_work && now % kLookEvery == Time(0)) desk.look();
      pass_on_news();
      hub.poll();
    }
  }

  /// Lets time pass until something is so that a thread of the desk's own, which looks ahead, decides.
  template <typename IsSo>
  void pass_until(IsSo is_so) {
    for (; !is_so(); std::this_thread::yield()) pass(std::chrono::milliseconds(5));
  }

  /// Lets the desk do what it was asked to, and the hub hear of it.
  void work() {
    while (!tasks.empty()) {
      const std::function<void(Desk&)> task = std::move(tasks.front());
      tasks.pop_front();
      task(desk);
      pass_on_news();
    }
  }

  /// A client that has said hello.
  struct Visitor {
    Hub::ClientId id = 0;
    std::shared_ptr<RecordedLine> line;
  };
  [[nodiscard]] Visitor connect() {
    auto line = std::make_shared<RecordedLine>();
    return {hub.connect(line), line};
  }
  [[nodiscard]] Visitor join(const Json& hello = Json::object()) {
    Visitor visitor = connect();
    Json message = hello;
    message["type"] = "hello";
    say(visitor, message);
    return visitor;
  }
  void say(const Visitor& visitor, const Json& message) { hub.receive(visitor.id, message.dump()); }
  /// Its answer, after so much time.
  Json ask(const Visitor& visitor, const Json& command, Time within = std::chrono::milliseconds(60)) {
    say(visitor, command);
    pass(within);
    return visitor.line->answer(command.at("id"));
  }

  [[nodiscard]] runtime::LiveFrame newest() const { return newest_frame(*flight); }

  Time now{std::chrono::seconds(1000)};
  std::deque<std::function<void(Desk&)>> tasks;
  std::size_t most_tasks = 256;
  std::size_t most_drones = 1000;  ///< a mission with more of them is not flown
  bool is_desk_at_work = true;
  std::shared_ptr<runtime::LiveMission> flight;

 private:
  std::mutex news_mutex_;
  std::deque<DeskNews> news_;

 public:
  Hub hub;
  Desk desk;

 private:
  /// Any thread.
  void keep(DeskNews news) {
    const std::lock_guard lock(news_mutex_);
    news_.push_back(std::move(news));
  }
  void pass_on_news() {
    std::deque<DeskNews> heard;
    {
      const std::lock_guard lock(news_mutex_);
      heard.swap(news_);
    }
    for (DeskNews& one : heard) hub.take(std::move(one));
  }

  bool post(std::function<void(Desk&)> task) {
    if (tasks.size() >= most_tasks) return false;
    tasks.push_back(std::move(task));
    return true;
  }

  std::shared_ptr<runtime::LiveMission> make_flight(const runtime::Mission& mission, std::uint32_t epoch,
                                                    const runtime::SavedFlight* saved) {
    if (mission.drones.size() > most_drones) throw std::runtime_error("more drones than the test flies");
    flight = flight_by_hand(mission, epoch, saved, now);
    return flight;
  }
};

}  // namespace vigil::console

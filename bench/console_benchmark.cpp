// What the operator's console asks of a busy machine: `vigil serve` flies a thousand drones at 50 Hz while twenty
// WebSocket clients look on, each of them commands drones five times a second, and two processes do nothing but keep
// two cores busy. How soon are commands answered, do they take effect at the next tick, and how late do ticks begin,
// with real-time priority for the control thread and without, with --state, where an order is answered when it is on
// the disk, and without? Beside it a bare thread of the same priority tells how late the machine lets anybody begin.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <sys/resource.h>
#include <unistd.h>
#include <unordered_map>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bare_thread.hpp"
#include "live_client.hpp"
#include "served_program.hpp"

namespace vigil::bench {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr std::size_t kClients = 20;
constexpr std::size_t kDrones = 1000;
constexpr std::size_t kBusyProcesses = 2;
constexpr auto kTick = 20ms;
constexpr double kTickMs = 20.0;
constexpr auto kCommandEvery = 200ms;  // of each client
constexpr std::uint8_t kHeld = 12;     // an activity of the protocol

constexpr const char* kMission = R"(format: 1
name: a thousand drones
field: {size_m: [40, 40]}
targets:
  clusters:
    - {name: south, points_m: [[10, 8], [14, 9], [12, 12]]}
    - {name: east, points_m: [[32, 20], [30, 25]], weight: 2, revisit_s: 30}
  areas:
    - {name: north, outline_m: [[5, 30], [18, 28], [15, 37]]}
drone_grid: {count: 1000}
control: {speed_limit_m_s: 0.5, rate_hz: 50}
safety: {separation_m: 0.2, wall_distance_m: 0.17}
)";

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

template <typename Value>
Value value_at(std::string_view bytes, std::size_t offset) {
  Value value{};
  if (offset + sizeof value > bytes.size()) throw std::runtime_error("a frame is too short");
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Frame kind 1 of protocol/README.md.
struct SnapshotSeen {
  std::uint64_t tick = 0;
  double wall_ms = 0.0;
  std::uint32_t active = 0;
  std::size_t bytes = 0;
  std::uint32_t rows = 0;
};
bool is_snapshot(std::string_view frame) { return frame.size() > 96 && frame[4] == 1; }
SnapshotSeen snapshot_in(std::string_view frame) {
  return {static_cast<std::uint64_t>(value_at<double>(frame, 16)), value_at<double>(frame, 32),
          value_at<std::uint32_t>(frame, 72), frame.size(), value_at<std::uint32_t>(frame, 88)};
}
/// The arrays before it take 29 bytes of each drone.
std::uint8_t activity_in(std::string_view frame, std::size_t drone) {
  constexpr std::size_t kBefore = 4 * (2 + 1 + 1) + 2 * (2 + 2 + 2) + 2 * (1 + 1) + 1 + 1;
  return value_at<std::uint8_t>(frame, value_at<std::uint16_t>(frame, 6) + kBefore * kDrones + drone);
}

/// When ticks are due, as the newest snapshots tell: none can have begun earlier.
class Schedule {
 public:
  void add(const SnapshotSeen& snapshot) {
    constexpr std::size_t kKept = 20;
    origins_ms_.push_back(snapshot.wall_ms - kTickMs * static_cast<double>(snapshot.tick));
    if (origins_ms_.size() > kKept) origins_ms_.pop_front();
  }
  /// The first tick that is due after a moment of the wall's clock.
  [[nodiscard]] std::int64_t next_tick(double at_ms) const {
    const double origin_ms = *std::ranges::min_element(origins_ms_);
    return static_cast<std::int64_t>(std::floor((at_ms - origin_ms) / kTickMs)) + 1;
  }

 private:
  std::deque<double> origins_ms_;
};

/// What there was to see while the machine was busy.
struct Seen {
  std::vector<double> acks_ms;
  std::vector<std::int64_t> ticks_late;  ///< after the next tick
  json lateness_us;                      ///< since the flight began
  std::size_t snapshots = 0;
  SnapshotSeen last;
};

/// Twenty people who hold drones and let them go on.
class Crowd {
 public:
  explicit Crowd(std::uint16_t port) {
    for (std::size_t i = 0; i < kClients; ++i) clients_.emplace_back(port, fmt::format("client {}", i));
    asked_.resize(kClients);
  }

  /// Reads what comes until `is_over`, and gives commands where `commands`.
  template <typename IsOver>
  void watch(IsOver is_over, bool commands) {
    while (!is_over()) {
      if (commands) give_due_commands();
      wait_for_news();
    }
  }

  void give_command(std::size_t client) {
    const std::size_t turn = turns_++ / kClients;
    const std::size_t drone = client * (kDrones / kClients) + (turn / 2) % (kDrones / kClients);
    const std::uint64_t id = next_id_++;
    asked_[client].emplace(id, Asked{Clock::now(), schedule_.next_tick(wall_ms())});
    clients_[client].say(fmt::format(R"({{"type":"{}","id":{},"drones":["{}"]}})", turn % 2 == 0 ? "hold" : "resume",
                                     id, drone_ids_.at(drone)));
  }

  [[nodiscard]] Seen& seen() { return seen_; }
  [[nodiscard]] std::uint8_t activity_of(std::size_t drone) const { return activity_in(newest_, drone); }
  /// Forgets what was seen but the newest snapshot, and lets commands be due from now on.
  void begin() {
    seen_ = Seen{{}, {}, seen_.lateness_us, 0, seen_.last};
    next_command_ = Clock::now();
  }

 private:
  struct Asked {
    Clock::time_point at;
    std::int64_t next_tick;
  };

  /// All clients by turns, evenly.
  void give_due_commands() {
    for (; Clock::now() >= next_command_; next_command_ += kCommandEvery / kClients) give_command(turns_ % kClients);
  }

  void wait_for_news() {
    std::array<pollfd, kClients> waiting{};
    for (std::size_t i = 0; i < kClients; ++i) waiting[i] = {clients_[i].descriptor(), POLLIN, 0};
    ::poll(waiting.data(), kClients, 1);
    for (std::size_t i = 0; i < kClients; ++i) {
      if (waiting[i].revents == 0) continue;
      clients_[i].read([&](std::string_view message, bool is_text) { take(i, message, is_text); });
    }
  }

  /// The first client reads frames; all read answers.
  void take(std::size_t client, std::string_view message, bool is_text) {
    if (!is_text && client == 0 && is_snapshot(message)) return take_snapshot(message);
    if (!is_text || message.starts_with(R"({"type":"events")")) return;
    const json said = json::parse(message);
    const std::string type = said.at("type");
    if (type == "ack") take_answer(client, said);
    if (type == "mission" && client == 0)
      for (const json& drone : said.at("mission").at("drones")) drone_ids_.push_back(drone.at("id"));
    if (type == "status" && client == 0) seen_.lateness_us = said.at("lateness_ever_us");
    if (type == "refused" || type == "bye") throw std::runtime_error("the program refuses: " + said.dump());
  }

  void take_snapshot(std::string_view frame) {
    newest_ = frame;
    seen_.last = snapshot_in(frame);
    ++seen_.snapshots;
    schedule_.add(seen_.last);
  }

  void take_answer(std::size_t client, const json& answer) {
    const auto asked = asked_[client].extract(answer.at("id").get<std::uint64_t>());
    if (asked.empty() || answer.contains("refused_drones")) throw std::runtime_error("a wrong answer");
    seen_.acks_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - asked.mapped().at).count());
    seen_.ticks_late.push_back(answer.at("tick").get<std::int64_t>() - asked.mapped().next_tick);
  }

  std::vector<LiveClient> clients_;
  std::vector<std::unordered_map<std::uint64_t, Asked>> asked_;
  std::vector<std::string> drone_ids_;
  std::string newest_;
  Schedule schedule_;
  Seen seen_;
  std::uint64_t next_id_ = 1;
  std::size_t turns_ = 0;
  Clock::time_point next_command_;
};

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

auto after(std::chrono::milliseconds time) {
  return [until = Clock::now() + time] { return Clock::now() >= until; };
}

/// All drones cover; one that is told to hold does so from the tick of the answer on; time goes as it should.
void verify(Crowd& crowd) {
  crowd.watch(after(1500ms), false);
  require(crowd.seen().last.active == kDrones, "not all drones cover");
  crowd.give_command(0);
  crowd.watch([&] { return crowd.seen().acks_ms.size() == 1; }, false);
  const std::uint64_t held_at = crowd.seen().last.tick;
  crowd.watch([&] { return crowd.seen().last.tick > held_at + 2; }, false);
  require(crowd.activity_of(0) == kHeld, "a drone that was told to hold does not");
  const std::int64_t late = crowd.seen().ticks_late.front();
  require(late >= 0 && late <= 2, "a command took effect before it was given, or long after");
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.at(static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1);
}

double share_within(const std::vector<std::int64_t>& ticks, std::int64_t most) {
  const auto within = std::ranges::count_if(ticks, [most](std::int64_t late) { return late <= most; });
  return static_cast<double>(within) / static_cast<double>(ticks.size());
}

void report(benchmark::State& state, const Seen& seen, const ServedProgram& program, double seconds) {
  state.counters["acks"] = static_cast<double>(seen.acks_ms.size());
  state.counters["ack_p50_ms"] = quantile(seen.acks_ms, 0.5);
  state.counters["ack_p99_ms"] = quantile(seen.acks_ms, 0.99);
  state.counters["at_next_tick"] = share_within(seen.ticks_late, 0);
  state.counters["a_tick_later"] = share_within(seen.ticks_late, 1) - share_within(seen.ticks_late, 0);
  for (const char* figure : {"p50", "p99", "p999", "max"})
    state.counters[fmt::format("late_{}_ms", figure)] = 1e-3 * seen.lateness_us.at(figure).get<double>();
  state.counters["snapshots_per_s"] = static_cast<double>(seen.snapshots) / seconds;
  state.counters["bytes_a_drone"] =
      static_cast<double>(seen.last.bytes - 16 * seen.last.rows) / static_cast<double>(kDrones);
  state.counters["memory_MiB"] = static_cast<double>(program.memory_kib()) / 1024.0;
  state.counters["nice"] = ::getpriority(PRIO_PROCESS, 0);
}

void report(benchmark::State& state, const runtime::LatenessFigures& bare) {
  state.counters["bare_p99_ms"] = 1e-3 * bare.p99_us;
  state.counters["bare_p999_ms"] = 1e-3 * bare.p999_us;
  state.counters["bare_max_ms"] = 1e-3 * bare.max_us;
}

/// The busy machine of the title, for so many seconds.
void serve(benchmark::State& state, const std::string& mission, const std::string& state_folder) {
  const bool has_priority = state.range(0) == 1;
  const std::chrono::seconds time(state.range(2));
  const ServedProgram program(VIGIL_PROGRAM, mission, has_priority, state.range(1) == 1 ? state_folder : "");
  Crowd crowd(program.port());
  verify(crowd);
  require(program.has_priority() == has_priority,
          "the system gives no real-time priority to anybody here; `ulimit -r 1` would allow it");
  std::vector<Child> busy;
  for (std::size_t i = 0; i < kBusyProcesses; ++i) busy.push_back(spin());
  crowd.begin();
  BareThread bare(kTick, has_priority);
  const std::uint64_t first = crowd.seen().last.tick;
  const auto began = Clock::now();
  crowd.watch(after(time), true);
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  const double ticks = static_cast<double>(crowd.seen().last.tick - first);
  require(ticks * kTickMs >= 0.98 * 1000.0 * seconds - 100.0, "the flight does not keep up with real time");
  report(state, crowd.seen(), program, seconds);
  report(state, bare.end());
}

void Serve(benchmark::State& state) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("vigil-console-benchmark-{}", ::getpid());
  std::filesystem::create_directory(folder);
  const std::filesystem::path mission = folder / "mission.yaml";
  std::ofstream(mission) << kMission;
  for (auto _ : state) {
    try {
      serve(state, mission, folder / "state");
    } catch (const std::runtime_error& error) {
      state.SkipWithError(error.what());
    }
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(Serve)
    ->ArgNames({"realtime", "state", "seconds"})
    ->ArgsProduct({{1, 0}, {0, 1}, {3, 60}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace vigil::bench

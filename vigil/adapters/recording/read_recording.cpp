#include "vigil/adapters/recording/read_recording.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/recording/csv_rows.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/vocabulary.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::recording {
namespace {

using runtime::RecordedFlight;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

template <class Enum>
Enum value_in(const CsvRows& rows, std::size_t column) {
  const auto value = swarm::value_of<Enum>(rows.text(column));
  if (!value) rows.refuse(column, fmt::format("one of {}", fmt::join(swarm::kWords<Enum>, ", ")));
  return *value;
}

Vec2 vector_at(const CsvRows& rows, std::size_t column) {
  return {rows.number_or(column, kNaN), rows.number_or(column + 1, kNaN)};
}

/// Reads a recording into a RecordedFlight, file by file.
class Reader {
 public:
  Reader(std::filesystem::path folder, const ReadLimits& limits) : folder_(std::move(folder)), limits_(limits) {}

  RecordedFlight read() {
    flight_.mission_text = read_text(folder_ / kMissionFile, limits_.file_bytes);
    read_ticks();
    read_drones();
    read_targets();
    read_events();
    return std::move(flight_);
  }

 private:
  CsvRows open(std::string_view name, std::string_view header) const {
    return CsvRows(folder_ / name, header, limits_.file_bytes);
  }

  void incomplete(std::string reason) {
    if (flight_.is_complete) flight_.incomplete_reason = std::move(reason);
    flight_.is_complete = false;
  }

  void note_cut(const CsvRows& rows, std::string_view name) {
    if (rows.was_cut()) incomplete(fmt::format("{} ends in the middle of a line", name));
  }

  void read_ticks() {
    CsvRows rows = open(kTickFile, kTickHeader);
    runtime::TickColumns& ticks = flight_.ticks;
    while (rows.next()) {
      const double time_s = rows.number(0);
      if (!ticks.time_s.empty() && time_s <= ticks.time_s.back()) rows.refuse(0, "a later time than the line before");
      ticks.time_s.push_back(time_s);
      ticks.metric.push_back(rows.number_or(1, kNaN));
      ticks.metric_percent.push_back(rows.number_or(2, kNaN));
      ticks.active.push_back(rows.count(3));
      ticks.idle.push_back(value_in<swarm::Idle>(rows, 4));
      ticks.fallback.push_back(rows.flag(5) ? 1 : 0);
      ticks.clearances.push_back({rows.number_or(6, kInfinite), rows.number_or(7, kInfinite),
                                  rows.number_or(8, kInfinite), rows.number_or(9, kInfinite)});
    }
    note_cut(rows, kTickFile);
  }

  void read_drones() {
    read_ids();
    CsvRows rows = open(kDroneFile, kDroneHeader);
    std::size_t read = 0;
    const std::size_t wanted = flight_.tick_count() * flight_.drones.size();
    while (read < wanted && rows.next()) {
      expect_row(rows, read++);
      add_row(rows);
    }
    note_cut(rows, kDroneFile);
    const bool has_more = read == wanted && rows.next();
    keep_ticks(flight_.drones.empty() ? 0 : read / flight_.drones.size(), has_more);
  }

  // The rows of the first tick name the drones.
  void read_ids() {
    CsvRows rows = open(kDroneFile, kDroneHeader);
    std::unordered_set<std::string> known;
    bool is_whole = false;
    double first_s = 0.0;
    while (rows.next()) {
      const double time_s = rows.number(0);
      if (flight_.drones.empty()) first_s = time_s;
      is_whole = time_s != first_s;
      if (is_whole) break;
      if (rows.text(1).empty() || !known.emplace(rows.text(1)).second) rows.refuse(1, "another drone's id");
      flight_.drones.emplace_back(rows.text(1));
    }
    if (!is_whole && rows.was_cut()) flight_.drones.clear();
    for (std::size_t i = 0; i < flight_.drones.size(); ++i) index_.emplace(flight_.drones[i], i);
  }

  void expect_row(const CsvRows& rows, std::size_t read) const {
    const double time_s = flight_.ticks.time_s[read / flight_.drones.size()];
    if (rows.number(0) != time_s) rows.refuse(0, fmt::format("{}, the time of this tick in {}", time_s, kTickFile));
    const std::string& id = flight_.drones[read % flight_.drones.size()];
    if (rows.text(1) != id) rows.refuse(1, fmt::format("'{}', the next drone", id));
  }

  void add_row(const CsvRows& rows) {
    runtime::DroneColumns& to = flight_.rows;
    to.mode.push_back(value_in<swarm::VehicleMode>(rows, 2));
    to.activity.push_back(value_in<swarm::Activity>(rows, 3));
    to.position_m.push_back(vector_at(rows, 4));
    to.height_m.push_back(rows.number_or(6, kNaN));
    to.velocity_m_s.push_back(vector_at(rows, 7));
    to.age_s.push_back(rows.number_or(9, kInfinite));
    to.nominal_m_s.push_back(vector_at(rows, 10));
    to.action.push_back(value_in<swarm::Action>(rows, 12));
    to.command_m_s.push_back(vector_at(rows, 13));
    to.held_by.push_back(holding_row(rows));
    to.fallback.push_back(rows.flag(17) ? 1 : 0);
    to.true_position_m.push_back(vector_at(rows, 18));
    to.true_height_m.push_back(rows.number_or(20, kNaN));
  }

  std::optional<safety::HoldingRow> holding_row(const CsvRows& rows) const {
    constexpr std::size_t kColumn = 15;
    const std::string_view text = rows.text(kColumn);
    if (text.empty()) return std::nullopt;
    const double distance_m = rows.number_or(kColumn + 1, kInfinite);
    const auto after = [&](std::string_view prefix) { return text.substr(prefix.size()); };
    if (text.starts_with(kDronePrefix)) {
      const auto found = index_.find(std::string(after(kDronePrefix)));
      if (found != index_.end()) return row_of(safety::RowKind::kNeighbour, found->second, distance_m);
    } else if (text.starts_with(kWallPrefix)) {
      const auto found = std::find(kWallWords.begin(), kWallWords.end(), after(kWallPrefix));
      if (found != kWallWords.end()) return row_of(safety::RowKind::kWall, wall(found), distance_m);
    } else if (text.starts_with(kNoFlyPrefix)) {
      const std::string_view digits = after(kNoFlyPrefix);
      int index = -1;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
      const bool is_index = error == std::errc{} && end == digits.data() + digits.size() && index >= 0;
      if (is_index) return safety::HoldingRow{safety::RowKind::kNoFly, index, distance_m};
    }
    rows.refuse(kColumn, "drone:ID, wall:left|right|bottom|top, no_fly:NUMBER or nothing");
  }

  static std::size_t wall(const std::string_view* found) {
    return static_cast<std::size_t>(found - kWallWords.begin());
  }

  static safety::HoldingRow row_of(safety::RowKind kind, std::size_t index, double distance_m) {
    return {kind, static_cast<int>(index), distance_m};
  }

  // Keeps what both files have in full.
  void keep_ticks(std::size_t complete, bool has_more_rows) {
    if (complete == 0) {
      throw RecordingError(fmt::format("{}: no complete tick in it; fly the mission again", folder_.string()));
    }
    if (complete < flight_.tick_count()) incomplete(fmt::format("{} ends before {}", kDroneFile, kTickFile));
    if (has_more_rows) incomplete(fmt::format("{} ends before {}", kTickFile, kDroneFile));
    for_each_column([&](auto& column, std::size_t per_tick) { column.resize(complete * per_tick); });
  }

  template <class Do>
  void for_each_column(const Do& act) {
    runtime::TickColumns& t = flight_.ticks;
    const auto ticks = [&](auto&... columns) { (act(columns, 1), ...); };
    ticks(t.time_s, t.metric, t.metric_percent, t.active, t.idle, t.fallback, t.clearances);
    runtime::DroneColumns& d = flight_.rows;
    const auto drones = [&](auto&... columns) { (act(columns, flight_.drones.size()), ...); };
    drones(d.mode, d.activity, d.position_m, d.height_m, d.velocity_m_s, d.age_s, d.nominal_m_s, d.action,
           d.command_m_s, d.held_by, d.fallback, d.true_position_m, d.true_height_m);
  }

  void read_targets() {
    CsvRows rows = open(kTargetFile, kTargetHeader);
    while (rows.next()) {
      const double time_s = rows.number(0);
      if (flight_.targets.empty() || flight_.targets.back().time_s != time_s) {
        if (!flight_.targets.empty() && time_s < flight_.targets.back().time_s) rows.refuse(0, "no earlier time");
        flight_.targets.emplace_back().time_s = time_s;
      }
      add_target(rows, flight_.targets.back());
    }
    note_cut(rows, kTargetFile);
  }

  static void add_target(const CsvRows& rows, runtime::RecordedTargets& list) {
    const std::string_view kind = rows.text(1);
    if (kind == "none") return;
    const Vec2 point{rows.number(4), rows.number(5)};
    if (kind == "cluster") {
      entry_for(rows, list.clusters).points_m.push_back(point);
    } else if (kind == "area") {
      entry_for(rows, list.areas).outline_m.push_back(point);
    } else {
      rows.refuse(1, "cluster, area or none");
    }
  }

  template <class Entry>
  static Entry& entry_for(const CsvRows& rows, std::vector<Entry>& entries) {
    if (entries.empty() || entries.back().name != rows.text(2)) {
      Entry& entry = entries.emplace_back();
      entry.name = rows.text(2);
      entry.weight = rows.number(3);
      if (entry.weight < 0.0) rows.refuse(3, "0 or more");
    }
    return entries.back();
  }

  void read_events() {
    CsvRows rows = open(kEventFile, kEventHeader);
    bool has_finished = false;
    while (rows.next()) {
      has_finished = rows.text(1) == kRecorderSource && rows.text(2) == kFinished;
      if (has_finished) continue;
      const double time_s = rows.number(0);
      if (!flight_.events.empty() && time_s < flight_.events.back().time_s) rows.refuse(0, "no earlier time");
      flight_.events.push_back({time_s, std::string(rows.text(1)), std::string(rows.text(2)), std::string(rows.text(3)),
                                std::string(rows.text(4))});
    }
    note_cut(rows, kEventFile);
    if (!has_finished) incomplete(fmt::format("{} has no line that says that the recording was finished", kEventFile));
  }

  std::filesystem::path folder_;
  ReadLimits limits_;
  RecordedFlight flight_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace

RecordedFlight read_recording(const std::filesystem::path& directory, const ReadLimits& limits) {
  return Reader(directory / "recording", limits).read();
}

}  // namespace vigil::recording

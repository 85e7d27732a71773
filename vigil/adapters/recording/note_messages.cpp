#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vigil/adapters/recording/cdr_reader.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/swarm/names.hpp"

/// Messages that come now and then: commands, targets, events.
namespace vigil::recording {
namespace {

constexpr std::size_t kCommandBytes = 48;
constexpr std::size_t kEntryBytes = 64;
constexpr std::size_t kNoteBytes = 64;
constexpr std::int32_t kAllDrones = -1;

std::size_t bytes_of(const swarm::Command& command) {
  if (command.target == nullptr) return kCommandBytes;
  const auto phi = static_cast<std::size_t>(command.target->phi_k.size() + command.target->protected_k.size());
  return kCommandBytes + kEntryBytes + sizeof(double) * (phi + 4 * command.target->no_fly.size());
}

void put_target(CdrWriter& writer, const swarm::CoverageTarget& target) {
  writer.put(target.has_targets);
  writer.put(static_cast<std::uint32_t>(target.phi_k.rows()));
  for (const ergodic::Coefficients* of : {&target.phi_k, &target.protected_k})
    writer.sequence(std::span<const double>(of->data(), static_cast<std::size_t>(of->size())));
  writer.count(4 * target.no_fly.size());
  for (const field::Segment& edge : target.no_fly)
    for (const double value : {edge.a.x(), edge.a.y(), edge.b.x(), edge.b.y()}) writer.put(value);
}

ergodic::Coefficients coefficients_in(CdrReader& reader, std::size_t rows) {
  const std::vector<double> all = reader.sequence<double>();
  if (all.empty()) return {};
  if (rows == 0 || all.size() % rows != 0) throw RecordingError("coefficients of no shape");
  return Eigen::Map<const ergodic::Coefficients>(all.data(), static_cast<Eigen::Index>(rows),
                                                 static_cast<Eigen::Index>(all.size() / rows));
}

std::shared_ptr<const swarm::CoverageTarget> target_in(CdrReader& reader) {
  auto target = std::make_shared<swarm::CoverageTarget>();
  target->has_targets = reader.flag();
  const std::size_t rows = reader.u32();
  target->phi_k = coefficients_in(reader, rows);
  target->protected_k = coefficients_in(reader, rows);
  const std::vector<double> edges = reader.sequence<double>();
  if (edges.size() % 4 != 0) throw RecordingError("no-fly edges with an end missing");
  for (std::size_t n = 0; n < edges.size(); n += 4)
    target->no_fly.push_back({{edges[n], edges[n + 1]}, {edges[n + 2], edges[n + 3]}});
  return target;
}

void put_command(CdrWriter& writer, const swarm::Command& command) {
  writer.put(static_cast<std::uint8_t>(command.kind));
  writer.put(command.drone ? static_cast<std::int32_t>(command.drone->index()) : kAllDrones);
  writer.put(command.place.x());
  writer.put(command.place.y());
  writer.count(command.target == nullptr ? 0 : 1);
  if (command.target != nullptr) put_target(writer, *command.target);
}

swarm::Command command_in(CdrReader& reader) {
  swarm::Command command;
  const std::uint8_t kind = reader.u8();
  if (kind >= swarm::kCommandWords.size()) throw RecordingError("a command of a kind that there is not");
  command.kind = static_cast<swarm::CommandKind>(kind);
  const std::int32_t drone = reader.i32();
  if (drone != kAllDrones) command.drone = swarm::DroneId(static_cast<std::size_t>(std::max(drone, 0)));
  command.place.x() = reader.number();
  command.place.y() = reader.number();
  if (reader.count(1) > 0) command.target = target_in(reader);
  return command;
}

void put_points(CdrWriter& writer, const std::vector<Vec2>& points) {
  writer.count(2 * points.size());
  for (const Vec2& point : points)
    for (const double value : {point.x(), point.y()}) writer.put(value);
}

std::vector<Vec2> points_in(CdrReader& reader) {
  const std::vector<double> numbers = reader.sequence<double>();
  if (numbers.size() % 2 != 0) throw RecordingError("a point without its y");
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2) points.emplace_back(numbers[i], numbers[i + 1]);
  return points;
}

void put_deadline(CdrWriter& writer, const std::optional<double>& revisit_s) {
  writer.put(revisit_s.value_or(std::numeric_limits<double>::quiet_NaN()));
}

std::optional<double> deadline_in(CdrReader& reader) {
  const double revisit_s = reader.number();
  return std::isnan(revisit_s) ? std::nullopt : std::optional(revisit_s);
}

void put_entry(CdrWriter& writer, const runtime::ClusterEntry& cluster) {
  writer.put(std::string_view(cluster.name));
  writer.put(cluster.weight);
  put_deadline(writer, cluster.revisit_s);
  writer.put(0.0);
  writer.put(cluster.is_protected);
  put_points(writer, cluster.points_m);
}

void put_entry(CdrWriter& writer, const runtime::AreaEntry& area) {
  writer.put(std::string_view(area.name));
  writer.put(area.weight);
  put_deadline(writer, area.revisit_s);
  writer.put(area.soft_edge_m);
  writer.put(area.is_protected);
  put_points(writer, area.outline_m);
}

void put_entry(CdrWriter& writer, const runtime::NoFlyEntry& no_fly) {
  writer.put(std::string_view(no_fly.name));
  put_points(writer, no_fly.outline_m);
}

void take_entry(CdrReader& reader, runtime::ClusterEntry& cluster) {
  cluster.name = reader.text();
  cluster.weight = reader.number();
  cluster.revisit_s = deadline_in(reader);
  (void)reader.number();
  cluster.is_protected = reader.flag();
  cluster.points_m = points_in(reader);
}

void take_entry(CdrReader& reader, runtime::AreaEntry& area) {
  area.name = reader.text();
  area.weight = reader.number();
  area.revisit_s = deadline_in(reader);
  area.soft_edge_m = reader.number();
  area.is_protected = reader.flag();
  area.outline_m = points_in(reader);
}

void take_entry(CdrReader& reader, runtime::NoFlyEntry& no_fly) {
  no_fly.name = reader.text();
  no_fly.outline_m = points_in(reader);
}

template <class Entry>
void put_entries(CdrWriter& writer, const std::vector<Entry>& entries) {
  writer.count(entries.size());
  for (const Entry& entry : entries) put_entry(writer, entry);
}

template <class Entry>
void take_entries(CdrReader& reader, std::vector<Entry>& entries) {
  constexpr std::size_t kLeastBytes = 9;  // a name's length and its end, how many points
  const std::size_t count = reader.count(kLeastBytes);
  for (std::size_t n = 0; n < count; ++n) take_entry(reader, entries.emplace_back());
}

std::size_t bytes_of(const std::string& name, const std::vector<Vec2>& points) {
  return kEntryBytes + name.size() + sizeof(Vec2) * points.size();
}

std::size_t bytes_of(const runtime::MissionTargets& targets) {
  std::size_t bytes = kNoteBytes;
  for (const auto& cluster : targets.targets.clusters) bytes += bytes_of(cluster.name, cluster.points_m);
  for (const auto& area : targets.targets.areas) bytes += bytes_of(area.name, area.outline_m);
  for (const auto& no_fly : targets.no_fly) bytes += bytes_of(no_fly.name, no_fly.outline_m);
  return bytes;
}

void expect_sealed(std::span<const char> message, const char* what) {
  if (!is_sealed(message)) throw RecordingError(std::string(what) + " is damaged: its seal is another");
}

}  // namespace

void write_commands(CdrWriter& writer, std::uint64_t tick, std::span<const swarm::Command> commands) {
  std::size_t bytes = kNoteBytes;
  for (const swarm::Command& command : commands) bytes += bytes_of(command);
  writer.start(bytes);
  writer.put(tick);
  writer.count(commands.size());
  for (const swarm::Command& command : commands) put_command(writer, command);
  writer.seal();
}

CommandsRead read_commands(std::span<const char> message) {
  CdrReader reader(message);
  CommandsRead read{.tick = reader.u64(), .is_damaged = !is_sealed(message)};
  if (read.is_damaged) return read;
  constexpr std::size_t kLeastBytes = 25;
  const std::size_t count = reader.count(kLeastBytes);
  for (std::size_t n = 0; n < count; ++n) read.commands.push_back(command_in(reader));
  return read;
}

void write_targets(CdrWriter& writer, double time_s, const runtime::MissionTargets& targets) {
  writer.start(bytes_of(targets));
  writer.put(time_s);
  put_entries(writer, targets.targets.clusters);
  put_entries(writer, targets.targets.areas);
  put_entries(writer, targets.no_fly);
  writer.put(targets.targets.uniform_floor);
  writer.seal();
}

runtime::RecordedTargets read_targets(std::span<const char> message) {
  expect_sealed(message, "a list of targets");
  CdrReader reader(message);
  runtime::RecordedTargets targets;
  targets.time_s = reader.number();
  take_entries(reader, targets.clusters);
  take_entries(reader, targets.areas);
  take_entries(reader, targets.no_fly);
  targets.uniform_floor = reader.number();
  return targets;
}

void write_event(CdrWriter& writer, const runtime::LoggedEvent& event) {
  writer.start(kNoteBytes + event.source.size() + event.what.size() + event.drone.size() + event.detail.size());
  writer.put(event.time_s);
  for (const std::string* text : {&event.source, &event.what, &event.drone, &event.detail})
    writer.put(std::string_view(*text));
  writer.seal();
}

runtime::LoggedEvent read_event(std::span<const char> message) {
  expect_sealed(message, "an event");
  CdrReader reader(message);
  runtime::LoggedEvent event;
  event.time_s = reader.number();
  for (std::string* text : {&event.source, &event.what, &event.drone, &event.detail}) *text = reader.text();
  return event;
}

}  // namespace vigil::recording

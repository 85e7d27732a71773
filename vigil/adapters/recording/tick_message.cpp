#include <array>

#include "vigil/adapters/recording/cdr_reader.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/seal.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::recording {
namespace {

// Numbers of each drone, as vigil_msgs/msg/Tick lists them.
constexpr std::size_t kObserved = 8;
constexpr std::size_t kDecided = 9;
constexpr std::size_t kIndices = 3;
constexpr std::size_t kCodes = 5;
constexpr std::size_t kTruth = 5;

// Bits of the third code.
constexpr unsigned kIsObstacle = 1;
constexpr unsigned kSpeedLimited = 2;
constexpr unsigned kMarginUsed = 4;
constexpr unsigned kFallback = 8;
constexpr unsigned kInputRejected = 16;
constexpr unsigned kCrowded = 32;
// Of the fourth: two bits of how many rows hold, then two of each one's kind.
constexpr unsigned kTwoBits = 3;

using Observed = std::array<double, kObserved>;
using Decided = std::array<double, kDecided>;
using Indices = std::array<std::int32_t, kIndices>;
using Codes = std::array<std::uint8_t, kCodes>;
using Truth = std::array<double, kTruth>;

Observed numbers_of(const swarm::DroneObservation& o) {
  return {o.position.x(), o.position.y(), o.velocity.x(), o.velocity.y(), o.height_m, o.age_s, o.link_age_s, o.battery};
}

void set(const Observed& n, swarm::DroneObservation& o) {
  o.position = {n[0], n[1]};
  o.velocity = {n[2], n[3]};
  o.height_m = n[4];
  o.age_s = n[5];
  o.link_age_s = n[6];
  o.battery = n[7];
}

/// What the controller knew, where not every tick was kept.
swarm::DroneObservation known_of(const swarm::DroneSnapshot& drone) {
  return {.position = drone.position,
          .velocity = drone.velocity,
          .height_m = drone.height_m,
          .age_s = drone.age_s,
          .mode = drone.mode,
          .link_age_s = drone.link_age_s,
          .battery = drone.battery};
}

Decided numbers_of(const swarm::DroneSnapshot& d) {
  const safety::FilterReport& f = d.filter;
  return {d.u_nom.x(),
          d.u_nom.y(),
          d.order.velocity.x(),
          d.order.velocity.y(),
          f.holding[0].distance_m,
          f.holding[1].distance_m,
          f.violation_m_s,
          f.correction_m_s,
          f.nearest_distance_m};
}

void set(const Decided& n, swarm::DroneSnapshot& d) {
  d.u_nom = {n[0], n[1]};
  d.order.velocity = {n[2], n[3]};
  d.filter.holding[0].distance_m = n[4];
  d.filter.holding[1].distance_m = n[5];
  d.filter.violation_m_s = n[6];
  d.filter.correction_m_s = n[7];
  d.filter.nearest_distance_m = n[8];
}

Indices indices_of(const safety::FilterReport& f) { return {f.nearest, f.holding[0].index, f.holding[1].index}; }

void set(const Indices& n, safety::FilterReport& f) {
  f.nearest = n[0];
  f.holding[0].index = n[1];
  f.holding[1].index = n[2];
}

std::uint8_t flags_of(const swarm::DroneSnapshot& d) {
  const safety::FilterReport& f = d.filter;
  const unsigned flags = (d.is_obstacle ? kIsObstacle : 0U) | (f.speed_limited ? kSpeedLimited : 0U) |
                         (f.margin_used ? kMarginUsed : 0U) | (f.fallback ? kFallback : 0U) |
                         (f.input_rejected ? kInputRejected : 0U) | (f.crowded ? kCrowded : 0U);
  return static_cast<std::uint8_t>(flags);
}

Codes codes_of(const swarm::DroneSnapshot& d) {
  const safety::FilterReport& f = d.filter;
  const unsigned holding = static_cast<unsigned>(f.holding_count) | static_cast<unsigned>(f.holding[0].kind) << 2U |
                           static_cast<unsigned>(f.holding[1].kind) << 4U;
  return {static_cast<std::uint8_t>(d.activity), static_cast<std::uint8_t>(d.order.action), flags_of(d),
          static_cast<std::uint8_t>(holding), static_cast<std::uint8_t>(d.fault.kind)};
}

/// Whether every code is one of its enumeration.
bool set(const Codes& n, swarm::DroneSnapshot& d) {
  const unsigned flags = n[2];
  const unsigned count = n[3] & kTwoBits;
  const unsigned first = n[3] >> 2U & kTwoBits;
  const unsigned second = n[3] >> 4U & kTwoBits;
  if (n[0] >= swarm::kActivityWords.size() || n[1] >= swarm::kActionWords.size() || count > 2 || first > 2 ||
      second > 2 || n[4] >= swarm::kFaultWords.size())
    return false;
  d.fault.kind = static_cast<swarm::Fault>(n[4]);
  d.activity = static_cast<swarm::Activity>(n[0]);
  d.order.action = static_cast<swarm::Action>(n[1]);
  d.is_obstacle = (flags & kIsObstacle) != 0;
  safety::FilterReport& f = d.filter;
  f.speed_limited = (flags & kSpeedLimited) != 0;
  f.margin_used = (flags & kMarginUsed) != 0;
  f.fallback = (flags & kFallback) != 0;
  f.input_rejected = (flags & kInputRejected) != 0;
  f.crowded = (flags & kCrowded) != 0;
  f.holding_count = static_cast<int>(count);
  f.holding[0].kind = static_cast<safety::RowKind>(first);
  f.holding[1].kind = static_cast<safety::RowKind>(second);
  return true;
}

Truth numbers_of(const runtime::TruthSample& t) {
  return {t.position.x(), t.position.y(), t.velocity.x(), t.velocity.y(), t.height_m};
}

void set(const Truth& n, runtime::TruthSample& t) {
  t.position = {n[0], n[1]};
  t.velocity = {n[2], n[3]};
  t.height_m = n[4];
}

std::array<double, 4> numbers_of(const runtime::Clearances& c) {
  return {c.airborne_pair_m, c.active_pair_m, c.wall_m, c.no_fly_m};
}

/// What cannot be recomputed of one drone: what was observed of it, and what was true.
std::uint64_t seal_of(const swarm::DroneObservation& observed, const runtime::TruthSample* truth) {
  Seal seal;
  seal.add(std::span<const double>(numbers_of(observed)));
  seal.add(static_cast<std::uint64_t>(observed.mode));
  if (truth != nullptr) {
    seal.add(std::span<const double>(numbers_of(*truth)));
    seal.add(static_cast<std::uint64_t>(truth->mode));
  }
  return seal.value();
}

/// What concerns the whole tick.
struct Header {
  std::uint64_t tick;
  double time_s;
  bool has_metric;
  double metric;
  double metric_percent;
  std::uint32_t active;
  std::uint8_t idle;
  bool fallback;
  std::array<double, 4> clearances;

  [[nodiscard]] std::uint64_t seal() const {
    Seal seal;
    seal.add(tick);
    seal.add(time_s);
    seal.add(metric);
    seal.add(metric_percent);
    seal.add(std::uint64_t{active});
    seal.add(std::uint64_t{idle} * 4 + (has_metric ? 2 : 0) + (fallback ? 1 : 0));
    seal.add(std::span<const double>(clearances));
    return seal.value();
  }
};

Header header_of(const TickToWrite& tick) {
  const swarm::Snapshot& s = tick.snapshot;
  return {.tick = s.tick,
          .time_s = s.time_s,
          .has_metric = s.has_metric,
          .metric = s.metric,
          .metric_percent = s.metric_percent,
          .active = static_cast<std::uint32_t>(s.active),
          .idle = static_cast<std::uint8_t>(s.idle),
          .fallback = tick.fallback,
          .clearances = numbers_of(tick.clearances)};
}

void put(CdrWriter& writer, const Header& header) {
  writer.put(header.tick);
  writer.put(header.time_s);
  writer.put(header.has_metric);
  writer.put(header.metric);
  writer.put(header.metric_percent);
  writer.put(header.active);
  writer.put(header.idle);
  writer.put(header.fallback);
  writer.elements(std::span<const double>(header.clearances));
  writer.put(header.seal());
}

Header header_in(CdrReader& reader, std::uint64_t& seal) {
  Header header{};
  header.tick = reader.u64();
  header.time_s = reader.number();
  header.has_metric = reader.flag();
  header.metric = reader.number();
  header.metric_percent = reader.number();
  header.active = reader.u32();
  header.idle = reader.u8();
  header.fallback = reader.flag();
  reader.elements(std::span<double>(header.clearances));
  seal = reader.u64();
  return header;
}

void set(const Header& header, runtime::RecordedTick& tick) {
  swarm::Snapshot& s = tick.snapshot;
  s.tick = header.tick;
  s.time_s = header.time_s;
  s.has_metric = header.has_metric;
  s.metric = header.metric;
  s.metric_percent = header.metric_percent;
  s.active = header.active;
  const bool is_known = header.idle < swarm::kIdleWords.size();
  s.idle = is_known ? static_cast<swarm::Idle>(header.idle) : swarm::Idle::kNone;
  s.fallback = header.fallback;
  s.events.clear();
  const auto& c = header.clearances;
  tick.clearances = {.airborne_pair_m = c[0], .active_pair_m = c[1], .wall_m = c[2], .no_fly_m = c[3]};
}

std::size_t bytes_of(std::size_t drones) {
  constexpr std::size_t kTickBytes = 256;
  constexpr std::size_t kNumbers = kObserved + kDecided + kTruth + 1;
  return kTickBytes + drones * (kNumbers * sizeof(double) + kIndices * sizeof(std::int32_t) + kCodes + 2);
}

/// The rows of all drones: a sequence of numbers, each drone's next to each other.
template <class Row>
void put_rows(CdrWriter& writer, std::size_t drones, const Row& row) {
  using Values = decltype(row(std::size_t{0}));
  using Number = typename Values::value_type;
  writer.count(drones * std::tuple_size_v<Values>);
  for (std::size_t i = 0; i < drones; ++i) {
    const Values values = row(i);
    writer.elements(std::span<const Number>(values));
  }
}

template <class Number, std::size_t kEach, class Take>
void take_rows(CdrReader& reader, std::size_t drones, const Take& take) {
  if (reader.count(sizeof(Number)) != drones * kEach) throw RecordingError("a tick of another number of drones");
  std::array<Number, kEach> values{};
  for (std::size_t i = 0; i < drones; ++i) {
    reader.elements(std::span<Number>(values));
    take(i, values);
  }
}

using Code = std::array<std::uint8_t, 1>;
using Word = std::array<std::uint64_t, 1>;

/// Whether codes and seals are right, drone by drone.
class DroneChecks {
 public:
  explicit DroneChecks(runtime::RecordedTick& tick) : tick_(tick) {}
  void expect(bool holds, std::size_t drone, const char* what) {
    if (!holds && !tick_.damage) tick_.damage = {drone, what};
  }
  [[nodiscard]] swarm::VehicleMode mode(std::uint8_t code, std::size_t drone, const char* what) {
    expect(code < swarm::kModeWords.size(), drone, what);
    return code < swarm::kModeWords.size() ? static_cast<swarm::VehicleMode>(code) : swarm::VehicleMode::kUnknown;
  }

 private:
  runtime::RecordedTick& tick_;
};

void read_observed(CdrReader& reader, runtime::RecordedTick& tick, DroneChecks& checks) {
  const std::size_t drones = tick.observations.size();
  take_rows<double, kObserved>(reader, drones, [&](std::size_t i, const Observed& n) { set(n, tick.observations[i]); });
  take_rows<std::uint8_t, 1>(reader, drones, [&](std::size_t i, const Code& n) {
    tick.observations[i].mode = checks.mode(n[0], i, "the mode observed of it");
  });
}

void read_decided(CdrReader& reader, runtime::RecordedTick& tick, DroneChecks& checks) {
  std::vector<swarm::DroneSnapshot>& to = tick.snapshot.drones;
  take_rows<double, kDecided>(reader, to.size(), [&](std::size_t i, const Decided& n) { set(n, to[i]); });
  take_rows<std::int32_t, kIndices>(reader, to.size(), [&](std::size_t i, const Indices& n) { set(n, to[i].filter); });
  take_rows<std::uint8_t, kCodes>(reader, to.size(), [&](std::size_t i, const Codes& n) {
    checks.expect(set(n, to[i]), i, "what was decided of it");
  });
}

void read_truth(CdrReader& reader, runtime::RecordedTick& tick, DroneChecks& checks) {
  const std::size_t numbers = reader.count(sizeof(double));
  const std::size_t drones = numbers == 0 ? 0 : tick.observations.size();
  if (numbers != drones * kTruth) throw RecordingError("a tick with the truth of another number of drones");
  tick.truth.resize(drones);
  for (runtime::TruthSample& truth : tick.truth) {
    Truth values{};
    reader.elements(std::span<double>(values));
    set(values, truth);
  }
  take_rows<std::uint8_t, 1>(reader, drones, [&](std::size_t i, const Code& n) {
    tick.truth[i].mode = checks.mode(n[0], i, "its true mode");
  });
}

}  // namespace

void write_tick(CdrWriter& writer, const TickToWrite& tick) {
  const std::vector<swarm::DroneSnapshot>& drones = tick.snapshot.drones;
  const auto observed = [&](std::size_t i) { return tick.is_thinned ? known_of(drones[i]) : tick.observations[i]; };
  const auto truth = [&](std::size_t i) { return tick.truth.empty() ? nullptr : &tick.truth[i]; };
  writer.start(bytes_of(drones.size()));
  put(writer, header_of(tick));
  put_rows(writer, drones.size(), [&](std::size_t i) { return numbers_of(observed(i)); });
  put_rows(writer, drones.size(), [&](std::size_t i) { return Code{static_cast<std::uint8_t>(observed(i).mode)}; });
  put_rows(writer, drones.size(), [&](std::size_t i) { return numbers_of(drones[i]); });
  put_rows(writer, drones.size(), [&](std::size_t i) { return indices_of(drones[i].filter); });
  put_rows(writer, drones.size(), [&](std::size_t i) { return codes_of(drones[i]); });
  put_rows(writer, tick.truth.size(), [&](std::size_t i) { return numbers_of(tick.truth[i]); });
  put_rows(writer, tick.truth.size(),
           [&](std::size_t i) { return Code{static_cast<std::uint8_t>(tick.truth[i].mode)}; });
  put_rows(writer, drones.size(), [&](std::size_t i) { return Word{seal_of(observed(i), truth(i))}; });
}

void read_tick(std::span<const char> message, runtime::RecordedTick& into) {
  CdrReader reader(message);
  into.damage.reset();
  std::uint64_t seal = 0;
  const Header header = header_in(reader, seal);
  set(header, into);
  if (seal != header.seal()) into.damage = {{}, "time, metric, counts or clearances"};
  DroneChecks checks(into);
  read_observed(reader, into, checks);
  read_decided(reader, into, checks);
  read_truth(reader, into, checks);
  take_rows<std::uint64_t, 1>(reader, into.observations.size(), [&](std::size_t i, const Word& n) {
    const runtime::TruthSample* truth = into.truth.empty() ? nullptr : &into.truth[i];
    checks.expect(n[0] == seal_of(into.observations[i], truth), i, "what was observed, or true, of it");
  });
}

}  // namespace vigil::recording

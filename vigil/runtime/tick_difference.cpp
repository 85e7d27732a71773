#include "vigil/runtime/tick_difference.hpp"

#include <bit>
#include <concepts>
#include <cstdint>

#include <fmt/format.h>

#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

bool is_same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
template <class Value>
  requires(!std::floating_point<Value>)
bool is_same(const Value& a, const Value& b) {
  return a == b;
}

/// Hexadecimal as well: two different numbers may have the same decimal digits for a reader.
std::string shown(double value) { return fmt::format("{} ({:a})", value, value); }
std::string shown(bool value) { return value ? "yes" : "no"; }
std::string shown(swarm::Activity value) { return std::string(swarm::name_of(value)); }
std::string shown(swarm::Fault value) { return std::string(swarm::name_of(value)); }
std::string shown(swarm::Action value) { return std::string(swarm::name_of(value)); }
std::string shown(swarm::Idle value) { return std::string(swarm::name_of(value)); }
std::string shown(safety::RowKind value) { return fmt::format("kind {}", static_cast<int>(value)); }
template <std::integral Value>
std::string shown(Value value) {
  return fmt::format("{}", value);
}

/// Goes on comparing until something differs.
class Comparison {
 public:
  explicit Comparison(TickDifference place) : place_(std::move(place)) {}

  template <class Value>
  Comparison& of(const char* what, const Value& recorded, const Value& recomputed) {
    if (found_ || is_same(recorded, recomputed)) return *this;
    found_ = true;
    place_.what = what;
    place_.recorded = shown(recorded);
    place_.recomputed = shown(recomputed);
    return *this;
  }
  Comparison& of_vector(const char* x, const char* y, const Vec2& recorded, const Vec2& recomputed) {
    return of(x, recorded.x(), recomputed.x()).of(y, recorded.y(), recomputed.y());
  }
  [[nodiscard]] bool has_found() const { return found_; }
  [[nodiscard]] const TickDifference& place() const { return place_; }

 private:
  TickDifference place_;
  bool found_ = false;
};

void compare(Comparison& comparison, const safety::FilterReport& a, const safety::FilterReport& b) {
  comparison.of("how many rows hold it", a.holding_count, b.holding_count);
  for (std::size_t n = 0; n < a.holding.size() && static_cast<int>(n) < b.holding_count; ++n)
    comparison.of("kind of what holds it", a.holding[n].kind, b.holding[n].kind)
        .of("index of what holds it", a.holding[n].index, b.holding[n].index)
        .of("distance of what holds it", a.holding[n].distance_m, b.holding[n].distance_m);
  comparison.of("held by the speed limit", a.speed_limited, b.speed_limited)
      .of("margin used", a.margin_used, b.margin_used)
      .of("fall-back", a.fallback, b.fallback)
      .of("violation", a.violation_m_s, b.violation_m_s)
      .of("input rejected", a.input_rejected, b.input_rejected)
      .of("crowded", a.crowded, b.crowded)
      .of("correction", a.correction_m_s, b.correction_m_s)
      .of("nearest drone", a.nearest, b.nearest)
      .of("distance of the nearest drone", a.nearest_distance_m, b.nearest_distance_m);
}

void compare(Comparison& comparison, const swarm::DroneSnapshot& a, const swarm::DroneSnapshot& b) {
  comparison.of("activity", a.activity, b.activity)
      .of("fault", a.fault.kind, b.fault.kind)
      .of_vector("nominal velocity, x", "nominal velocity, y", a.u_nom, b.u_nom)
      .of("action", a.order.action, b.order.action)
      .of_vector("velocity asked for, x", "velocity asked for, y", a.order.velocity, b.order.velocity)
      .of("counts as an obstacle", a.is_obstacle, b.is_obstacle);
  compare(comparison, a.filter, b.filter);
}

void compare(Comparison& comparison, const swarm::Snapshot& a, const swarm::Snapshot& b) {
  comparison.of("time", a.time_s, b.time_s)
      .of("has a metric", a.has_metric, b.has_metric)
      .of("metric", a.metric, b.metric)
      .of("metric in percent", a.metric_percent, b.metric_percent)
      .of("active drones", a.active, b.active)
      .of("why idle", a.idle, b.idle)
      .of("fall-back", a.fallback, b.fallback);
}

}  // namespace

std::optional<TickDifference> first_difference(const RecordedTick& recorded, const swarm::Snapshot& recomputed) {
  const swarm::Snapshot& snapshot = recorded.snapshot;
  const TickDifference place{.tick = recomputed.tick, .time_s = recomputed.time_s};
  if (recorded.damage) {
    TickDifference damaged = place;
    damaged.drone = recorded.damage->drone;
    damaged.what = recorded.damage->what;
    damaged.recorded = "not what was written: its seal is another";
    return damaged;
  }
  for (std::size_t i = 0; i < recomputed.drones.size(); ++i) {
    Comparison comparison({.tick = place.tick, .time_s = place.time_s, .drone = i});
    compare(comparison, snapshot.drones[i], recomputed.drones[i]);
    if (comparison.has_found()) return comparison.place();
  }
  Comparison comparison(place);
  compare(comparison, snapshot, recomputed);
  if (comparison.has_found()) return comparison.place();
  return std::nullopt;
}

}  // namespace vigil::runtime

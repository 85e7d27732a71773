#include "vigil/adapters/console/frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vigil/adapters/console/frame_writer.hpp"

namespace vigil::console {
namespace {

using Kind = FrameWriter::Kind;

constexpr std::uint16_t kNever = 65535;
constexpr std::uint16_t kLongest = 65534;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kMostOfLimit = 4.0;  ///< the largest velocity that is sent, in units of u_max

float as_f32(double value) { return static_cast<float>(value); }
std::uint32_t as_u32(std::uint64_t value) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, std::numeric_limits<std::uint32_t>::max()));
}

/// In units of `unit_s`, rounded.
std::uint16_t as_age(double age_s, double unit_s) {
  if (!std::isfinite(age_s)) return kNever;
  return static_cast<std::uint16_t>(std::clamp(std::round(age_s / unit_s), 0.0, static_cast<double>(kLongest)));
}

std::int16_t as_i16(double value, double scale) {
  const double units = std::round(value / scale);
  return std::isfinite(units) ? static_cast<std::int16_t>(std::clamp(units, -32767.0, 32767.0)) : std::int16_t{0};
}

std::uint8_t as_battery(double share) {
  constexpr std::uint8_t kNotReported = 255;
  if (!std::isfinite(share)) return kNotReported;
  return static_cast<std::uint8_t>(std::clamp(std::round(200.0 * share), 0.0, 200.0));
}

std::uint8_t flags_of(const swarm::DroneSnapshot& drone) {
  const safety::FilterReport& report = drone.filter;
  const std::array<bool, 6> bits{report.speed_limited, report.margin_used, report.fallback,
                                 drone.is_obstacle,    report.crowded,     report.input_rejected};
  unsigned flags = 0;
  for (std::size_t bit = 0; bit < bits.size(); ++bit) flags |= bits[bit] ? 1U << bit : 0U;
  return static_cast<std::uint8_t>(flags);
}

bool was_seen(const swarm::DroneSnapshot& drone) { return std::isfinite(drone.age_s); }

void put_velocity(FrameWriter& out, const Vec2& velocity, double scale) {
  out.put(as_i16(velocity.x(), scale));
  out.put(as_i16(velocity.y(), scale));
}

/// What a snapshot says of single drones.
class DroneArrays {
 public:
  DroneArrays(const swarm::Snapshot& snapshot, const ShownDrones& shown) : drones_(snapshot.drones), shown_(shown) {}

  [[nodiscard]] std::size_t holding_rows() const {
    std::size_t rows = 0;
    for (const std::size_t i : shown_.drones()) rows += static_cast<std::size_t>(drones_[i].filter.holding_count);
    return rows;
  }

  void put(FrameWriter& out, double scale) const {
    using Drone = swarm::DroneSnapshot;
    array_of(out, [&](const Drone& drone) {
      out.put(was_seen(drone) ? as_f32(drone.position.x()) : kNone);
      out.put(was_seen(drone) ? as_f32(drone.position.y()) : kNone);
    });
    array_of(out, [&](const Drone& drone) { out.put(as_f32(drone.height_m)); });
    array_of(out, [&](const Drone& drone) {
      out.put(drone.filter.nearest < 0 ? kNone : as_f32(drone.filter.nearest_distance_m));
    });
    array_of(out, [&](const Drone& drone) { put_velocity(out, drone.velocity, scale); });
    array_of(out, [&](const Drone& drone) { put_velocity(out, drone.u_nom, scale); });
    array_of(out, [&](const Drone& drone) { put_velocity(out, drone.order.velocity, scale); });
    array_of(out, [&](const Drone& drone) { out.put(as_age(drone.age_s, 1e-3)); });
    array_of(out, [&](const Drone& drone) { out.put(as_age(drone.link_age_s, 1e-3)); });
    array_of(out, [&](const Drone& drone) { out.put(as_battery(drone.battery)); });
    array_of(out, [&](const Drone& drone) { out.put(static_cast<std::uint8_t>(drone.mode)); });
    array_of(out, [&](const Drone& drone) { out.put(static_cast<std::uint8_t>(drone.activity)); });
    array_of(out, [&](const Drone& drone) { out.put(static_cast<std::uint8_t>(drone.order.action)); });
    array_of(out, [&](const Drone& drone) { out.put(flags_of(drone)); });
    put_holding(out);
  }

 private:
  template <typename Write>
  void array_of(FrameWriter& out, const Write& write) const {
    out.align();
    for (const std::size_t i : shown_.drones()) write(drones_[i]);
  }

  void put_holding(FrameWriter& out) const {
    out.align();
    for (const std::size_t i : shown_.drones()) {
      safety::FilterReport report = drones_[i].filter;
      const auto holding = std::span(report.holding).first(static_cast<std::size_t>(report.holding_count));
      std::ranges::stable_sort(holding, {}, &safety::HoldingRow::distance_m);  // the filter has them as it met them
      for (const safety::HoldingRow& row : holding) {
        out.put(shown_.place_of(i));
        out.put(static_cast<std::uint32_t>(row.kind));
        out.put(row.kind == safety::RowKind::kNeighbour ? shown_.place_of(static_cast<std::size_t>(row.index))
                                                        : static_cast<std::uint32_t>(row.index));
        out.put(as_f32(row.distance_m));
      }
    }
  }

  const std::vector<swarm::DroneSnapshot>& drones_;
  const ShownDrones& shown_;
};

}  // namespace

std::string snapshot_frame(const runtime::LiveFrame& frame, const runtime::ClockState& clock,
                           const SnapshotContext& context, const ShownDrones& shown) {
  const swarm::Snapshot& snapshot = frame.snapshot;
  const double scale = kMostOfLimit * context.speed_limit_m_s / 32767.0;
  const unsigned flags = (clock.is_paused ? 1U : 0U) | (snapshot.fallback ? 2U : 0U) | (snapshot.has_metric ? 4U : 0U);
  const DroneArrays arrays(snapshot, shown);
  const std::size_t rows = arrays.holding_rows();
  const double pair_m = runtime::least_airborne_pair_m(snapshot);
  constexpr std::uint16_t kHeader = 104;
  FrameWriter out(Kind::kSnapshot, static_cast<std::uint8_t>(flags), kHeader, context.epoch, as_u32(shown.size()));
  out.reserve(kHeader + 40 * shown.size() + 16 * rows + 64);
  out.put(static_cast<double>(snapshot.tick));
  out.put(snapshot.time_s);
  out.put(context.wall_ms);
  out.put(as_f32(context.age_s));
  out.put(as_f32(clock.speed));
  out.put(as_f32(snapshot.metric));
  out.put(as_f32(snapshot.metric_percent));
  out.put(std::isfinite(pair_m) ? as_f32(pair_m) : kNone);
  out.put(as_f32(context.worst_age_s));
  out.put(as_f32(clock.lateness.p50_us));
  out.put(as_f32(clock.lateness.p99_us));
  out.put(as_u32(snapshot.active));
  out.put(as_u32(frame.revision));
  out.put(static_cast<std::uint8_t>(snapshot.idle));
  out.align();
  out.put(as_f32(scale));
  out.put(as_u32(rows));
  out.put(context.lost_ticks);
  out.put(context.steady_ms);
  arrays.put(out, scale);
  return out.take();
}

std::string density_frame(const field::Field& field, const std::optional<field::DensityGrid>& density,
                          const DensityContext& context) {
  const auto width = density ? static_cast<std::uint32_t>(density->values.rows()) : 0U;
  const auto height = density ? static_cast<std::uint32_t>(density->values.cols()) : 0U;
  const double peak = density ? density->values.maxCoeff() : 0.0;
  const unsigned flags = (context.is_preview ? 1U : 0U) | (density ? 0U : 2U);
  FrameWriter out(Kind::kDensity, static_cast<std::uint8_t>(flags), 48, context.epoch, width * height);
  out.put(width);
  out.put(height);
  out.put(as_f32(field.length_x));
  out.put(as_f32(field.length_y));
  out.put(as_f32(peak));
  out.put(context.revision);
  out.put(static_cast<double>(context.request));
  if (!density) return out.take();
  const double scale = peak > 0.0 ? 65535.0 / peak : 0.0;
  for (Eigen::Index iy = 0; iy < density->values.cols(); ++iy)
    for (Eigen::Index ix = 0; ix < density->values.rows(); ++ix)
      out.put(static_cast<std::uint16_t>(std::clamp(std::round(density->values(ix, iy) * scale), 0.0, 65535.0)));
  return out.take();
}

std::string coverage_frame(const field::Field& field, const runtime::LiveFrame& frame, std::uint32_t epoch) {
  const bool has_samples = frame.past.coverage.has_samples;
  FrameWriter out(Kind::kCoverage, has_samples ? 1 : 0, 40, epoch, static_cast<std::uint32_t>(frame.c_k.size()));
  out.put(frame.snapshot.time_s);
  out.put(as_f32(field.length_x));
  out.put(as_f32(field.length_y));
  out.put(static_cast<std::uint32_t>(frame.c_k.rows()));
  out.put(std::uint32_t{0});
  for (Eigen::Index k2 = 0; k2 < frame.c_k.cols(); ++k2)
    for (Eigen::Index k1 = 0; k1 < frame.c_k.rows(); ++k1) out.put(as_f32(frame.c_k(k1, k2)));
  return out.take();
}

std::string age_frame(const field::SeenMap& seen, double now_s, std::uint32_t epoch) {
  FrameWriter out(Kind::kAge, 0, 40, epoch, as_u32(seen.seen_s().size()));
  out.put(now_s);
  out.put(as_f32(seen.field().length_x));
  out.put(as_f32(seen.field().length_y));
  out.put(static_cast<std::uint32_t>(seen.shape().nx));
  out.put(static_cast<std::uint32_t>(seen.shape().ny));
  for (const double seen_s : seen.seen_s()) out.put(as_age(now_s - seen_s, 0.1));
  return out.take();
}

std::string trails_frame(const Trails& trails, std::uint32_t epoch) {
  FrameWriter out(Kind::kTrails, 0, 32, epoch, as_u32(trails.drones));
  out.put(as_u32(trails.points));
  out.put(as_f32(trails.spacing_s));
  out.put(trails.newest_s);
  for (const float coordinate : trails.xy) out.put(coordinate);
  return out.take();
}

std::string history_frame(const runtime::FlightHistory& history, std::uint32_t epoch) {
  FrameWriter out(Kind::kHistory, 0, 32, epoch, as_u32(history.rows().size()));
  out.put(as_u32(history.plotted()));
  out.put(as_u32(history.columns()));
  out.put(history.spacing_s());
  for (const runtime::FlightHistory::Row& row : history.rows()) out.put(row.time_s);
  for (std::size_t column = 0; column < history.columns(); ++column)
    for (const runtime::FlightHistory::Row& row : history.rows()) out.put(row.values.at(column));
  return out.take();
}

std::string part_frame(std::string_view whole, const Part& part) {
  constexpr std::uint16_t kHeader = 24;
  FrameWriter out(Kind::kPart, part.stream, kHeader, 0, as_u32(part.size));
  out.reserve(kHeader + part.size);
  out.put(as_u32(part.offset));
  out.put(as_u32(whole.size()));
  out.put_bytes(whole.substr(part.offset, part.size));
  return out.take();
}

}  // namespace vigil::console

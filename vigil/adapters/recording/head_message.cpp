#include <cmath>

#include <fmt/format.h>

#include "vigil/adapters/recording/cdr_reader.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/parameter_fields.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/core/ergodic/basis.hpp"

namespace vigil::recording {
namespace {

constexpr std::size_t kParameterBytes = 1024;
constexpr std::size_t kPadNumbers = 5;  ///< of one pad: x, y, station, full_in_s, radius
constexpr double kMostPads = 1e4;

/// Writes what visit_parameters() shows.
struct Put {
  CdrWriter& writer;

  void operator()(double value) { writer.put(value); }
  void operator()(bool value) { writer.put(value); }
  void operator()(const std::optional<double>& value) {
    writer.put(value.has_value());
    writer.put(value.value_or(0.0));
  }
  void count(std::size_t value) { writer.put(std::uint64_t{value}); }
  void index(int value) { writer.put(std::int32_t{value}); }
  void limit(double value) { writer.put(value); }
  void places(const std::vector<Vec2>& values) {
    writer.count(2 * values.size());
    for (const Vec2& place : values)
      for (const double value : {place.x(), place.y()}) writer.put(value);
  }
  void pads(const std::vector<swarm::ChargingPad>& values) {
    writer.count(kPadNumbers * values.size());
    for (const swarm::ChargingPad& pad : values)
      for (const double value :
           {pad.place.x(), pad.place.y(), static_cast<double>(pad.station), pad.full_in_s, pad.radius_m})
        writer.put(value);
  }
  template <class Enum>
  void choice(Enum value, int /*values*/) {
    writer.put(static_cast<std::uint8_t>(value));
  }
};

/// Reads the same.
struct Get {
  CdrReader& reader;

  void operator()(double& value) { value = reader.number(); }
  void operator()(bool& value) { value = reader.flag(); }
  void operator()(std::optional<double>& value) {
    const bool is_set = reader.flag();
    const double number = reader.number();
    value = is_set ? std::optional(number) : std::nullopt;
  }
  void count(std::size_t& value) { value = reader.u64(); }
  void index(int& value) { value = reader.i32(); }
  void limit(double& value) { value = reader.number(); }
  void places(std::vector<Vec2>& values) {
    const std::vector<double> numbers = reader.sequence<double>();
    if (numbers.size() % 2 != 0) throw RecordingError("the mission's message has a place without its y");
    for (std::size_t n = 0; n < numbers.size(); n += 2) values.push_back({numbers[n], numbers[n + 1]});
  }
  void pads(std::vector<swarm::ChargingPad>& values) {
    const std::vector<double> numbers = reader.sequence<double>();
    if (numbers.size() % kPadNumbers != 0) throw RecordingError("the mission's message has a pad that is not whole");
    for (std::size_t n = 0; n < numbers.size(); n += kPadNumbers) {
      const double station = numbers[n + 2];
      if (!(station >= 0.0 && station < kMostPads))
        throw RecordingError("the mission's message has a pad of no station");
      values.push_back({.place = {numbers[n], numbers[n + 1]},
                        .station = static_cast<std::size_t>(station),
                        .full_in_s = numbers[n + 3],
                        .radius_m = numbers[n + 4]});
    }
  }
  template <class Enum>
  void choice(Enum& value, int values) {
    const int code = reader.u8();
    if (code >= values) throw RecordingError("the mission's message names a choice that there is not");
    value = static_cast<Enum>(code);
  }
};

/// Whether all numbers are finite, and none is below zero: every parameter is a length, a time, a rate or a share.
struct Sane {
  bool holds = true;

  void operator()(double value) { holds = holds && std::isfinite(value) && value >= 0.0 && value <= kMost; }
  void operator()(bool /*value*/) {}
  void operator()(const std::optional<double>& value) { (*this)(value.value_or(0.0)); }
  void count(std::size_t value) { holds = holds && value >= 1 && value <= kMostDrones; }
  void index(int value) { holds = holds && value >= 1 && value <= ergodic::Basis::kLargestIndex; }
  void limit(double value) { holds = holds && value >= 0.0; }
  void places(const std::vector<Vec2>& values) {
    for (const Vec2& place : values) holds = holds && place.allFinite();
  }
  void pads(const std::vector<swarm::ChargingPad>& values) {
    holds = holds && static_cast<double>(values.size()) <= kMostPads;
    for (const swarm::ChargingPad& pad : values) {
      holds = holds && pad.place.allFinite() && pad.full_in_s > 0.0 && pad.radius_m > 0.0;
      (*this)(pad.full_in_s);
      (*this)(pad.radius_m);
    }
  }
  template <class Enum>
  void choice(Enum /*value*/, int /*values*/) {}

  static constexpr double kMost = 1e12;
};

/// What the controller's set-up relies on.
void check(const swarm::SwarmParameters& p) {
  Sane sane;
  visit_parameters(sane, p);
  constexpr double kShortestTick = 1e-4;
  const bool is_field = p.field.length_x > 0.0 && p.field.length_y > 0.0;
  const bool is_ticking = p.dt_s >= kShortestTick && p.barrier.dt_s >= kShortestTick;
  const bool is_flying = p.barrier.u_max_m_s > 0.0 && p.barrier.separation_m > 0.0 && p.basis_smoothness > 0.0;
  const bool is_bounded = p.command_delay_s <= swarm::kLongestPredictionS && p.memory_s.value_or(1.0) > 0.0 &&
                          p.look_ahead_s.value_or(1.0) > 0.0;
  const bool has_starts = p.starts.empty() || p.starts.size() == p.drones;
  if (!(sane.holds && has_starts && is_field && is_ticking && is_flying && is_bounded))
    throw RecordingError("the mission's message has parameters that no mission has");
}

void put_matrix(CdrWriter& writer, const ergodic::Coefficients& matrix) {
  writer.put(static_cast<std::uint32_t>(matrix.rows()));
  writer.sequence(std::span<const double>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

ergodic::Coefficients matrix_in(CdrReader& reader) {
  const std::size_t rows = reader.u32();
  const std::vector<double> values = reader.sequence<double>();
  if (rows == 0 ? !values.empty() : values.size() % rows != 0) throw RecordingError("coefficients of no shape");
  if (rows == 0) return {};
  return Eigen::Map<const ergodic::Coefficients>(values.data(), static_cast<Eigen::Index>(rows),
                                                 static_cast<Eigen::Index>(values.size() / rows));
}

void put_past(CdrWriter& writer, const swarm::SwarmPast& past) {
  writer.put(past.ticks);
  writer.put(past.has_first_metric);
  writer.put(past.first_metric);
  writer.put(past.coverage.has_samples);
  writer.put(past.coverage.time_s);
  put_matrix(writer, past.coverage.sum);
  put_matrix(writer, past.coverage.past_averages);
}

swarm::SwarmPast past_in(CdrReader& reader) {
  swarm::SwarmPast past;
  past.ticks = reader.u64();
  past.has_first_metric = reader.flag();
  past.first_metric = reader.number();
  past.coverage.has_samples = reader.flag();
  past.coverage.time_s = reader.number();
  past.coverage.sum = matrix_in(reader);
  past.coverage.past_averages = matrix_in(reader);
  return past;
}

}  // namespace

void write_head(CdrWriter& writer, const runtime::RecordingHead& head) {
  const swarm::SwarmPast past = head.start.past.value_or(swarm::SwarmPast{});
  const auto past_doubles = static_cast<std::size_t>(past.coverage.sum.size() + past.coverage.past_averages.size());
  const std::size_t doubles =
      past_doubles + 2 * head.parameters.starts.size() + kPadNumbers * head.parameters.recharge.pads.size();
  writer.start(head.mission_text.size() + sizeof(double) * doubles + kParameterBytes);
  writer.put(std::string_view(head.mission_text));
  writer.put(head.keep_every);
  Put put{writer};
  visit_parameters(put, head.parameters);
  writer.put(head.start.past.has_value());
  put_past(writer, past);
  writer.seal();
}

runtime::RecordingHead read_head(std::span<const char> message) {
  if (!is_sealed(message)) throw RecordingError("the mission's message is damaged: its seal is another");
  CdrReader reader(message);
  runtime::RecordingHead head;
  head.mission_text = reader.text();
  head.keep_every = reader.u64();
  if (head.keep_every == 0) throw RecordingError("the mission's message keeps every 0th tick");
  Get get{reader};
  visit_parameters(get, head.parameters);
  check(head.parameters);
  head.start.first_intent = head.parameters.first_intent;
  const bool has_past = reader.flag();
  swarm::SwarmPast past = past_in(reader);
  if (has_past) head.start.past = std::move(past);
  return head;
}

}  // namespace vigil::recording

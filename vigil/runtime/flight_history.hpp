#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// What the plots of a flight show over mission time, from its beginning on, in a memory that does not grow with it:
/// where rows become too many, two neighbours become one, which keeps what matters of both. A value; one thread at a
/// time.
class FlightHistory {
 public:
  static constexpr std::size_t kMostRows = 1024;
  static constexpr std::size_t kMostPlotted = 6;  ///< swarms up to this size are shown drone by drone
  static constexpr double kSpacingS = 0.1;        ///< between two moments that are taken in
  static constexpr std::size_t kOfSwarm = 5;
  static constexpr std::size_t kMostColumns = kOfSwarm + kMostPlotted + kMostPlotted * (kMostPlotted - 1) / 2;

  /// What was so since begin_s; the last moment of it is time_s. Columns: metric (percent of its first value, at
  /// time_s); the greatest of the worst age of an area (s); the least distance of two drones in the air (m); the least
  /// number of active drones; the greatest speed that was asked of a drone (m/s); then, of plotted() drones, the
  /// greatest speed that was asked of each, and the least distance of each pair in the air, 1-2, 1-3, ..., 2-3, ...
  /// NaN: there was none.
  struct Row {
    double begin_s = 0.0;
    double time_s = 0.0;
    std::array<float, kMostColumns> values{};
  };

  explicit FlightHistory(std::size_t drones);

  /// Whether a moment is late enough after the last one.
  [[nodiscard]] bool is_due(double time_s) const noexcept;
  /// Takes a moment in where it is due. Precondition: as many drones as there are here.
  void add(const swarm::Snapshot& snapshot, double worst_age_s);

  /// The same up to a moment.
  [[nodiscard]] FlightHistory until(double time_s) const;

  [[nodiscard]] std::span<const Row> rows() const noexcept { return rows_; }  ///< oldest first
  [[nodiscard]] double spacing_s() const noexcept { return spacing_s_; }      ///< what a row stands for, at least
  [[nodiscard]] std::size_t plotted() const noexcept { return plotted_; }     ///< drones that have columns of their own
  [[nodiscard]] std::size_t columns() const noexcept;

 private:
  [[nodiscard]] Row row_of(const swarm::Snapshot& snapshot, double worst_age_s) const;
  void merge(Row& into, const Row& later) const noexcept;
  void halve();

  std::size_t plotted_;
  double spacing_s_ = kSpacingS;
  std::vector<Row> rows_;
};

}  // namespace vigil::runtime

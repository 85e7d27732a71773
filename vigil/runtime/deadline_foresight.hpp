#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vigil/runtime/event_words.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/preview.hpp"

namespace vigil::runtime {

/// Which areas will miss their deadlines with the drones that there are, and by how much: when to look ahead for that,
/// and what to tell of it. A value. One thread at a time.
class DeadlineForesight {
 public:
  /// From now on these targets are meant.
  void retarget(const Mission& mission);

  /// Whether it is time to look ahead: where something has a deadline, other targets are meant, other drones cover
  /// than before, or a while has passed since. Asked for again only then.
  [[nodiscard]] bool is_due(std::size_t active, double time_s);
  /// So far ahead: longer than the longest deadline, so that one that will be missed shows.
  [[nodiscard]] double horizon_s() const { return horizon_s_; }

  /// Takes in what was seen ahead with `active` of `drones` covering. What people should be told: that other areas will
  /// be late than was told before, or that none will be.
  [[nodiscard]] std::optional<EventWords> take(std::span<const AreaOutlook> areas, std::size_t active,
                                               std::size_t drones);
  /// The longest that a part of an area will be unseen; none: not known.
  [[nodiscard]] std::optional<double> foreseen_s(const TargetName& what) const;

  /// A second look is worth it after so long, mission time, where nothing has changed.
  static constexpr double kEveryS = 30.0;
  /// Drones come and go: they are counted when they have stayed so long.
  static constexpr double kSettlesInS = 3.0;
  /// An outlook errs by about a fifth: only what is later than this share of its deadline is told.
  static constexpr double kWorthTelling = 1.2;

 private:
  double horizon_s_ = 0.0;  ///< 0: nothing has a deadline
  bool has_protected_ = false;
  bool is_new_ = false;
  std::size_t active_ = 0;  ///< that cover, since changed_at_s_
  double changed_at_s_ = 0.0;
  std::size_t looked_with_ = 0;
  double looked_at_s_ = 0.0;
  std::vector<AreaOutlook> foreseen_;
  std::vector<TargetName> told_;  ///< late, as people know
};

}  // namespace vigil::runtime

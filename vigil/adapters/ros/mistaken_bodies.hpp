#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"

namespace vigil::ros_bridge {

/// One drone, as far as a tracker's names are concerned. World frame, metres.
struct NamedBody {
  bool is_known = false;   ///< it has been seen: `expected` means something
  bool is_timely = false;  ///< the newest position under its name is worth a look
  bool is_airborne = false;
  double unseen_s = 0.0;  ///< since one of its positions was last believed
  Point expected;         ///< where its flight has led it by the time of the newest position
  Point seen;             ///< the newest position under its name, believed or not
};

/// Which drones a tracker takes for another one. A position is like another drone's where it lies nearer to the place
/// at which that one is expected than to its own drone's, by more than trackers and predictions err. It is another's
///
/// - where that one's newest position is like this drone's: the two have swapped names,
/// - or where that one was believed a moment ago to be right there: two bodies are never in one place. So it is while
///   only one of two new names has arrived, while one of the bodies has no name at all, or where more than two go
///   round,
///
/// and from then on for as long as it is like it. Of two on the ground only the first is asked, and only where both
/// were believed a tenth of a second ago: they may be carried anywhere, but not as fast. A value; judge() allocates
/// nothing.
class MistakenBodies {
 public:
  explicit MistakenBodies(std::size_t drones) : taken_for_(drones) {}

  /// Takes in all drones, before the newest positions are believed.
  /// Precondition: bodies.size() is that of the constructor.
  void judge(std::span<const NamedBody> bodies) noexcept;

  /// The drone whose body goes by this one's name; nothing where the name is right as far as is known.
  [[nodiscard]] std::optional<std::size_t> taken_for(std::size_t drone) const noexcept { return taken_for_[drone]; }

 private:
  [[nodiscard]] static std::optional<std::size_t> whose(std::span<const NamedBody> bodies, std::size_t drone) noexcept;

  std::vector<std::optional<std::size_t>> taken_for_;
};

}  // namespace vigil::ros_bridge

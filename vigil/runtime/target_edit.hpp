#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vigil/runtime/mission_targets.hpp"

/// How operators change where to look, piece by piece. Points are in the world frame, as in mission files.
namespace vigil::runtime {

enum class TargetKind : std::uint8_t { kCluster, kArea, kNoFly };

/// "cluster", "area", "no_fly"
[[nodiscard]] std::string_view name_of(TargetKind kind);
[[nodiscard]] std::optional<TargetKind> target_kind_of(std::string_view word);

/// An entry of either list, by its name.
struct TargetName {
  TargetKind kind = TargetKind::kCluster;
  std::string name;
  friend auto operator<=>(const TargetName&, const TargetName&) = default;
};

using TargetEntry = std::variant<ClusterEntry, AreaEntry, NoFlyEntry>;

struct AddEntry {
  TargetEntry entry;
};
struct ReplaceEntry {
  TargetName what;
  TargetEntry entry;  ///< of the same kind
};
struct RemoveEntry {
  TargetName what;
};
struct RenameEntry {
  TargetName what;
  std::string to;
};
struct AddPoint {
  TargetName what;  ///< a cluster that is not there is made
  Vec2 point_m = Vec2::Zero();
  std::optional<std::size_t> index;  ///< before which; none: at the end
};
struct MovePoint {
  TargetName what;
  std::size_t index = 0;
  Vec2 point_m = Vec2::Zero();
};
struct RemovePoint {
  TargetName what;  ///< a cluster goes with its last point
  std::size_t index = 0;
};
struct SetWeight {
  TargetName what;
  double weight = 1.0;
};
struct SetRevisit {
  TargetName what;
  std::optional<double> revisit_s;
};
struct SetProtect {
  TargetName what;
  bool is_protected = false;
};
struct SetSoftEdge {
  TargetName what;
  double soft_edge_m = 0.0;
};
struct SetUniformFloor {
  double uniform_floor = 0.0;
};

using TargetEdit = std::variant<AddEntry, ReplaceEntry, RemoveEntry, RenameEntry, AddPoint, MovePoint, RemovePoint,
                                SetWeight, SetRevisit, SetProtect, SetSoftEdge, SetUniformFloor>;

/// Changes `targets` as `edit` says. What cannot be done, because it is not there, is said in words, and nothing is
/// changed; empty: done. The result may still be refused by the rules of mission files.
[[nodiscard]] std::string apply(MissionTargets& targets, const TargetEdit& edit);

/// The entries that `edit` reads or changes.
[[nodiscard]] std::vector<TargetName> touched_by(const TargetEdit& edit);

/// "east: weight 2"
[[nodiscard]] std::string in_words(const TargetEdit& edit);

/// The edit that an event of a mission file stands for. Precondition: edits_targets(event.what).
[[nodiscard]] TargetEdit edit_of(const MissionTargets& targets, const EventEntry& event);

}  // namespace vigil::runtime

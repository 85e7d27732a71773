#include "vigil/runtime/target_edit.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

constexpr std::array<std::string_view, 3> kKindWords{"cluster", "area", "no_fly"};
constexpr std::array<std::string_view, 3> kKindSpoken{"cluster", "area", "no-fly polygon"};

template <typename Entries>
auto* find_named(Entries& entries, const std::string& name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

TargetKind kind_of(const TargetEntry& entry) { return static_cast<TargetKind>(entry.index()); }
static_assert(std::is_same_v<std::variant_alternative_t<2, TargetEntry>, NoFlyEntry>);

const std::string& name_in(const TargetEntry& entry) {
  return std::visit([](const auto& one) -> const std::string& { return one.name; }, entry);
}

std::string is_not_there(const TargetName& what) {
  return fmt::format("there is no {} {}", kKindSpoken.at(static_cast<std::size_t>(what.kind)), what.name);
}

/// Calls `work` with the entry of that name, whatever its kind; says so where there is none.
template <typename Work>
std::string with_entry(MissionTargets& targets, const TargetName& what, const Work& work) {
  const auto on = [&](auto* entry) { return entry == nullptr ? is_not_there(what) : work(*entry); };
  switch (what.kind) {
    case TargetKind::kCluster:
      return on(find_named(targets.targets.clusters, what.name));
    case TargetKind::kArea:
      return on(find_named(targets.targets.areas, what.name));
    case TargetKind::kNoFly:
      break;
  }
  return on(find_named(targets.no_fly, what.name));
}

std::vector<Vec2>& points_of(ClusterEntry& entry) { return entry.points_m; }
std::vector<Vec2>& points_of(AreaEntry& entry) { return entry.outline_m; }
std::vector<Vec2>& points_of(NoFlyEntry& entry) { return entry.outline_m; }

template <typename Entries>
void erase_named(Entries& entries, const std::string& name) {
  std::erase_if(entries, [&](const auto& entry) { return entry.name == name; });
}

void erase(MissionTargets& targets, const TargetName& what) {
  if (what.kind == TargetKind::kCluster) erase_named(targets.targets.clusters, what.name);
  if (what.kind == TargetKind::kArea) erase_named(targets.targets.areas, what.name);
  if (what.kind == TargetKind::kNoFly) erase_named(targets.no_fly, what.name);
}

std::string has_no_point(const TargetName& what, std::size_t index, std::size_t size) {
  return fmt::format("{} has no point {}; its {} points count from 0", what.name, index, size);
}

struct Apply {
  MissionTargets& targets;

  std::string operator()(const AddEntry& edit) const {
    add(edit.entry);
    return {};  // a name that is taken is refused by the rules of mission files
  }
  std::string operator()(const ReplaceEntry& edit) const {
    if (kind_of(edit.entry) != edit.what.kind) return fmt::format("{} is of another kind", edit.what.name);
    return with_entry(targets, edit.what, [&](auto& entry) {
      entry = std::get<std::remove_reference_t<decltype(entry)>>(edit.entry);
      return std::string();
    });
  }
  std::string operator()(const RemoveEntry& edit) const {
    std::string missing = with_entry(targets, edit.what, [](auto&) { return std::string(); });
    if (missing.empty()) erase(targets, edit.what);
    return missing;
  }
  std::string operator()(const RenameEntry& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      entry.name = edit.to;
      return std::string();
    });
  }
  std::string operator()(const AddPoint& edit) const {
    if (edit.what.kind == TargetKind::kCluster && find_named(targets.targets.clusters, edit.what.name) == nullptr)
      targets.targets.clusters.push_back({.name = edit.what.name, .points_m = {}});
    return with_entry(targets, edit.what, [&](auto& entry) {
      std::vector<Vec2>& points = points_of(entry);
      const std::size_t index = edit.index.value_or(points.size());
      if (index > points.size()) return has_no_point(edit.what, index, points.size());
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(index), edit.point_m);
      return std::string();
    });
  }
  std::string operator()(const MovePoint& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      std::vector<Vec2>& points = points_of(entry);
      if (edit.index >= points.size()) return has_no_point(edit.what, edit.index, points.size());
      points[edit.index] = edit.point_m;
      return std::string();
    });
  }
  std::string operator()(const RemovePoint& edit) const {
    bool is_last = false;
    std::string problem = with_entry(targets, edit.what, [&](auto& entry) {
      std::vector<Vec2>& points = points_of(entry);
      if (edit.index >= points.size()) return has_no_point(edit.what, edit.index, points.size());
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(edit.index));
      is_last = points.empty();
      return std::string();
    });
    if (is_last && edit.what.kind == TargetKind::kCluster) erase(targets, edit.what);
    return problem;
  }
  std::string operator()(const SetWeight& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      if constexpr (requires { entry.weight; })
        entry.weight = edit.weight;
      else
        return fmt::format("{} has no weight", edit.what.name);
      return std::string();
    });
  }
  std::string operator()(const SetRevisit& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      if constexpr (requires { entry.revisit_s; })
        entry.revisit_s = edit.revisit_s;
      else
        return fmt::format("{} has no deadline", edit.what.name);
      return std::string();
    });
  }
  std::string operator()(const SetProtect& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      if constexpr (requires { entry.is_protected; })
        entry.is_protected = edit.is_protected;
      else
        return fmt::format("{} is watched by nobody", edit.what.name);
      return std::string();
    });
  }
  std::string operator()(const SetSoftEdge& edit) const {
    return with_entry(targets, edit.what, [&](auto& entry) {
      if constexpr (requires { entry.soft_edge_m; })
        entry.soft_edge_m = edit.soft_edge_m;
      else
        return fmt::format("{} has no soft edge", edit.what.name);
      return std::string();
    });
  }
  std::string operator()(const SetUniformFloor& edit) const {
    targets.targets.uniform_floor = edit.uniform_floor;
    return {};
  }

  void add(const TargetEntry& entry) const {
    if (const auto* cluster = std::get_if<ClusterEntry>(&entry)) targets.targets.clusters.push_back(*cluster);
    if (const auto* area = std::get_if<AreaEntry>(&entry)) targets.targets.areas.push_back(*area);
    if (const auto* no_fly = std::get_if<NoFlyEntry>(&entry)) targets.no_fly.push_back(*no_fly);
  }
};

struct InWords {
  std::string operator()(const AddEntry& edit) const {
    return fmt::format("{}: new {}", name_in(edit.entry), kKindSpoken.at(edit.entry.index()));
  }
  std::string operator()(const ReplaceEntry& edit) const { return fmt::format("{}: redrawn", edit.what.name); }
  std::string operator()(const RemoveEntry& edit) const { return fmt::format("{}: removed", edit.what.name); }
  std::string operator()(const RenameEntry& edit) const { return fmt::format("{}: now {}", edit.what.name, edit.to); }
  std::string operator()(const AddPoint& edit) const {
    return fmt::format("{}: new point at ({:.6g}, {:.6g}) m", edit.what.name, edit.point_m.x(), edit.point_m.y());
  }
  std::string operator()(const MovePoint& edit) const {
    return fmt::format("{}: point {} to ({:.6g}, {:.6g}) m", edit.what.name, edit.index + 1, edit.point_m.x(),
                       edit.point_m.y());
  }
  std::string operator()(const RemovePoint& edit) const {
    return fmt::format("{}: point {} removed", edit.what.name, edit.index + 1);
  }
  std::string operator()(const SetWeight& edit) const {
    return fmt::format("{}: weight {:.6g}", edit.what.name, edit.weight);
  }
  std::string operator()(const SetRevisit& edit) const {
    if (!edit.revisit_s) return fmt::format("{}: no deadline", edit.what.name);
    return fmt::format("{}: deadline {:.6g} s", edit.what.name, *edit.revisit_s);
  }
  std::string operator()(const SetProtect& edit) const {
    return fmt::format("{}: {}", edit.what.name, edit.is_protected ? "protected" : "no longer protected");
  }
  std::string operator()(const SetSoftEdge& edit) const {
    return fmt::format("{}: soft edge {:.6g} m", edit.what.name, edit.soft_edge_m);
  }
  std::string operator()(const SetUniformFloor& edit) const {
    return fmt::format("{:.6g} of all attention spread evenly", edit.uniform_floor);
  }
};

}  // namespace

std::string_view name_of(TargetKind kind) { return kKindWords.at(static_cast<std::size_t>(kind)); }

std::optional<TargetKind> target_kind_of(std::string_view word) {
  const auto* const found = std::find(kKindWords.begin(), kKindWords.end(), word);
  if (found == kKindWords.end()) return std::nullopt;
  return static_cast<TargetKind>(found - kKindWords.begin());
}

std::string apply(MissionTargets& targets, const TargetEdit& edit) { return std::visit(Apply{targets}, edit); }

std::vector<TargetName> touched_by(const TargetEdit& edit) {
  return std::visit(
      [](const auto& one) -> std::vector<TargetName> {
        if constexpr (requires { one.to; }) return {one.what, {one.what.kind, one.to}};
        if constexpr (requires {
                        one.what;
                        one.entry;
                      })
          return {one.what, {one.what.kind, name_in(one.entry)}};
        else if constexpr (requires { one.what; })
          return {one.what};
        else if constexpr (requires { one.entry; })
          return {{kind_of(one.entry), name_in(one.entry)}};
        else
          return {};
      },
      edit);
}

std::string in_words(const TargetEdit& edit) { return std::visit(InWords{}, edit); }

TargetEdit edit_of(const MissionTargets& targets, const EventEntry& event) {
  const bool is_area = std::any_of(targets.targets.areas.begin(), targets.targets.areas.end(),
                                   [&](const AreaEntry& area) { return area.name == event.cluster; });
  const TargetName cluster{TargetKind::kCluster, event.cluster};
  const auto index = static_cast<std::size_t>(std::max(event.target, 1) - 1);  // people count from 1
  switch (event.what) {
    case EventKind::kAddTarget:
      return AddPoint{cluster, event.point_m, std::nullopt};
    case EventKind::kMoveTarget:
      return MovePoint{cluster, index, event.point_m};
    case EventKind::kRemoveTarget:
      return RemovePoint{cluster, index};
    default:
      break;
  }
  return SetWeight{{is_area ? TargetKind::kArea : TargetKind::kCluster, event.cluster}, event.weight};
}

}  // namespace vigil::runtime

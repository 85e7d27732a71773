#include "vigil/runtime/mission_desk.hpp"

#include <utility>

#include <fmt/format.h>

#include "vigil/runtime/mission_checks.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_reader.hpp"
#include "vigil/runtime/mission_source.hpp"
#include "vigil/runtime/mission_writer.hpp"

namespace vigil::runtime {
namespace {

/// So many points may all undo steps together hold.
constexpr std::size_t kMostHistoryPoints = 500'000;
/// So many entries' last changes are remembered.
constexpr std::size_t kMostChangedNames = 10'000;

std::size_t size_of(const MissionTargets& targets) {
  std::size_t points = 1;
  for (const ClusterEntry& entry : targets.targets.clusters) points += entry.points_m.size();
  for (const AreaEntry& entry : targets.targets.areas) points += entry.outline_m.size();
  for (const NoFlyEntry& entry : targets.no_fly) points += entry.outline_m.size();
  return points;
}

MissionTargets targets_of(const Mission& mission) { return {mission.targets, mission.no_fly}; }

std::string in_words(std::span<const TargetEdit> edits) {
  if (edits.size() == 1) return in_words(edits.front());
  return fmt::format("{} changes: {}, ...", edits.size(), in_words(edits.front()));
}

/// "targets.areas[1].outline_m of ridge": whoever looks at a map knows names, not numbers.
std::string place_in_words(const std::string& key, const Mission& mission) {
  const auto named = [&](std::string_view list, const auto& entries) -> std::string {
    if (!key.starts_with(list)) return {};
    const std::size_t index = std::strtoul(key.c_str() + list.size(), nullptr, 10);
    return index < entries.size() ? fmt::format("{} of {}", key, entries[index].name) : std::string();
  };
  for (const std::string& words : {named("targets.clusters[", mission.targets.clusters),
                                   named("targets.areas[", mission.targets.areas), named("no_fly[", mission.no_fly)})
    if (!words.empty()) return words;
  return key;
}

std::string reason_of(const MissionFault& fault, const Mission& mission) {
  constexpr std::size_t kMostBytes = 600;
  std::string reason = place_in_words(fault.key, mission);
  if (!fault.key.empty() && !fault.value.empty()) reason += " = ";
  reason += fault.value;
  std::string_view separator = reason.empty() ? "" : ": ";
  for (const std::string* part : {&fault.problem, &fault.valid, &fault.advice}) {
    if (part->empty()) continue;
    reason += separator;
    reason += *part;
    separator = "; ";
  }
  return on_one_line(reason, kMostBytes);
}

}  // namespace

std::optional<Refusal> check_targets(const Mission& mission) {
  Mission shown = mission;
  // The rules for targets look at nothing else; events were checked against the targets of the beginning.
  shown.simulation.events.clear();
  shown.drone_grid.reset();
  shown.drones.resize(1);
  try {
    const MissionSource source(mission_yaml(shown), "the change", {});
    check_places(read_mission(source), source);
  } catch (const MissionError& error) {
    return Refusal{Refusal::Code::kInvalid, reason_of(error.fault(), mission)};
  }
  return std::nullopt;
}

MissionDesk::MissionDesk(Mission mission, std::uint64_t revision, std::string by)
    : mission_(std::move(mission)), revision_(revision), by_(std::move(by)), all_changed_at_(revision) {}

bool MissionDesk::is_stale(std::span<const TargetEdit> edits, std::uint64_t based_on) const {
  if (based_on < all_changed_at_) return true;
  for (const TargetEdit& edit : edits) {
    for (const TargetName& name : touched_by(edit)) {
      const auto found = changed_at_.find(name);
      if (found != changed_at_.end() && found->second > based_on) return true;
    }
  }
  return false;
}

std::variant<Mission, Refusal> MissionDesk::draft(std::span<const TargetEdit> edits, std::uint64_t based_on) const {
  if (edits.empty() || edits.size() > kMostEdits)
    return Refusal{
        Refusal::Code::kInvalid,
        fmt::format("edits: has {} entries; must have 1 to {}; make smaller changes", edits.size(), kMostEdits)};
  if (based_on > revision_)
    return Refusal{Refusal::Code::kStale,
                   fmt::format("based_on: there is no revision {}; the newest is {}; look at that and change it again",
                               based_on, revision_)};
  if (is_stale(edits, based_on))
    return Refusal{
        Refusal::Code::kStale,
        fmt::format("{} changed it since revision {}: {}; look at it and change it again", by_, based_on, what_)};
  MissionTargets targets = targets_of(mission_);
  for (std::size_t n = 0; n < edits.size(); ++n) {
    const std::string problem = apply(targets, edits[n]);
    if (!problem.empty())
      return Refusal{Refusal::Code::kInvalid, fmt::format("edits[{}]: {}", n, on_one_line(problem, 200))};
  }
  Mission drafted = mission_;
  drafted.targets = std::move(targets.targets);
  drafted.no_fly = std::move(targets.no_fly);
  if (std::optional<Refusal> refusal = check_targets(drafted)) return *std::move(refusal);
  return drafted;
}

std::optional<Refusal> MissionDesk::edit(std::span<const TargetEdit> edits, std::uint64_t based_on,
                                         const std::string& by) {
  std::variant<Mission, Refusal> result = draft(edits, based_on);
  if (auto* refusal = std::get_if<Refusal>(&result)) return std::move(*refusal);
  undo_.push_back({in_words(edits), targets_of(mission_)});
  redo_.clear();
  shorten_history();
  commit(targets_of(std::get<Mission>(result)), in_words(edits), by);
  note_changes(edits);
  return std::nullopt;
}

void MissionDesk::commit(MissionTargets targets, std::string what, const std::string& by) {
  mission_.targets = std::move(targets.targets);
  mission_.no_fly = std::move(targets.no_fly);
  ++revision_;
  what_ = std::move(what);
  by_ = by;
}

void MissionDesk::note_changes(std::span<const TargetEdit> edits) {
  for (const TargetEdit& edit : edits)
    for (TargetName& name : touched_by(edit)) changed_at_[std::move(name)] = revision_;
  if (changed_at_.size() <= kMostChangedNames) return;
  changed_at_.clear();
  all_changed_at_ = revision_;
}

void MissionDesk::shorten_history() {
  std::size_t points = 0;
  for (const Step& step : undo_) points += size_of(step.targets);
  while (undo_.size() > kMostUndo || (points > kMostHistoryPoints && undo_.size() > 1)) {
    points -= size_of(undo_.front().targets);
    undo_.pop_front();
  }
}

std::optional<Refusal> MissionDesk::undo(const std::string& by) {
  if (undo_.empty()) return Refusal{Refusal::Code::kNotNow, "nothing was changed that could be undone"};
  Step step = std::move(undo_.back());
  undo_.pop_back();
  redo_.push_back({step.what, targets_of(mission_)});
  commit(std::move(step.targets), "undone: " + step.what, by);
  all_changed_at_ = revision_;
  return std::nullopt;
}

std::optional<Refusal> MissionDesk::redo(const std::string& by) {
  if (redo_.empty()) return Refusal{Refusal::Code::kNotNow, "nothing was undone that could be done again"};
  Step step = std::move(redo_.back());
  redo_.pop_back();
  undo_.push_back({step.what, targets_of(mission_)});
  commit(std::move(step.targets), step.what, by);
  all_changed_at_ = revision_;
  return std::nullopt;
}

}  // namespace vigil::runtime

#include "vigil/runtime/mission_desk.hpp"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
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

std::string in_words(std::span<const TargetEdit> edits) {
  if (edits.size() == 1) return in_words(edits.front());
  constexpr std::size_t kMostTold = 20;
  std::string words = fmt::format("{} changes", edits.size());
  const char* before = ": ";
  for (const TargetEdit& edit : edits.first(std::min(edits.size(), kMostTold))) {
    words += before + in_words(edit);
    before = "; ";
  }
  return edits.size() > kMostTold ? words + "; ..." : words;
}

/// "outline_m[2]" is corner 3, "revisit_s" the deadline.
std::string member_in_words(std::string_view member) {
  struct Word {
    std::string_view key, whole, one;
  };
  constexpr std::array<Word, 5> kWords{{{"points_m", "points", "point"},
                                        {"outline_m", "outline", "corner"},
                                        {"soft_edge_m", "soft edge", ""},
                                        {"revisit_s", "deadline", ""},
                                        {"uniform_floor", "share that is spread evenly", ""}}};
  for (const Word& word : kWords) {
    if (!member.starts_with(word.key)) continue;
    const std::string_view rest = member.substr(word.key.size());
    if (!rest.starts_with('[')) return std::string(word.whole);
    const std::string index(rest.substr(1));
    return fmt::format("{} {}", word.one, std::strtoul(index.c_str(), nullptr, 10) + 1);
  }
  return std::string(member);
}

/// "area ridge, corner 3" of "targets.areas[1].outline_m[2]": whoever looks at a map knows names, not a file's keys.
std::string place_in_words(const std::string& key, const Mission& mission) {
  const auto named = [&](std::string_view list, std::string_view kind, const auto& entries) -> std::string {
    if (!key.starts_with(list)) return {};
    const std::size_t index = std::strtoul(key.c_str() + list.size(), nullptr, 10);
    if (index >= entries.size()) return {};
    const std::size_t dot = key.find('.', list.size());
    if (dot == std::string::npos) return fmt::format("{} {}", kind, entries[index].name);
    return fmt::format("{} {}, {}", kind, entries[index].name, member_in_words(std::string_view(key).substr(dot + 1)));
  };
  for (const std::string& words :
       {named("targets.clusters[", "cluster", mission.targets.clusters),
        named("targets.areas[", "area", mission.targets.areas), named("no_fly[", "no-fly polygon", mission.no_fly)})
    if (!words.empty()) return words;
  return key.starts_with("targets.") ? member_in_words(std::string_view(key).substr(8)) : key;
}

/// Without what only the author of a mission file can look up or do.
std::string for_operators(std::string text) {
  for (const std::string_view part : {" at field.origin_m", ", or take `outside_field: clamp` in targets"}) {
    const std::size_t at = text.find(part);
    if (at != std::string::npos) text.erase(at, part.size());
  }
  return text;
}

std::string reason_of(const MissionFault& fault, const Mission& mission) {
  constexpr std::size_t kMostBytes = 600;
  std::string reason = place_in_words(fault.key, mission);
  // A list of points says nothing that the map does not show better.
  const bool is_shown = !fault.value.empty() && !fault.value.starts_with("[[") && fault.value != "[]";
  if (is_shown) reason += (reason.empty() ? "" : " = ") + fault.value;
  std::string_view separator = reason.empty() ? "" : ": ";
  for (const std::string* part : {&fault.problem, &fault.valid, &fault.advice}) {
    if (part->empty()) continue;
    reason += separator;
    reason += for_operators(*part);
    separator = "; ";
  }
  return on_one_line(reason, kMostBytes);
}

/// For people, also where a desk has just begun and knows of none.
std::string last_change(const std::string& what) { return what.empty() ? "all targets" : what; }

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
    return Refusal{Refusal::Code::kStale,
                   fmt::format("{} changed it since revision {}: {}; look at it and change it again", by_, based_on,
                               last_change(what_))};
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

Refusal MissionDesk::changed_since() const {
  return {Refusal::Code::kStale,
          fmt::format("{} changed the targets meanwhile ({}); look at that, then try again", by_, last_change(what_))};
}

std::optional<Refusal> MissionDesk::undo(std::uint64_t based_on, const std::string& by) {
  if (based_on != revision_) return changed_since();
  if (undo_.empty()) return Refusal{Refusal::Code::kNotNow, "nothing was changed that could be undone"};
  Step step = std::move(undo_.back());
  undo_.pop_back();
  redo_.push_back({step.what, targets_of(mission_)});
  commit(std::move(step.targets), "undone: " + step.what, by);
  all_changed_at_ = revision_;
  return std::nullopt;
}

std::optional<Refusal> MissionDesk::redo(std::uint64_t based_on, const std::string& by) {
  if (based_on != revision_) return changed_since();
  if (redo_.empty()) return Refusal{Refusal::Code::kNotNow, "nothing was undone that could be done again"};
  Step step = std::move(redo_.back());
  redo_.pop_back();
  undo_.push_back({step.what, targets_of(mission_)});
  commit(std::move(step.targets), step.what, by);
  all_changed_at_ = revision_;
  return std::nullopt;
}

}  // namespace vigil::runtime

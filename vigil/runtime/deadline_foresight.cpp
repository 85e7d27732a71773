#include "vigil/runtime/deadline_foresight.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

constexpr std::size_t kMostNamed = 5;

bool is_late(const AreaOutlook& area) {
  return area.deadline_s && area.worst_age_s > DeadlineForesight::kWorthTelling * *area.deadline_s;
}

std::string lateness(const AreaOutlook& area) {
  return fmt::format("{} unseen for up to {:.0f} s, {:.0f} s beyond its deadline", area.what.name, area.worst_age_s,
                     area.worst_age_s - *area.deadline_s);
}

/// The worst first, relative to their deadlines.
std::vector<AreaOutlook> late_ones(std::span<const AreaOutlook> areas) {
  std::vector<AreaOutlook> late;
  std::ranges::copy_if(areas, std::back_inserter(late), is_late);
  std::ranges::stable_sort(late, std::greater{},
                           [](const AreaOutlook& area) { return area.worst_age_s / *area.deadline_s; });
  return late;
}

std::string list(std::span<const AreaOutlook> late) {
  std::string text;
  for (const AreaOutlook& area : late.first(std::min(late.size(), kMostNamed)))
    text += (text.empty() ? "" : "; ") + lateness(area);
  return late.size() > kMostNamed ? fmt::format("{}; and {} more", text, late.size() - kMostNamed) : text;
}

}  // namespace

void DeadlineForesight::retarget(const Mission& mission) {
  double longest_s = 0.0;
  has_protected_ = false;
  const auto take_in = [&](const auto& entries) {
    for (const auto& entry : entries) {
      longest_s = std::max(longest_s, entry.revisit_s.value_or(0.0));
      has_protected_ = has_protected_ || entry.is_protected;
    }
  };
  take_in(mission.targets.clusters);
  take_in(mission.targets.areas);
  constexpr double kDeadlines = 2.0;
  constexpr double kLeastS = 60.0;
  horizon_s_ = longest_s > 0.0 ? std::clamp(kDeadlines * longest_s, kLeastS, kLongestPreviewS) : 0.0;
  foreseen_.clear();
  is_new_ = true;
}

bool DeadlineForesight::is_due(std::size_t active, double time_s) {
  if (active != active_) changed_at_s_ = time_s;
  active_ = active;
  const bool has_settled = time_s - changed_at_s_ >= kSettlesInS;
  const bool is_old = time_s - looked_at_s_ >= kEveryS || time_s < looked_at_s_;
  if (horizon_s_ == 0.0 || active == 0 || !has_settled) return false;
  if (!is_new_ && active == looked_with_ && !is_old) return false;
  is_new_ = false;
  looked_with_ = active;
  looked_at_s_ = time_s;
  return true;
}

std::optional<EventWords> DeadlineForesight::take(std::span<const AreaOutlook> areas, std::size_t active,
                                                  std::size_t drones) {
  foreseen_.assign(areas.begin(), areas.end());
  const std::vector<AreaOutlook> late = late_ones(areas);
  std::vector<TargetName> names;
  for (const AreaOutlook& area : late) names.push_back(area.what);
  std::ranges::sort(names);
  if (names == told_) return std::nullopt;
  told_ = std::move(names);
  if (late.empty())
    return EventWords{Severity::kInfo, fmt::format("with {} of {} drones all deadlines will be kept", active, drones),
                      "", ""};
  return EventWords{Severity::kWarning, fmt::format("with {} of {} drones: {}", active, drones, list(late)),
                    has_protected_ ? "protected areas keep their drones, the others share what is left"
                                   : "all areas get less in proportion to their weights",
                    "protect the areas that matter most, give them more weight, or bring drones back"};
}

std::optional<double> DeadlineForesight::foreseen_s(const TargetName& what) const {
  const auto found = std::ranges::find(foreseen_, what, &AreaOutlook::what);
  return found == foreseen_.end() ? std::nullopt : std::optional(found->worst_age_s);
}

}  // namespace vigil::runtime

#include "vigil/adapters/console/recorded_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "vigil/swarm/names.hpp"

namespace vigil::console {
namespace {

using runtime::EventWords;
using runtime::Severity;

/// What the words for a drone's activity say beside who it is does not depend on more than that.
EventWords words_of_activity(const std::string& drone, swarm::Activity activity) {
  EventWords words = runtime::words_for(drone, activity, {}, 0, 0);
  words.effect.clear();  // how many covered then, the recording's event does not say
  words.next.clear();    // nobody can do it any more
  if (activity == swarm::Activity::kBatteryLow) words.text = fmt::format("{}: battery low", drone);
  return words;
}

Severity severity_of(const std::string& what) {
  constexpr std::array<std::string_view, 3> kAlarms{"emergency_stop", "overdue", "recording"};
  constexpr std::array<std::string_view, 2> kWarnings{"trouble", "restored"};
  if (std::ranges::find(kAlarms, what) != kAlarms.end()) return Severity::kAlarm;
  return std::ranges::find(kWarnings, what) != kWarnings.end() ? Severity::kWarning : Severity::kInfo;
}

EventWords words_of(const runtime::LoggedEvent& event) {
  const auto activity = swarm::value_of<swarm::Activity>(event.what);
  if (event.source == "swarm" && activity && !event.drone.empty()) return words_of_activity(event.drone, *activity);
  const Severity severity = severity_of(event.what);
  if (event.source == "operator" || event.source == "program") return {severity, event.detail, "", ""};
  std::string text = event.source + ": " + event.what;
  if (!event.drone.empty()) text += " " + event.drone;
  if (!event.detail.empty()) text += " (" + event.detail + ")";
  return {severity, text, "", ""};
}

}  // namespace

ConsoleEvent recorded_event(const runtime::LoggedEvent& event, std::uint64_t number, double dt_s) {
  return {.number = number,
          .tick = static_cast<std::uint64_t>(std::llround(std::max(event.time_s, 0.0) / dt_s)),
          .time_s = event.time_s,
          .source = event.source,
          .what = event.what,
          .drone = event.drone,
          .words = words_of(event)};
}

}  // namespace vigil::console

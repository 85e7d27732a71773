#include "vigil/adapters/console/preview_json.hpp"

#include <cmath>

#include "vigil/adapters/console/shown_drones.hpp"

namespace vigil::console {
namespace {

/// Rounded: nobody foresees a tenth of a millimetre, and it would triple the message.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

Json or_null(const std::optional<double>& value) { return value ? Json(rounded(*value)) : Json(nullptr); }

Json area_json(const runtime::AreaOutlook& area) {
  return {{"kind", runtime::name_of(area.what.kind)},
          {"name", area.what.name},
          {"asked", area.asked},
          {"achieved", area.achieved},
          {"covered_in_s", or_null(area.covered_in_s)},
          {"seen_in_s", or_null(area.seen_in_s)},
          {"worst_age_s", rounded(area.worst_age_s)},
          {"deadline_s", or_null(area.deadline_s)}};
}

Json outlook_json(const runtime::Outlook& outlook) {
  Json in_s = Json::array();
  Json percent = Json::array();
  Json worst_age_s = Json::array();
  for (const runtime::OutlookSample& sample : outlook.samples) {
    in_s.push_back(rounded(sample.in_s));
    percent.push_back(rounded(sample.metric_percent));
    worst_age_s.push_back(rounded(sample.worst_age_s));
  }
  Json areas = Json::array();
  for (const runtime::AreaOutlook& area : outlook.areas) areas.push_back(area_json(area));
  const bool has_pair = std::isfinite(outlook.least_pair_m);
  return {{"in_s", std::move(in_s)},
          {"metric_percent", std::move(percent)},
          {"worst_age_s", std::move(worst_age_s)},
          {"areas", std::move(areas)},
          {"least_pair_m", has_pair ? Json(rounded(outlook.least_pair_m)) : Json(nullptr)},
          {"active", outlook.samples.empty() ? 0 : outlook.samples.back().active},
          {"tick_s", outlook.tick_s}};
}

/// World frame, x, y of each shown drone's places one after the other; null for a drone that was never seen.
Json ghosts_json(const runtime::Outlook& outlook, const field::WorldFrame& frame) {
  Json drones = Json::array();
  const std::size_t points = outlook.ghost_points;
  const ShownDrones shown(points == 0 ? 0 : outlook.ghosts.size() / points);
  for (const std::size_t drone : shown.drones()) {
    const std::size_t first = drone * points;
    Json places = Json::array();
    for (std::size_t n = first; n < first + points; ++n) {
      const Vec2 place = frame.point_to_world(outlook.ghosts[n]);
      places.push_back(rounded(place.x()));
      places.push_back(rounded(place.y()));
    }
    drones.push_back(std::move(places));
  }
  return {{"spacing_s", outlook.ghost_spacing_s}, {"xy_m", std::move(drones)}};
}

}  // namespace

Json preview_json(const runtime::Outlooks& outlooks, const PreviewContext& context) {
  const runtime::Outlook& shown = outlooks.what_if ? *outlooks.what_if : outlooks.as_is;
  return {{"type", "preview"},
          {"id", 0},
          {"epoch", context.epoch},
          {"revision", context.revision},
          {"tick", outlooks.tick},
          {"time_s", outlooks.time_s},
          {"seconds", rounded(outlooks.as_is.seconds)},
          {"as_is", outlook_json(outlooks.as_is)},
          {"what_if", outlooks.what_if ? outlook_json(*outlooks.what_if) : Json(nullptr)},
          {"ghosts", ghosts_json(shown, context.frame)}};
}

}  // namespace vigil::console

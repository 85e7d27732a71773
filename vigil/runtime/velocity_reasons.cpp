#include "vigil/runtime/velocity_reasons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, safety::kPriorities> kPriorityWords{"physical_radius", "separation", "wall",
                                                                           "margin", "doubt"};
constexpr std::array<std::string_view, 4> kWalls{"left", "right", "bottom", "top"};

constexpr double kAsWantedMS = 1e-12;  // rounding changes a wish by less

/// A row whose normal has length 1, so that both sides are speeds.
struct Row {
  safety::HoldingRow about;
  safety::Priority priority{};
  Vec2 normal = Vec2::Zero();
  double offset_m_s = 0.0;
  double slack_m_s = 0.0;
  bool holds = false;
};

bool is_about_the_same(const safety::HoldingRow& a, const safety::HoldingRow& b) {
  return a.kind == b.kind && a.index == b.index;
}

/// Whether it is one of those that the report names; of several about the same body, that which is tightest.
void mark_holding(std::vector<Row>& rows, const safety::FilterReport& report) {
  for (int i = 0; i < report.holding_count; ++i) {
    Row* tightest = nullptr;
    for (Row& row : rows) {
      if (row.holds || !is_about_the_same(row.about, report.holding[static_cast<std::size_t>(i)])) continue;
      if (tightest == nullptr || std::abs(row.slack_m_s) < std::abs(tightest->slack_m_s)) tightest = &row;
    }
    if (tightest != nullptr) tightest->holds = true;
  }
}

std::vector<Row> normalised(const safety::Explanation& why) {
  std::vector<Row> rows;
  for (const safety::GivenRow& given : why.rows) {
    const double length = given.half_plane.normal.norm();
    const double scale = length > 0.0 ? 1.0 / length : 1.0;
    Row row{.about = given.what, .priority = given.half_plane.priority};
    row.normal = scale * given.half_plane.normal;
    row.offset_m_s = scale * given.half_plane.offset;
    row.slack_m_s = row.normal.dot(why.u) - row.offset_m_s;
    rows.push_back(row);
  }
  mark_holding(rows, why.report);
  std::ranges::sort(rows, {}, [](const Row& row) {
    return std::tuple(row.slack_m_s, row.about.kind, row.about.index, row.priority);
  });
  return rows;
}

Json in_json(const Vec2& v) { return {v.x(), v.y()}; }

Json about_json(const safety::HoldingRow& about, const Mission& mission) {
  const auto index = static_cast<std::size_t>(about.index);
  switch (about.kind) {
    case safety::RowKind::kNeighbour:
      return {{"kind", "drone"}, {"drone", mission.drones.at(index).id}};
    case safety::RowKind::kWall:
      return {{"kind", "wall"}, {"wall", kWalls.at(index)}};
    case safety::RowKind::kNoFly:
      break;
  }
  return {{"kind", "no_fly"}, {"edge", about.index}};
}

Json row_json(const Row& row, const Mission& mission) {
  Json json = about_json(row.about, mission);
  json["distance_m"] = row.about.distance_m;
  json["normal"] = in_json(world_frame(mission).vector_to_world(row.normal));
  json["offset_m_s"] = row.offset_m_s;
  json["slack_m_s"] = row.slack_m_s;
  json["priority"] = kPriorityWords.at(static_cast<std::size_t>(row.priority));
  json["holds"] = row.holds;
  return json;
}

std::string about_in_words(const Json& row) {
  if (row["kind"] == "drone") return "drone " + row["drone"].get<std::string>();
  if (row["kind"] == "wall") return "wall " + row["wall"].get<std::string>();
  return fmt::format("no-fly edge {}", row["edge"].get<int>());
}

std::string velocity_in_words(const Json& v) {
  const Vec2 u(v[0].get<double>(), v[1].get<double>());
  return fmt::format("[{:7.3f}, {:7.3f}] m/s, {:.3f} m/s", u.x(), u.y(), u.norm());
}

std::string outcome_in_words(const Json& why) {
  if (why["fallback"].get<bool>()) return "  no velocity kept every row, nor without margins: the least violation\n";
  if (why["margin_used"].get<bool>()) return "  no velocity kept every row: margins gave way\n";
  if (why["changed_m_s"].get<double>() <= kAsWantedMS) return "  as it was wanted\n";
  return "";
}

}  // namespace

Json velocity_reasons_json(const swarm::SwarmState& state, swarm::DroneId drone, const Mission& mission) {
  const safety::Explanation why = state.explain(drone);
  const field::WorldFrame frame = world_frame(mission);
  const std::uint64_t tick = state.ticks() - 1;
  Json rows = Json::array();
  for (const Row& row : normalised(why)) rows.push_back(row_json(row, mission));
  return {{"tick", tick},
          {"time_s", static_cast<double>(tick) * state.parameters().dt_s},
          {"drone", mission.drones.at(drone.index()).id},
          {"activity", swarm::name_of(state.drones()[drone.index()].activity)},
          {"u_max_m_s", state.parameters().barrier.u_max_m_s},
          {"u_nom_m_s", in_json(frame.vector_to_world(why.u_nom))},
          {"u_m_s", in_json(frame.vector_to_world(why.u))},
          {"changed_m_s", why.report.correction_m_s},
          {"speed_limited", why.report.speed_limited && why.report.correction_m_s > kAsWantedMS},
          {"margin_used", why.report.margin_used},
          {"fallback", why.report.fallback},
          {"crowded", why.report.crowded},
          {"rows", std::move(rows)}};
}

std::string velocity_reasons(const swarm::SwarmState& state, swarm::DroneId drone, const Mission& mission) {
  const Json why = velocity_reasons_json(state, drone, mission);
  std::string text =
      fmt::format("{}, tick {}, {:.6g} s: {}, {}\n", mission.name, why["tick"].get<std::uint64_t>(),
                  why["time_s"].get<double>(), why["drone"].get<std::string>(), why["activity"].get<std::string>());
  text += fmt::format("  wanted   {}\n", velocity_in_words(why["u_nom_m_s"]));
  text += fmt::format("  allowed  {}{}\n", velocity_in_words(why["u_m_s"]),
                      why["speed_limited"].get<bool>() ? ", held by the speed limit" : "");
  text += outcome_in_words(why);
  if (why["rows"].empty()) return text + "  no row: nothing was near enough to ask for anything\n";
  text += fmt::format("  {:<18} {:>10}   {:<18} {:>10} {:>10}  {}\n", "row about", "distance",
                      "normal . u >=", "offset", "kept by", "gives way as");
  for (const Json& row : why["rows"])
    text += fmt::format("  {:<18} {:>8.3f} m   [{:6.3f}, {:6.3f}]   {:>10.3f} {:>10.3f}  {}{}\n", about_in_words(row),
                        row["distance_m"].get<double>(), row["normal"][0].get<double>(), row["normal"][1].get<double>(),
                        row["offset_m_s"].get<double>(), row["slack_m_s"].get<double>(),
                        row["priority"].get<std::string>(), row["holds"].get<bool>() ? ", holds" : "");
  return text;
}

}  // namespace vigil::runtime

#include "vigil/runtime/mission_description.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

constexpr std::array<Choice, 2> kOutsideField{{
    {"refuse", "a target outside the field is an error"},
    {"clamp", "a target outside the field is moved to the nearest point of it"},
}};

constexpr Range kWorldCoordinate{-2e7, 2e7};
constexpr Range kLength{0.0, 1e5, false};
constexpr Range kLengthOrZero{0.0, 1e5};
constexpr Range kWeight{0.0, 1e6};
constexpr Range kDeadline{0.0, 1e7, false};
constexpr std::string_view kProtect =
    "keeps the drones that it has with all of them where there are fewer, at the others' expense";
constexpr std::size_t kMostVertices = 1000;

bool is_identifier_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20U || c == '\x7F'; }

std::size_t characters(std::string_view text) {
  const auto starts_one = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return static_cast<std::size_t>(std::ranges::count_if(text, starts_one));
}

}  // namespace

void describe(DescriptionVisitor& visitor, Mission& mission) {
  visitor.whole_number({.name = "format", .meaning = "the version of this file format", .is_required = true}, {1, 1},
                       mission.format);
  visitor.text({.name = "name", .meaning = "what reports and recordings call the mission", .is_required = true},
               TextRule::kName, mission.name);
  visitor.text({.name = "description", .meaning = "what the mission is for"}, TextRule::kProse, mission.description);
  visitor.section({.name = "field", .meaning = "the monitored rectangle", .is_required = true},
                  [&](DescriptionVisitor& v) { describe(v, mission.field); });
  visitor.section({.name = "targets", .meaning = "where the swarm should look; without any, drones hover"},
                  [&](DescriptionVisitor& v) { describe(v, mission.targets); });
  static_assert(kMostNoFlyPoints == 1000, "the sentence below says so");
  visitor.list({.name = "no_fly",
                .meaning = "the polygons that no drone enters and where nothing is looked at; they have at most 1000 "
                           "vertices in all"},
               {0, 200}, sections_of(mission.no_fly));
  visitor.list({.name = "drones", .meaning = "the swarm, one entry a drone"}, {1, 100'000},
               sections_of(mission.drones));
  visitor.optional_section({.name = "drone_grid", .meaning = "a swarm on a regular grid, instead of `drones`"},
                           {.is_present = mission.drone_grid.has_value(),
                            .create = [&] { mission.drone_grid.emplace(); },
                            .describe = [&](DescriptionVisitor& v) { describe(v, *mission.drone_grid); }});
  visitor.exactly_one_of("drones", "drone_grid");
  static_assert(kMostPads == 1000, "the sentence below says so");
  visitor.list({.name = "stations",
                .meaning = "the places to which drones fly by themselves to have their batteries charged, in turns; "
                           "they have at most 1000 pads in all"},
               {0, 200}, sections_of(mission.stations));
  visitor.section({.name = "control", .meaning = "how the swarm covers its targets", .is_required = true},
                  [&](DescriptionVisitor& v) { describe(v, mission.control); });
  visitor.section({.name = "safety", .meaning = "what is kept whatever coverage asks for", .is_required = true},
                  [&](DescriptionVisitor& v) { describe(v, mission.safety); });
  visitor.section({.name = "health", .meaning = "when a drone stops counting as flying normally"},
                  [&](DescriptionVisitor& v) { describe(v, mission.health); });
  visitor.section({.name = "sensor", .meaning = "what a drone sees"},
                  [&](DescriptionVisitor& v) { describe(v, mission.sensor); });
  visitor.section({.name = "simulation", .meaning = "the simulated world; other worlds pass over it"},
                  [&](DescriptionVisitor& v) { describe(v, mission.simulation); });
}

void describe(DescriptionVisitor& visitor, FieldSection& field) {
  visitor.point({.name = "size_m", .meaning = "the sides L1 and L2", .unit = "m", .is_required = true}, {0.5, 1e5},
                field.size_m);
  visitor.point({.name = "origin_m", .meaning = "the field's corner (0, 0) in the world frame", .unit = "m"},
                kWorldCoordinate, field.origin_m);
  visitor.number({.name = "yaw_rad",
                  .meaning = "the angle from the world's x axis to the field's, counter-clockwise",
                  .unit = "rad"},
                 {-6.3, 6.3}, field.yaw_rad);
  visitor.optional_section({.name = "datum",
                            .meaning = "where on the earth the world frame's origin lies, with x to the east and y to "
                                       "the north; with it, recordings are exported as maps"},
                           {.is_present = field.datum.has_value(),
                            .create = [&] { field.datum.emplace(); },
                            .describe = [&](DescriptionVisitor& v) { describe(v, *field.datum); }});
}

void describe(DescriptionVisitor& visitor, DatumSection& datum) {
  visitor.number({.name = "latitude_deg", .meaning = "WGS 84, north positive", .unit = "deg", .is_required = true},
                 {-89.0, 89.0}, datum.latitude_deg);
  visitor.number({.name = "longitude_deg", .meaning = "WGS 84, east positive", .unit = "deg", .is_required = true},
                 {-180.0, 180.0}, datum.longitude_deg);
}

void describe(DescriptionVisitor& visitor, TargetsSection& targets) {
  visitor.list({.name = "clusters", .meaning = "the named groups of target points; each becomes a Gaussian"}, {0, 1000},
               sections_of(targets.clusters));
  visitor.list({.name = "areas", .meaning = "the drawn areas to be watched evenly"}, {0, 200},
               sections_of(targets.areas));
  visitor.number({.name = "sigma_min_m",
                  .meaning = "the least spread of a cluster, so that a single point is a proper Gaussian; at most the "
                             "field's longer side",
                  .unit = "m",
                  .default_text = "5 % of the field's shorter side"},
                 kLength, targets.sigma_min_m);
  visitor.number(
      {.name = "uniform_floor", .meaning = "the share of all attention that is spread evenly over the field"},
      {0.0, 1.0}, targets.uniform_floor);
  visitor.choice({.name = "outside_field", .meaning = "what becomes of a target outside the field"}, kOutsideField,
                 targets.outside_field);
}

void describe(DescriptionVisitor& visitor, ClusterEntry& cluster) {
  visitor.text({.name = "name", .meaning = "a name, unique among clusters and areas", .is_required = true},
               TextRule::kName, cluster.name);
  visitor.points({.name = "points_m", .meaning = "the target points, world frame", .unit = "m", .is_required = true},
                 kWorldCoordinate, {1, 10'000}, cluster.points_m);
  visitor.number(
      {.name = "weight", .meaning = "the factor on the number of its points in the cluster's share of attention"},
      kWeight, cluster.weight);
  visitor.number({.name = "revisit_s",
                  .meaning = "the deadline: no part of it is to stay unseen for longer",
                  .unit = "s",
                  .default_text = "none"},
                 kDeadline, cluster.revisit_s);
  visitor.truth({.name = "protect", .meaning = kProtect}, cluster.is_protected);
}

void describe(DescriptionVisitor& visitor, AreaEntry& area) {
  visitor.text({.name = "name", .meaning = "a name, unique among clusters and areas", .is_required = true},
               TextRule::kName, area.name);
  visitor.points({.name = "outline_m",
                  .meaning = "the vertices of a polygon that does not cross itself, world frame",
                  .unit = "m",
                  .is_required = true},
                 kWorldCoordinate, {3, kMostVertices}, area.outline_m);
  visitor.number({.name = "weight", .meaning = "the number of target points that get as much attention as the area"},
                 kWeight, area.weight);
  visitor.number({.name = "soft_edge_m", .meaning = "how far attention fades out beyond the outline", .unit = "m"},
                 kLengthOrZero, area.soft_edge_m);
  visitor.number({.name = "revisit_s",
                  .meaning = "the deadline: no part of it is to stay unseen for longer",
                  .unit = "s",
                  .default_text = "none"},
                 kDeadline, area.revisit_s);
  visitor.truth({.name = "protect", .meaning = kProtect}, area.is_protected);
}

void describe(DescriptionVisitor& visitor, NoFlyEntry& no_fly) {
  visitor.text({.name = "name", .meaning = "a name, unique among no-fly polygons", .is_required = true},
               TextRule::kName, no_fly.name);
  visitor.points({.name = "outline_m",
                  .meaning = "the vertices of a polygon that does not cross itself, world frame",
                  .unit = "m",
                  .is_required = true},
                 kWorldCoordinate, {3, kMostNoFlyPoints}, no_fly.outline_m);
}

void describe(DescriptionVisitor& visitor, DroneEntry& drone) {
  visitor.text(
      {.name = "id", .meaning = "a unique id; not `all`, which events use for every drone", .is_required = true},
      TextRule::kIdentifier, drone.id);
  visitor.point({.name = "start_m", .meaning = "where it starts, world frame", .unit = "m", .is_required = true},
                kWorldCoordinate, drone.start_m);
}

void describe(DescriptionVisitor& visitor, DroneGridSection& grid) {
  visitor.whole_number({.name = "count", .meaning = "how many drones", .is_required = true}, {1, 100'000}, grid.count);
  visitor.text({.name = "prefix", .meaning = "the beginning of every id; a number from 1 follows"},
               TextRule::kIdentifier, grid.prefix);
  visitor.number({.name = "spacing_m",
                  .meaning = "the distance between neighbours of a square grid in the middle of the field",
                  .unit = "m",
                  .default_text = "as wide as the field allows"},
                 kLength, grid.spacing_m);
}

void describe(DescriptionVisitor& visitor, StationEntry& station) {
  visitor.text({.name = "name", .meaning = "a name, unique among stations", .is_required = true}, TextRule::kName,
               station.name);
  visitor.points({.name = "pads_m",
                  .meaning = "where drones come down, world frame; one drone a pad, best where there is little to see",
                  .unit = "m",
                  .is_required = true},
                 kWorldCoordinate, {1, kMostPads}, station.pads_m);
  visitor.number({.name = "full_in_s", .meaning = "the time in which it charges an empty battery", .unit = "s"},
                 {1.0, 86'400.0}, station.full_in_s);
  visitor.number({.name = "pad_radius_m", .meaning = "a drone that comes down within it is charged", .unit = "m"},
                 {0.01, 100.0}, station.pad_radius_m);
}

std::string_view name_of(OutsideField value) { return kOutsideField.at(static_cast<std::size_t>(value)).name; }

std::string interval(const Range& range, std::string_view unit) {
  return fmt::format("{}{}, {}]{}{}", range.has_low ? "[" : "(", range.low, range.high, unit.empty() ? "" : " ", unit);
}

std::string interval(const WholeRange& range, std::string_view unit) {
  return fmt::format("[{}, {}]{}{}", range.low, range.high, unit.empty() ? "" : " ", unit);
}

std::string_view rule_in_words(TextRule rule) {
  switch (rule) {
    case TextRule::kIdentifier:
      return "1 to 32 of the characters A-Z a-z 0-9 _ -";
    case TextRule::kName:
      return "one line of 1 to 64 characters";
    case TextRule::kProse:
      break;
  }
  return "text of at most 2000 characters";
}

bool follows(TextRule rule, std::string_view text) {
  switch (rule) {
    case TextRule::kIdentifier:
      return !text.empty() && text.size() <= 32 && std::ranges::all_of(text, is_identifier_character);
    case TextRule::kName:
      return !text.empty() && characters(text) <= 64 && std::ranges::none_of(text, is_control);
    case TextRule::kProse:
      break;
  }
  const auto is_unprintable = [](char c) { return is_control(c) && c != '\n' && c != '\t'; };
  return characters(text) <= 2000 && std::ranges::none_of(text, is_unprintable);
}

}  // namespace vigil::runtime

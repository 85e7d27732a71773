#include "vigil/adapters/console/mission_json.hpp"

#include <string>
#include <vector>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::console {
namespace {

using nlohmann::ordered_json;
using runtime::Choice;
using runtime::Count;
using runtime::Describe;
using runtime::DescriptionVisitor;
using runtime::Key;
using runtime::Range;
using runtime::TextRule;

ordered_json in_json(const Vec2& point) { return {point.x(), point.y()}; }

class JsonWriter final : public DescriptionVisitor {
 public:
  [[nodiscard]] ordered_json take() { return std::move(object_); }

  void number(const Key& key, const Range& /*range*/, double& value) override { put(key, value); }
  void number(const Key& key, const Range& /*range*/, std::optional<double>& value) override {
    if (value) put(key, *value);
  }
  void truth(const Key& key, bool& value) override { put(key, value); }
  void text(const Key& key, TextRule /*rule*/, std::string& value) override { put(key, value); }
  void point(const Key& key, const Range& /*range*/, Vec2& value) override { put(key, in_json(value)); }
  void points(const Key& key, const Range& /*range*/, const Count& /*count*/, std::vector<Vec2>& value) override {
    ordered_json list = ordered_json::array();
    for (const Vec2& point : value) list.push_back(in_json(point));
    put(key, std::move(list));
  }
  void section(const Key& key, const Describe& describe) override { put(key, inside(describe)); }
  void optional_section(const Key& key, const runtime::OptionalSection& part) override {
    if (part.is_present) section(key, part.describe);
  }
  void list(const Key& key, const Count& /*count*/, const runtime::ListOfSections& sections) override {
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < sections.size; ++i)
      list.push_back(inside([&](DescriptionVisitor& visitor) { sections.describe(visitor, i); }));
    put(key, std::move(list));
  }
  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override {
    visit_choice(key, choices, chosen);
    rest(*this);
  }
  void exactly_one_of(std::string_view /*first*/, std::string_view /*second*/) override {}

 protected:
  void visit_whole_number(const Key& key, const runtime::WholeRange& /*range*/, std::int64_t& value) override {
    put(key, value);
  }
  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override {
    put(key, choices[chosen].name);
  }

 private:
  static ordered_json inside(const Describe& describe) {
    JsonWriter writer;
    describe(writer);
    return writer.take();
  }
  template <typename Value>
  void put(const Key& key, Value&& value) {
    object_[std::string(key.name)] = std::forward<Value>(value);
  }

  ordered_json object_ = ordered_json::object();
};

}  // namespace

ordered_json mission_json(const runtime::Mission& mission) {
  runtime::Mission shown = mission;
  shown.drone_grid.reset();
  JsonWriter writer;
  runtime::describe(writer, shown);
  return writer.take();
}

ordered_json display_json(const runtime::Mission& mission, const SpeedRange& speeds) {
  const safety::BarrierParameters barrier = runtime::barrier_parameters(mission);
  const auto memory_s = runtime::memory_s(mission);
  return {{"field",
           {{"length_x_m", mission.field.size_m.x()},
            {"length_y_m", mission.field.size_m.y()},
            {"origin_m", in_json(mission.field.origin_m)},
            {"yaw_rad", mission.field.yaw_rad}}},
          {"drones", mission.drones.size()},
          {"dt_s", runtime::tick_s(mission)},
          {"separation_m", barrier.separation_m},
          {"contact_distance_m", barrier.contact_distance_m},
          {"wall_distance_m", barrier.wall_distance_m},
          {"no_fly_buffer_m", barrier.no_fly_buffer_m},
          {"barrier_radius_m", safety::barrier_radius(barrier)},
          {"speed_limit_m_s", barrier.u_max_m_s},
          {"footprint_radius_m", runtime::footprint_radius_m(mission)},
          {"sigma_min_m", runtime::sigma_min_m(mission)},
          {"basis_max_index", mission.control.basis_max_index},
          {"basis_smoothness", mission.control.basis_smoothness},
          {"memory_s", memory_s ? ordered_json(*memory_s) : ordered_json(nullptr)},
          {"can_change_speed", speeds.most > 1.0},
          {"can_pause", speeds.most > 1.0},
          {"least_speed", speeds.least},
          {"most_speed", speeds.most}};
}

}  // namespace vigil::console

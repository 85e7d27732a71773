#include "vigil/runtime/flow_yaml.hpp"

#include <utility>

#include <fmt/format.h>

#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_writer.hpp"

namespace vigil::runtime {
namespace {

/// The shortest decimal that reads back as the same number.
std::string in_flow(const Vec2& point) { return fmt::format("[{}, {}]", point.x(), point.y()); }

/// Writes a section as `{key: value, ...}`. Sections within sections are no part of drones and events, which are all
/// that is written so.
class FlowWriter final : public DescriptionVisitor {
 public:
  [[nodiscard]] std::string take() { return "{" + std::move(inside_) + "}"; }

  void number(const Key& key, const Range& /*range*/, double& value) override { add(key, fmt::format("{}", value)); }
  void number(const Key& key, const Range& /*range*/, std::optional<double>& value) override {
    if (value) add(key, fmt::format("{}", *value));
  }
  void truth(const Key& key, bool& value) override { add(key, value ? "true" : "false"); }
  void text(const Key& key, TextRule /*rule*/, std::string& value) override { add(key, text_in_yaml(value)); }
  void point(const Key& key, const Range& /*range*/, Vec2& value) override { add(key, in_flow(value)); }
  void points(const Key& key, const Range& /*range*/, const Count& /*count*/, std::vector<Vec2>& value) override {
    add(key, runtime::in_flow(value));
  }
  void section(const Key& /*key*/, const Describe& describe) override { describe(*this); }
  void optional_section(const Key& key, const OptionalSection& part) override {
    if (part.is_present) section(key, part.describe);
  }
  void list(const Key& /*key*/, const Count& /*count*/, const ListOfSections& sections) override {
    for (std::size_t i = 0; i < sections.size; ++i) sections.describe(*this, i);
  }
  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override {
    visit_choice(key, choices, chosen);
    rest(*this);
  }
  void exactly_one_of(std::string_view /*first*/, std::string_view /*second*/) override {}

 protected:
  void visit_whole_number(const Key& key, const WholeRange& /*range*/, std::int64_t& value) override {
    add(key, fmt::format("{}", value));
  }
  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override {
    add(key, std::string(choices[chosen].name));
  }

 private:
  void add(const Key& key, const std::string& value) {
    inside_ += fmt::format("{}{}: {}", inside_.empty() ? "" : ", ", key.name, value);
  }

  std::string inside_;
};

template <typename Section>
std::string section_in_flow(Section section) {
  FlowWriter writer;
  describe(writer, section);
  return writer.take();
}

template <typename Entries, typename InFlow>
std::string list_in_flow(const Entries& entries, InFlow entry_in_flow) {
  std::string list;
  for (const auto& entry : entries) list += (list.empty() ? "" : ", ") + entry_in_flow(entry);
  return "[" + list + "]";
}

}  // namespace

std::string in_flow(const std::vector<Vec2>& points) {
  return list_in_flow(points, [](const Vec2& point) { return in_flow(point); });
}

std::string in_flow(const std::vector<DroneEntry>& drones) {
  return list_in_flow(drones, [](const DroneEntry& drone) { return section_in_flow(drone); });
}

std::string in_flow(const std::vector<EventEntry>& events) {
  return list_in_flow(events, [](const EventEntry& event) { return section_in_flow(event); });
}

}  // namespace vigil::runtime

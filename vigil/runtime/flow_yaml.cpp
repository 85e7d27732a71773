#include "vigil/runtime/flow_yaml.hpp"

#include <utility>

#include <fmt/format.h>

#include "vigil/runtime/yaml_values.hpp"

namespace vigil::runtime {
namespace {

/// Writes a section as `{key: value, ...}`. Sections within sections are no part of drones and events, which are all
/// that is written so.
class FlowWriter final : public YamlValues {
 public:
  [[nodiscard]] std::string take() { return "{" + std::move(inside_) + "}"; }

  void section(const Key& /*key*/, const Describe& describe) override { describe(*this); }
  void list(const Key& /*key*/, const Count& /*count*/, const ListOfSections& sections) override {
    for (std::size_t i = 0; i < sections.size; ++i) sections.describe(*this, i);
  }

 protected:
  void write(const Key& key, std::string_view value) override {
    inside_ += fmt::format("{}{}: {}", inside_.empty() ? "" : ", ", key.name, value);
  }

 private:
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

std::string in_flow(const std::vector<Vec2>& points) { return in_yaml(points); }

std::string in_flow(const std::vector<DroneEntry>& drones) {
  return list_in_flow(drones, [](const DroneEntry& drone) { return section_in_flow(drone); });
}

std::string in_flow(const std::vector<EventEntry>& events) {
  return list_in_flow(events, [](const EventEntry& event) { return section_in_flow(event); });
}

}  // namespace vigil::runtime

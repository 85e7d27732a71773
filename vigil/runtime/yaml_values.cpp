#include "vigil/runtime/yaml_values.hpp"

#include <fmt/format.h>

#include "vigil/runtime/mission_writer.hpp"

namespace vigil::runtime {

std::string in_yaml(double value) { return fmt::format("{}", value); }

std::string in_yaml(const Vec2& point) { return fmt::format("[{}, {}]", point.x(), point.y()); }

std::string in_yaml(const std::vector<Vec2>& points) {
  std::string list;
  for (const Vec2& point : points) list += (list.empty() ? "" : ", ") + in_yaml(point);
  return "[" + list + "]";
}

void YamlValues::number(const Key& key, const Range& /*range*/, double& value) { write(key, in_yaml(value)); }

void YamlValues::number(const Key& key, const Range& /*range*/, std::optional<double>& value) {
  if (value) write(key, in_yaml(*value));
}

void YamlValues::truth(const Key& key, bool& value) { write(key, value ? "true" : "false"); }

void YamlValues::text(const Key& key, TextRule /*rule*/, std::string& value) { write(key, text_in_yaml(value)); }

void YamlValues::point(const Key& key, const Range& /*range*/, Vec2& value) { write(key, in_yaml(value)); }

void YamlValues::points(const Key& key, const Range& /*range*/, const Count& /*count*/, std::vector<Vec2>& value) {
  write(key, in_yaml(value));
}

void YamlValues::optional_section(const Key& key, const OptionalSection& part) {
  if (part.is_present) section(key, part.describe);
}

void YamlValues::variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) {
  visit_choice(key, choices, chosen);
  rest(*this);
}

void YamlValues::exactly_one_of(std::string_view /*first*/, std::string_view /*second*/) {}

void YamlValues::visit_whole_number(const Key& key, const WholeRange& /*range*/, std::int64_t& value) {
  write(key, fmt::format("{}", value));
}

void YamlValues::visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) {
  write(key, choices[chosen].name);
}

}  // namespace vigil::runtime

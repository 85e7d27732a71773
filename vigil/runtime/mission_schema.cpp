#include "vigil/runtime/mission_schema.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/runtime/mission_description.hpp"

namespace vigil::runtime {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(const Range& range) {
  Json schema{{"type", "number"}};
  schema[range.has_low ? "minimum" : "exclusiveMinimum"] = range.low;
  schema["maximum"] = range.high;
  return schema;
}

Json json_point(const Range& range) {
  return {{"type", "array"}, {"items", json_number(range)}, {"minItems", 2}, {"maxItems", 2}};
}

Json json_list(Json items, const Count& count) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", count.low}, {"maxItems", count.high}};
}

Json json_text(TextRule rule) {
  switch (rule) {
    case TextRule::kIdentifier:
      return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]{1,32}$"}};
    case TextRule::kName:
      return {{"type", "string"}, {"minLength", 1}, {"maxLength", 64}, {"pattern", "^[^\\x00-\\x1f\\x7f]+$"}};
    case TextRule::kProse:
      break;
  }
  return {{"type", "string"}, {"maxLength", 2000}, {"pattern", "^[^\\x00-\\x08\\x0b-\\x1f\\x7f]*$"}};
}

std::string described(const Key& key) {
  std::string text(key.meaning);
  if (!key.unit.empty()) text += fmt::format(", {}", key.unit);
  if (!key.default_text.empty()) text += fmt::format("; default: {}", key.default_text);
  return text;
}

std::string described(std::span<const Choice> choices, const Key& key) {
  std::string text = described(key);
  for (const Choice& choice : choices) text += fmt::format("\n- {}: {}", choice.name, choice.meaning);
  return text;
}

/// The schema of one section, gathered from what the description shows of it.
class SchemaWriter final : public DescriptionVisitor {
 public:
  [[nodiscard]] Json take() {
    Json schema{{"type", "object"}, {"properties", std::move(properties_)}};
    if (!required_.empty()) schema["required"] = std::move(required_);
    schema["additionalProperties"] = false;
    if (!one_of_.empty()) schema["oneOf"] = std::move(one_of_);
    return schema;
  }

  void number(const Key& key, const Range& range, double& value) override {
    Json schema = json_number(range);
    if (!key.is_required) schema["default"] = value;
    add(key, std::move(schema));
  }
  void number(const Key& key, const Range& range, std::optional<double>& /*value*/) override {
    add(key, json_number(range));
  }

  void truth(const Key& key, bool& value) override {
    Json schema{{"type", "boolean"}};
    if (!key.is_required) schema["default"] = value;
    add(key, std::move(schema));
  }

  void text(const Key& key, TextRule rule, std::string& value) override {
    Json schema = json_text(rule);
    if (!key.is_required) schema["default"] = value;
    add(key, std::move(schema));
  }

  void point(const Key& key, const Range& range, Vec2& value) override {
    Json schema = json_point(range);
    if (!key.is_required) schema["default"] = {value.x(), value.y()};
    add(key, std::move(schema));
  }

  void points(const Key& key, const Range& range, const Count& count, std::vector<Vec2>& /*value*/) override {
    add(key, json_list(json_point(range), count));
  }

  void section(const Key& key, const Describe& describe) override { add(key, schema_of(describe)); }

  void optional_section(const Key& key, const OptionalSection& section) override {
    section.create();
    add(key, schema_of(section.describe));
  }

  void list(const Key& key, const Count& count, const ListOfSections& sections) override {
    sections.resize(1);
    add(key, json_list(schema_of([&](DescriptionVisitor& visitor) { sections.describe(visitor, 0); }), count));
  }

  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override {
    // One alternative a choice, each with the keys before this one, this one, and its own.
    for (std::size_t i = 0; i < choices.size(); ++i) {
      chosen = i;
      SchemaWriter alternative = *this;
      alternative.one_of_ = Json::array();
      alternative.add(key, {{"const", choices[i].name}});
      alternative.properties_[std::string(key.name)]["description"] = choices[i].meaning;
      rest(alternative);
      one_of_.push_back(alternative.take());
    }
  }

  void exactly_one_of(std::string_view first, std::string_view second) override {
    one_of_.push_back({{"required", {first}}});
    one_of_.push_back({{"required", {second}}});
  }

 protected:
  void visit_whole_number(const Key& key, const WholeRange& range, std::int64_t& value) override {
    Json schema{{"type", "integer"}, {"minimum", range.low}, {"maximum", range.high}};
    if (!key.is_required) schema["default"] = value;
    add(key, std::move(schema));
  }

  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override {
    Json schema{{"type", "string"}, {"enum", Json::array()}};
    for (const Choice& choice : choices) schema["enum"].push_back(choice.name);
    if (!key.is_required) schema["default"] = choices[chosen].name;
    schema["description"] = described(choices, key);
    add(key, std::move(schema));
  }

 private:
  static Json schema_of(const Describe& describe) {
    SchemaWriter writer;
    describe(writer);
    return writer.has_variants() ? Json{{"type", "object"}, {"oneOf", std::move(writer.one_of_)}} : writer.take();
  }

  [[nodiscard]] bool has_variants() const { return !one_of_.empty() && one_of_.front().contains("properties"); }

  void add(const Key& key, Json schema) {
    if (!schema.contains("description")) schema["description"] = described(key);
    properties_[std::string(key.name)] = std::move(schema);
    if (key.is_required) required_.push_back(key.name);
  }

  Json properties_ = Json::object();
  Json required_ = Json::array();
  Json one_of_ = Json::array();
};

}  // namespace

nlohmann::ordered_json mission_schema_json() {
  SchemaWriter writer;
  Mission defaults;
  describe(writer, defaults);
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "vigil mission"},
              {"description", "What one mission of the swarm is to do, and how. SI units; points in the world frame."}};
  schema.update(writer.take());
  return schema;
}

}  // namespace vigil::runtime

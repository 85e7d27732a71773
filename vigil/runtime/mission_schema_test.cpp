#include "vigil/runtime/mission_schema.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_reference.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/random_mission.hpp"
#include "vigil/runtime/yaml_scalar.hpp"

namespace vigil::runtime {
namespace {

using Json = nlohmann::json;

/// What a program that knows nothing of missions makes of a YAML document.
Json json_of(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kEmpty:
    case YamlNode::Kind::kUnset:
      return nullptr;
    case YamlNode::Kind::kList: {
      Json list = Json::array();
      for (const YamlNode& item : node.items) list.push_back(json_of(item));
      return list;
    }
    case YamlNode::Kind::kMap: {
      Json object = Json::object();
      for (const YamlEntry& entry : node.entries) object[entry.key.text] = json_of(entry.value);
      return object;
    }
    case YamlNode::Kind::kScalar:
      break;
  }
  if (scalar_type(node) == ScalarType::kText) return node.text;
  if (scalar_type(node) == ScalarType::kBoolean) return node.text.starts_with('t');
  if (const ParsedWholeNumber whole = parse_whole_number(node); whole.problem.empty()) return whole.value;
  if (const ParsedNumber number = parse_number(node); number.problem.empty()) return number.value;
  return std::numeric_limits<double>::infinity();  // .nan, .inf, 1e999 and other bases: in no range
}

const std::set<std::string> kRemarks{"$schema", "title", "description", "default"};
const std::set<std::string> kOfNumbers{"minimum", "exclusiveMinimum", "maximum"};
const std::set<std::string> kOfTexts{"minLength", "maxLength", "pattern"};
const std::set<std::string> kOfLists{"minItems", "maxItems", "items"};
const std::set<std::string> kOfObjects{"required", "properties", "additionalProperties"};

/// Judges a document by a JSON Schema, on its own: the part of draft 2020-12 that the mission's schema uses. A keyword
/// that it does not know is a failure of the test, so that none is passed over.
class Validator {
 public:
  [[nodiscard]] bool accepts(const Json& schema, const Json& value) const {
    for (const auto& [keyword, argument] : schema.items()) {
      if (!holds(schema, keyword, argument, value)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool holds(const Json& schema, const std::string& keyword, const Json& argument,
                           const Json& value) const {
    if (kRemarks.contains(keyword)) return true;
    if (keyword == "type") return is_of_type(argument, value);
    if (keyword == "const") return value == argument;
    if (keyword == "enum") return std::ranges::find(argument, value) != argument.end();
    if (keyword == "oneOf") {
      return std::ranges::count_if(argument, [&](const Json& one) { return accepts(one, value); }) == 1;
    }
    // A keyword says something of one type only; values of others satisfy it.
    if (kOfNumbers.contains(keyword))
      return !value.is_number() || holds_for_number(keyword, argument, value.get<double>());
    if (kOfTexts.contains(keyword)) return !value.is_string() || holds_for_text(keyword, argument, value);
    if (kOfLists.contains(keyword)) return !value.is_array() || holds_for_list(keyword, argument, value);
    if (kOfObjects.contains(keyword)) return !value.is_object() || holds_for_object(schema, keyword, argument, value);
    ADD_FAILURE() << "keyword " << keyword;
    return false;
  }

  static bool is_of_type(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "number") return value.is_number();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    ADD_FAILURE() << "type " << type;
    return false;
  }

  static bool holds_for_number(const std::string& keyword, const Json& argument, double value) {
    if (keyword == "minimum") return value >= argument.get<double>();
    if (keyword == "exclusiveMinimum") return value > argument.get<double>();
    return value <= argument.get<double>();  // maximum
  }

  static bool holds_for_text(const std::string& keyword, const Json& argument, const std::string& value) {
    const auto characters = static_cast<std::size_t>(
        std::ranges::count_if(value, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
    if (keyword == "minLength") return characters >= argument.get<std::size_t>();
    if (keyword == "maxLength") return characters <= argument.get<std::size_t>();
    return std::regex_search(value, std::regex(argument.get<std::string>()));  // pattern
  }

  [[nodiscard]] bool holds_for_list(const std::string& keyword, const Json& argument, const Json& value) const {
    if (keyword == "minItems") return value.size() >= argument.get<std::size_t>();
    if (keyword == "maxItems") return value.size() <= argument.get<std::size_t>();
    return std::ranges::all_of(value, [&](const Json& item) { return accepts(argument, item); });
  }

  [[nodiscard]] bool holds_for_object(const Json& schema, const std::string& keyword, const Json& argument,
                                      const Json& value) const {
    if (keyword == "required") {
      return std::ranges::all_of(argument, [&](const Json& key) { return value.contains(key.get<std::string>()); });
    }
    if (keyword == "properties") {
      const auto holds_property = [&](const auto& property) {
        return !value.contains(property.key()) || accepts(property.value(), value.at(property.key()));
      };
      const auto properties = argument.items();
      return std::all_of(properties.begin(), properties.end(), holds_property);
    }
    const auto keys = value.items();  // additionalProperties: false
    return std::all_of(keys.begin(), keys.end(),
                       [&](const auto& entry) { return schema.at("properties").contains(entry.key()); });
  }
};

bool schema_accepts(const std::string& text) {
  static const Json kSchema = Json::parse(mission_schema_json().dump());
  return Validator().accepts(kSchema, json_of(parse_yaml(text, "text")));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(MissionSchema, It_accepts_what_the_reader_accepts) {
  EXPECT_TRUE(schema_accepts(right_mission()));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(VIGIL_MISSIONS_DIR)) {
    if (entry.path().extension() == ".yaml") {
      EXPECT_TRUE(schema_accepts(text_of(entry.path()))) << entry.path();
    }
  }
}

RC_GTEST_PROP(MissionSchema, It_accepts_every_written_mission, ()) {
  const Mission mission = random_mission(*rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(schema_accepts(mission_yaml(mission)));
}

TEST(MissionSchema, It_refuses_every_mission_whose_structure_is_wrong) {
  for (const MalformedMission& malformed : malformed_missions()) {
    if (malformed.fault == Fault::kStructure) {
      EXPECT_FALSE(schema_accepts(malformed.text)) << malformed.name;
    }
  }
}

TEST(MissionSchema, It_cannot_see_that_values_do_not_fit_together) {
  for (const MalformedMission& malformed : malformed_missions()) {
    if (malformed.fault == Fault::kMeaning) {
      EXPECT_TRUE(schema_accepts(malformed.text)) << malformed.name;
    }
  }
}

TEST(MissionSchema, The_published_schema_is_the_one_that_the_program_writes) {
  EXPECT_EQ(text_of(std::filesystem::path(VIGIL_MISSIONS_DIR) / "mission.schema.json"),
            mission_schema_json().dump(2) + "\n");
}

TEST(MissionReference, The_published_page_is_the_one_that_the_program_writes) {
  EXPECT_EQ(text_of(std::filesystem::path(VIGIL_MISSIONS_DIR).parent_path() / "docs" / "mission-file.md"),
            mission_reference_markdown());
}

}  // namespace
}  // namespace vigil::runtime

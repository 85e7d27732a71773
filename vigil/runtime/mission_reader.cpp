#include "vigil/runtime/mission_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vigil/runtime/key_suggestion.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/yaml_scalar.hpp"

namespace vigil::runtime {
namespace {

bool is_within(double value, const Range& range) {
  return (range.has_low ? value >= range.low : value > range.low) && value <= range.high;
}

std::string what_it_is(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kEmpty:
    case YamlNode::Kind::kUnset:
      return "is empty";
    case YamlNode::Kind::kScalar:
      return "is a single value";
    case YamlNode::Kind::kList:
      return "is a list";
    case YamlNode::Kind::kMap:
      break;
  }
  return "is a section";
}

YamlNode empty_section() {
  YamlNode node;
  node.kind = YamlNode::Kind::kMap;
  return node;
}

class Reader final : public DescriptionVisitor {
 public:
  explicit Reader(const MissionSource& source) : source_(source) {}

  void read(Mission& mission) {
    inside(source_.root(), {}, std::nullopt, "must be a section of `key: value` lines",
           "start from missions/paper.yaml", [&](DescriptionVisitor& visitor) { describe(visitor, mission); });
  }

  void number(const Key& key, const Range& range, double& value) override {
    if (const YamlNode* node = take(key, number_in_words(range, key.unit))) {
      value = number_of(*node, range, key, {});
    }
  }

  void number(const Key& key, const Range& range, std::optional<double>& value) override {
    if (const YamlNode* node = take(key, number_in_words(range, key.unit))) {
      value = number_of(*node, range, key, {});
    }
  }

  void truth(const Key& key, bool& value) override {
    constexpr const char* kTruth = "must be true or false";
    const YamlNode* node = take(key, kTruth);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::kScalar) refuse(*node, key, "", what_it_is(*node), kTruth, give(key));
    if (scalar_type(*node) != ScalarType::kBoolean) refuse(*node, key, "", "is no truth value", kTruth, give(key));
    value = node->text.starts_with('t') || node->text.starts_with('T');
  }

  void text(const Key& key, TextRule rule, std::string& value) override {
    const std::string valid = fmt::format("must be {}", rule_in_words(rule));
    const YamlNode* node = take(key, valid);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::kScalar) refuse(*node, key, "", what_it_is(*node), valid, give(key));
    if (scalar_type(*node) != ScalarType::kText) {
      refuse(*node, key, "", "is a number or truth value, not text", valid, "put it in quotes");
    }
    if (!follows(rule, node->text)) refuse(*node, key, "", "", valid, give(key));
    value = node->text;
  }

  void point(const Key& key, const Range& range, Vec2& value) override {
    if (const YamlNode* node = take(key, point_in_words(range, key.unit))) value = point_of(*node, range, key, {});
  }

  void points(const Key& key, const Range& range, const Count& count, std::vector<Vec2>& value) override {
    const std::string valid = fmt::format("must be a list of {} to {} points [x, y]", count.low, count.high);
    const YamlNode* node = take(key, valid);
    if (node == nullptr) return;
    require_list(*node, key, count, valid);
    value.resize(node->items.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      value[i] = point_of(node->items[i], range, key, fmt::format("[{}]", i));
    }
  }

  void section(const Key& key, const Describe& describe) override {
    static const YamlNode kAbsent = empty_section();
    constexpr const char* kSection = "must be a section of `key: value` lines";
    const YamlNode* node = take(key, kSection);
    inside(node == nullptr ? kAbsent : *node, key.name, std::nullopt, kSection, give(key),
           // A required section that is missing is the enclosing section's fault, not that of its first key.
           node == nullptr && key.is_required ? Describe([](DescriptionVisitor&) {}) : describe);
  }

  void optional_section(const Key& key, const OptionalSection& section) override {
    constexpr const char* kSection = "must be a section of `key: value` lines";
    const YamlNode* node = take(key, kSection);
    if (node == nullptr) return;
    section.create();
    inside(*node, key.name, std::nullopt, kSection, give(key), section.describe);
  }

  void list(const Key& key, const Count& count, const ListOfSections& sections) override {
    const std::string valid = fmt::format("must be a list of {} to {} sections", count.low, count.high);
    const YamlNode* node = take(key, valid);
    if (node == nullptr) return;
    require_list(*node, key, count, valid);
    sections.resize(node->items.size());
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      inside(node->items[i], key.name, i, "must be a section of keys", give(key),
             [&](DescriptionVisitor& visitor) { sections.describe(visitor, i); });
    }
  }

  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override {
    visit_choice(key, choices, chosen);
    if (scopes_.back().missing) source_.refuse(*scopes_.back().missing);  // without it the other keys cannot be judged
    rest(*this);
  }

  void exactly_one_of(std::string_view first, std::string_view second) override {
    const YamlNode* one = written(first);
    const YamlNode* other = written(second);
    if (one != nullptr && other != nullptr) {
      source_.refuse({.place = source_.place_of(*other),
                      .key = path(second),
                      .value = as_written(*other),
                      .problem = fmt::format("is given beside {}", first),
                      .valid = fmt::format("must be either {} or {}", first, second),
                      .advice = "remove one of them"});
    }
    if (one == nullptr && other == nullptr) {
      miss({.name = first, .meaning = ""}, fmt::format("must be either {} or {}", first, second), "give one of them");
    }
  }

 protected:
  void visit_whole_number(const Key& key, const WholeRange& range, std::int64_t& value) override {
    const std::string valid = range.low == range.high
                                  ? fmt::format("must be {}", range.low)
                                  : fmt::format("must be a whole number in {}", interval(range, key.unit));
    const YamlNode* node = take(key, valid);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::kScalar) refuse(*node, key, "", what_it_is(*node), valid, give(key));
    const ParsedWholeNumber number = parse_whole_number(*node);
    if (!number.problem.empty()) refuse(*node, key, "", number.problem, valid, advice_for(number.problem, key));
    if (number.value < range.low || number.value > range.high) refuse(*node, key, "", "", valid, give(key));
    value = number.value;
  }

  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override {
    std::vector<std::string_view> names;
    for (const Choice& choice : choices) names.push_back(choice.name);
    const std::string valid = fmt::format("must be one of: {}", fmt::join(names, ", "));
    const YamlNode* node = take(key, valid);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::kScalar) refuse(*node, key, "", what_it_is(*node), valid, give(key));
    const auto found = std::ranges::find(names, node->text);
    if (found == names.end()) {
      const std::string advice = suggestion_for(node->text, names);
      refuse(*node, key, "", "is not known", valid, advice == "remove it" ? give(key) : advice);
    }
    chosen = static_cast<std::size_t>(found - names.begin());
  }

 private:
  /// A section that is being read.
  struct Scope {
    const YamlNode* node;
    std::string_view key;
    std::optional<std::size_t> index;
    std::vector<std::string_view> known;  ///< keys that the description has shown
    std::optional<MissionFault> missing;  ///< the first required key that is not there
  };

  static std::string give(const Key& key) { return fmt::format("give {}", key.meaning); }

  static std::string number_in_words(const Range& range, std::string_view unit) {
    return fmt::format("must be a number in {}", interval(range, unit));
  }

  static std::string point_in_words(const Range& range, std::string_view unit) {
    return fmt::format("must be [x, y], both in {}", interval(range, unit));
  }

  static std::string advice_for(std::string_view problem, const Key& key) {
    if (problem == "is text in quotes") return "remove the quotes";
    if (problem != "is more than a number" || key.unit.empty()) return give(key);
    return fmt::format("write the number alone; its unit, {}, is fixed by the key", key.unit);
  }

  std::string path(std::string_view key) const {
    std::string text;
    const auto append = [&](std::string_view name) { text += fmt::format("{}{}", text.empty() ? "" : ".", name); };
    for (const Scope& scope : scopes_) {
      if (!scope.key.empty()) append(scope.key);
      if (scope.index) text += fmt::format("[{}]", *scope.index);
    }
    if (!key.empty()) append(key);
    return text;
  }

  [[noreturn]] void refuse(const YamlNode& node, const Key& key, std::string_view rest_of_path,
                           std::string_view problem, std::string valid, std::string advice) const {
    source_.refuse({.place = source_.place_of(node),
                    .key = path(key.name).append(rest_of_path),
                    .value = as_written(node),
                    .problem = std::string(problem),
                    .valid = std::move(valid),
                    .advice = std::move(advice)});
  }

  const YamlNode* written(std::string_view key) const {
    const YamlNode* node = scopes_.back().node->find(key);
    return node == nullptr || node->kind == YamlNode::Kind::kUnset ? nullptr : node;
  }

  /// The value of a key of the current section; null where it is absent, which is remembered where it is required.
  const YamlNode* take(const Key& key, const std::string& valid) {
    scopes_.back().known.push_back(key.name);
    const YamlNode* node = written(key.name);
    if (node == nullptr && key.is_required) miss(key, valid, give(key));
    return node;
  }

  void miss(const Key& key, std::string valid, std::string advice) {
    Scope& scope = scopes_.back();
    if (scope.missing) return;
    const YamlNode* unset = scope.node->find(key.name);
    scope.missing = MissionFault{.place = source_.place_of(unset == nullptr ? *scope.node : *unset),
                                 .key = path(key.name),
                                 .value = "",
                                 .problem = "is missing",
                                 .valid = std::move(valid),
                                 .advice = std::move(advice)};
  }

  /// Reads the keys of `node` as described; all others are refused.
  void inside(const YamlNode& node, std::string_view key, std::optional<std::size_t> index, std::string_view valid,
              std::string advice, const Describe& describe) {
    scopes_.push_back({.node = &node, .key = key, .index = index, .known = {}, .missing = std::nullopt});
    if (node.kind != YamlNode::Kind::kMap)
      refuse(node, {}, "", what_it_is(node), std::string(valid), std::move(advice));
    describe(*this);
    end_scope();
    scopes_.pop_back();
  }

  /// Unknown keys come before missing ones: a misspelt key is both.
  void end_scope() const {
    const Scope& scope = scopes_.back();
    for (const YamlEntry& entry : scope.node->entries) {
      if (std::ranges::find(scope.known, entry.key.text) != scope.known.end()) continue;
      source_.refuse({.place = source_.place_of(entry.key),
                      .key = path(entry.key.text),
                      .value = as_written(entry.value),
                      .problem = "is not a key of this section",
                      .valid = fmt::format("must be one of: {}", fmt::join(scope.known, ", ")),
                      .advice = suggestion_for(entry.key.text, scope.known)});
    }
    if (scope.missing) source_.refuse(*scope.missing);
  }

  void require_list(const YamlNode& node, const Key& key, const Count& count, const std::string& valid) const {
    if (node.kind != YamlNode::Kind::kList) refuse(node, key, "", what_it_is(node), valid, give(key));
    if (node.items.size() >= count.low && node.items.size() <= count.high) return;
    refuse(node, key, "", fmt::format("has {} entries", node.items.size()), valid, give(key));
  }

  double number_of(const YamlNode& node, const Range& range, const Key& key, std::string_view rest_of_path) const {
    const auto valid = [&] { return number_in_words(range, key.unit); };
    if (node.kind != YamlNode::Kind::kScalar) refuse(node, key, rest_of_path, what_it_is(node), valid(), give(key));
    const ParsedNumber number = parse_number(node);
    if (!number.problem.empty())
      refuse(node, key, rest_of_path, number.problem, valid(), advice_for(number.problem, key));
    if (!is_within(number.value, range)) {
      refuse(node, key, rest_of_path, "", fmt::format("must be in {}", interval(range, key.unit)), give(key));
    }
    return number.value;
  }

  Vec2 point_of(const YamlNode& node, const Range& range, const Key& key, const std::string& rest_of_path) const {
    if (node.kind != YamlNode::Kind::kList || node.items.size() != 2) {
      const std::string problem =
          node.kind == YamlNode::Kind::kList ? fmt::format("has {} numbers", node.items.size()) : what_it_is(node);
      refuse(node, key, rest_of_path, problem, point_in_words(range, key.unit), give(key));
    }
    return {number_of(node.items[0], range, key, rest_of_path + "[0]"),
            number_of(node.items[1], range, key, rest_of_path + "[1]")};
  }

  const MissionSource& source_;
  std::vector<Scope> scopes_;
};

}  // namespace

Mission read_mission(const MissionSource& source) {
  Mission mission;
  Reader(source).read(mission);
  return mission;
}

}  // namespace vigil::runtime

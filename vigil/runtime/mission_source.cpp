#include "vigil/runtime/mission_source.hpp"

#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "vigil/runtime/mission_text.hpp"

namespace vigil::runtime {
namespace {

constexpr std::size_t kMostWritten = 60;

/// One step of a key path: into a section by key, or into a list by index.
struct Step {
  std::string_view key;
  std::optional<std::size_t> index;
};

std::optional<std::size_t> parse_index(std::string_view digits) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  return is_number ? std::optional(index) : std::nullopt;
}

/// The first step of `path`, taken off its front; nothing where the path is not one.
std::optional<Step> take_step(std::string_view& path, bool is_first) {
  if (path.starts_with('[') && !is_first) {
    const std::size_t end = path.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    const std::optional<std::size_t> index = parse_index(path.substr(1, end - 1));
    path.remove_prefix(end + 1);
    return index ? std::optional(Step{.key = {}, .index = index}) : std::nullopt;
  }
  if (path.starts_with('.') && !is_first) path.remove_prefix(1);
  const std::string_view key = path.substr(0, path.find_first_of(".["));
  path.remove_prefix(key.size());
  return key.empty() ? std::nullopt : std::optional(Step{.key = key, .index = std::nullopt});
}

/// Empty where `path` is no key path.
std::vector<Step> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    const std::optional<Step> step = take_step(path, steps.empty());
    if (!step) return {};
    steps.push_back(*step);
  }
  return steps;
}

const YamlNode* follow(const YamlNode& node, const Step& step) {
  if (!step.index) return node.find(step.key);
  return node.kind == YamlNode::Kind::kList && *step.index < node.items.size() ? &node.items[*step.index] : nullptr;
}

void mark_as_override(YamlNode& node, int number) {
  node.override_number = number;
  for (YamlNode& item : node.items) mark_as_override(item, number);
  for (YamlEntry& entry : node.entries) {
    mark_as_override(entry.key, number);
    mark_as_override(entry.value, number);
  }
}

std::string place_of_override(const Override& change) {
  return change.option.empty() ? "--set " + change.key : std::string(change.option);
}

[[noreturn]] void refuse_override(const Override& change, std::string problem, std::string valid) {
  throw MissionError({.place = place_of_override(change),
                      .key = "",
                      .value = change.value,
                      .problem = std::move(problem),
                      .valid = std::move(valid),
                      .advice = "write for example --set safety.separation_m=0.3 or --set drones[0].start_m=[1,2]"});
}

[[noreturn]] void refuse_without_value(const Override& change) {
  if (change.option.empty()) refuse_override(change, "has no value", "must be key=value");
  throw MissionError({.place = place_of_override(change),
                      .key = "",
                      .value = "",
                      .problem = "has no value",
                      .valid = "must be followed by a number",
                      .advice = "leave it out to take what the mission says"});
}

/// Where an override goes: the node at the path, made where it is new.
YamlNode& node_for(YamlNode& from, const Step& step, const Override& change, int number) {
  if (step.index) {
    if (from.kind != YamlNode::Kind::kList || *step.index >= from.items.size()) {
      refuse_override(change, fmt::format("has no entry [{}]", *step.index),
                      fmt::format("must be an entry of the list, which has {} (counted from 0)", from.items.size()));
    }
    return from.items[*step.index];
  }
  if (from.kind == YamlNode::Kind::kEmpty || from.kind == YamlNode::Kind::kUnset) {
    from = YamlNode{};
    from.kind = YamlNode::Kind::kMap;
    from.override_number = number;
  }
  if (from.kind != YamlNode::Kind::kMap) {
    refuse_override(change, fmt::format("looks for `{}` in what is no section", step.key),
                    "must be a path of keys that docs/mission-file.md lists");
  }
  if (YamlNode* found = from.find(step.key)) return *found;
  YamlEntry entry;
  entry.key.kind = YamlNode::Kind::kScalar;
  entry.key.text = step.key;
  entry.key.override_number = number;
  entry.value.override_number = number;
  from.entries.push_back(std::move(entry));
  return from.entries.back().value;
}

std::string as_written_list(const YamlNode& node) {
  std::string text = "[";
  for (const YamlNode& item : node.items) {
    if (text.size() > kMostWritten) return text + ", ...]";
    text += (text.size() > 1 ? ", " : "") + as_written(item);
  }
  return text + "]";
}

}  // namespace

Override parse_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    refuse_override({.key = std::string(text), .value = ""}, "has no key or no `=`", "must be key=value");
  }
  return {.key = std::string(text.substr(0, equals)), .value = std::string(text.substr(equals + 1))};
}

MissionSource::MissionSource(std::string name) : name_(std::move(name)) { root_.kind = YamlNode::Kind::kMap; }

MissionSource::MissionSource(std::string_view text, std::string name, std::span<const Override> overrides)
    : name_(std::move(name)), root_(parse_yaml(text, name_)) {
  int number = 0;
  for (const Override& change : overrides) {
    override_places_.push_back(place_of_override(change));
    apply(change, ++number);
  }
}

void MissionSource::apply(const Override& change, int number) {
  require_plain_text(change.key, "--set");
  const std::vector<Step> steps = steps_of(change.key);
  if (steps.empty()) {
    refuse_override(change, "is not the path of a key", "must be keys joined by `.` and `[n]`");
  }
  YamlNode* node = &root_;
  YamlNode* parent = nullptr;
  for (const Step& step : steps) {
    parent = node;
    node = &node_for(*node, step, change, number);
  }
  if (change.value != "none" || !change.option.empty()) {
    if (change.value.empty()) refuse_without_value(change);
    *node = parse_yaml(change.value, place_of_override(change));
  } else if (steps.back().index) {
    parent->items.erase(parent->items.begin() + static_cast<std::ptrdiff_t>(*steps.back().index));
    return;
  } else {
    *node = YamlNode{};
    node->kind = YamlNode::Kind::kUnset;
  }
  mark_as_override(*node, number);
}

std::string MissionSource::place_of(const YamlNode& node) const {
  if (node.override_number > 0) return override_places_[static_cast<std::size_t>(node.override_number) - 1];
  return node.line > 0 ? fmt::format("{}:{}:{}", name_, node.line, node.column) : name_;
}

const YamlNode* MissionSource::find(std::string_view key_path) const {
  const YamlNode* node = &root_;
  for (const Step& step : steps_of(key_path)) {
    node = follow(*node, step);
    if (node == nullptr) return nullptr;
  }
  return node;
}

bool MissionSource::is_overridden(std::string_view key_path) const {
  const YamlNode* node = find(key_path);
  return node != nullptr && node->override_number > 0 && node->kind != YamlNode::Kind::kUnset;
}

void MissionSource::refuse(MissionFault fault) const {
  const YamlNode* nearest = &root_;
  bool is_written = true;
  for (const Step& step : steps_of(fault.key)) {
    const YamlNode* next = follow(*nearest, step);
    is_written = next != nullptr && next->kind != YamlNode::Kind::kUnset;
    if (next == nullptr) break;
    nearest = next;
  }
  if (fault.place.empty()) fault.place = place_of(*nearest);
  if (fault.value.empty() && is_written) fault.value = as_written(*nearest);
  throw MissionError(std::move(fault));
}

std::string as_written(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kEmpty:
    case YamlNode::Kind::kUnset:
      return "(nothing)";
    case YamlNode::Kind::kScalar:
      return node.is_quoted ? fmt::format("\"{}\"", node.text) : node.text;
    case YamlNode::Kind::kList:
      return as_written_list(node);
    case YamlNode::Kind::kMap:
      break;
  }
  return "{...}";
}

}  // namespace vigil::runtime

#include "vigil/runtime/campaign_variation.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_schema.hpp"
#include "vigil/runtime/yaml_scalar.hpp"

namespace vigil::runtime {
namespace {

constexpr std::string_view kFaultsWhereNotSaid = "3";
constexpr std::int64_t kMostFaults = 1000;

[[noreturn]] void refuse(std::string_view text, std::string problem, std::string valid) {
  throw MissionError({.place = fmt::format("--vary {}", text),
                      .key = "",
                      .value = "",
                      .problem = std::move(problem),
                      .valid = std::move(valid),
                      .advice = "write for example --vary starts, --vary faults=3, --vary safety.lag_s=0.1..0.4 or "
                                "--vary 'safety.barrier=paper|lag_aware'"});
}

YamlNode scalar(std::string_view text) {
  YamlNode node;
  node.kind = YamlNode::Kind::kScalar;
  node.text = text;
  return node;
}

/// What may go wrong in a run; and, where it is not said what, the first six of it.
constexpr std::array kFaultKinds{EventKind::kLand,         EventKind::kFail, EventKind::kOverride,
                                 EventKind::kLoseTracking, EventKind::kHold, EventKind::kMarkFailed,
                                 EventKind::kLoseLink};
constexpr std::size_t kUsualFaultKinds = 6;

EventKind parse_fault(std::string_view text, std::string_view name) {
  const auto* const found = std::ranges::find(kFaultKinds, name, [](EventKind kind) { return name_of(kind); });
  if (found != kFaultKinds.end()) return *found;
  refuse(text, fmt::format("has an unknown fault {}", name),
         "must be of land, fail, override, lose_tracking, lose_link, hold and mark_failed, with commas between them");
}

/// The parts of `list` between the separators.
std::vector<std::string_view> split(std::string_view list, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = list.find(separator);
    parts.push_back(list.substr(0, end));
    if (end == std::string_view::npos) return parts;
    list.remove_prefix(end + 1);
  }
}

Variation parse_faults(std::string_view text, std::string_view what) {
  const std::size_t colon = what.find(':');
  const ParsedWholeNumber parsed = parse_whole_number(scalar(what.substr(0, colon)));
  if (!parsed.problem.empty() || parsed.value < 0 || parsed.value > kMostFaults)
    refuse(text, "has no number of incidents", fmt::format("must be a whole number in [0, {}]", kMostFaults));
  Variation variation{.text = std::string(text), .kind = VariationKind::kFaults, .key = {}, .choices = {}, .kinds = {}};
  variation.incidents = static_cast<std::size_t>(parsed.value);
  if (colon == std::string_view::npos)
    variation.kinds.assign(kFaultKinds.begin(), kFaultKinds.begin() + kUsualFaultKinds);
  else
    for (const std::string_view name : split(what.substr(colon + 1), ','))
      variation.kinds.push_back(parse_fault(text, name));
  return variation;
}

double parse_end(std::string_view text, std::string_view number) {
  const ParsedNumber parsed = parse_number(scalar(number));
  if (!parsed.problem.empty()) refuse(text, fmt::format("{} {}", number, parsed.problem), "must be two numbers a..b");
  return parsed.value;
}

/// What the schema says of a key path; null where it knows none.
const nlohmann::ordered_json* schema_of(const nlohmann::ordered_json& schema, std::string_view key) {
  const nlohmann::ordered_json* here = &schema;
  while (!key.empty() && here != nullptr) {
    const auto into = [&](std::string_view name) {
      const auto found = here->find(name);
      here = found == here->end() ? nullptr : &*found;
    };
    if (key.front() == '[') {
      into("items");
      key.remove_prefix(std::min(key.size(), key.find(']') == key.npos ? key.size() : key.find(']') + 1));
      continue;
    }
    if (key.front() == '.') key.remove_prefix(1);
    const std::string_view name = key.substr(0, key.find_first_of(".["));
    if (name.empty()) return nullptr;
    into("properties");
    if (here != nullptr) into(name);
    key.remove_prefix(name.size());
  }
  return here;
}

bool takes_whole_numbers(std::string_view key) {
  const nlohmann::ordered_json schema = mission_schema_json();
  const nlohmann::ordered_json* found = schema_of(schema, key);
  return found != nullptr && found->value("type", "") == "integer";
}

std::vector<std::string> parse_choices(std::string_view text, std::string_view values) {
  std::vector<std::string> choices;
  for (const std::string_view choice : split(values, '|')) {
    if (choice.empty()) refuse(text, "has an empty choice", "must be values with | between them");
    choices.emplace_back(choice);
  }
  return choices;
}

Variation parse_key(std::string_view text, std::string_view key, std::string_view values) {
  Variation variation{
      .text = std::string(text), .kind = VariationKind::kChoice, .key = std::string(key), .choices = {}, .kinds = {}};
  if (values.find('|') != std::string_view::npos) {
    variation.choices = parse_choices(text, values);
    return variation;
  }
  const std::size_t dots = values.find("..");
  if (dots == std::string_view::npos) refuse(text, "has one value only", "must be key=a..b or key=a|b|c");
  variation.kind = VariationKind::kRange;
  variation.low = parse_end(text, values.substr(0, dots));
  variation.high = parse_end(text, values.substr(dots + 2));
  variation.is_whole = takes_whole_numbers(key);
  if (variation.low > variation.high) refuse(text, "begins above its end", "must be a..b with a <= b");
  return variation;
}

}  // namespace

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  if (text == "faults") return parse_faults(text, kFaultsWhereNotSaid);
  if (equals != std::string_view::npos && !name.empty()) {
    const std::string_view values = text.substr(equals + 1);
    return name == "faults" ? parse_faults(text, values) : parse_key(text, name, values);
  }
  Variation variation{.text = std::string(text), .key = {}, .choices = {}, .kinds = {}};
  if (text == "starts") {
    variation.kind = VariationKind::kStarts;
  } else if (text == "targets") {
    variation.kind = VariationKind::kTargets;
  } else if (text != "seed") {
    refuse(text, "is nothing that can be varied", "must be seed, starts, targets, faults, key=a..b or key=a|b|c");
  }
  return variation;
}

}  // namespace vigil::runtime

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vigil/runtime/mission.hpp"

/// The one description of what a mission file may say. Reader, writer, JSON Schema and reference are visitors of it, so
/// none of them can know a key, a range or a default that another does not.
namespace vigil::runtime {

/// A key of a section and what it means.
struct Key {
  std::string_view name;
  std::string_view meaning;            ///< one line, without a full stop at its end
  std::string_view unit = "";          ///< "m", "m/s"; empty for pure numbers
  std::string_view default_text = "";  ///< what is taken where an optional value is absent
  bool is_required = false;
};

/// An interval of numbers; the upper end belongs to it.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool has_low = true;  ///< false: `low` itself is outside
};

/// An interval of whole numbers, both ends included. Within what every JSON reader keeps exact, +-2^53.
struct WholeRange {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// How many entries a list may have, both ends included.
struct Count {
  std::size_t low = 0;
  std::size_t high = 0;
};

enum class TextRule : std::uint8_t {
  kIdentifier,  ///< [A-Za-z0-9_-]{1,32}
  kName,        ///< one line of 1 to 64 characters
  kProse        ///< lines, at most 2000 characters, may be empty
};

struct Choice {
  std::string_view name;
  std::string_view meaning;
};

class DescriptionVisitor;
using Describe = std::function<void(DescriptionVisitor&)>;

/// A list of sections whose type the visitor need not know.
struct ListOfSections {
  std::size_t size = 0;
  std::function<void(std::size_t)> resize;
  std::function<void(DescriptionVisitor&, std::size_t)> describe;
};

/// A section that is there or not.
struct OptionalSection {
  bool is_present = false;
  std::function<void()> create;
  Describe describe;
};

/// Is shown every key of a section in the order of the reference, with the member that it is bound to: readers write to
/// the member, the others read it. Where `Key::is_required` is false, the member's value beforehand is the default.
class DescriptionVisitor {
 public:
  virtual ~DescriptionVisitor() = default;

  virtual void number(const Key& key, const Range& range, double& value) = 0;
  virtual void number(const Key& key, const Range& range, std::optional<double>& value) = 0;
  /// true or false.
  virtual void truth(const Key& key, bool& value) = 0;
  virtual void text(const Key& key, TextRule rule, std::string& value) = 0;
  /// [x, y], both within `range`.
  virtual void point(const Key& key, const Range& range, Vec2& value) = 0;
  virtual void points(const Key& key, const Range& range, const Count& count, std::vector<Vec2>& value) = 0;
  virtual void section(const Key& key, const Describe& describe) = 0;
  virtual void optional_section(const Key& key, const OptionalSection& section) = 0;
  virtual void list(const Key& key, const Count& count, const ListOfSections& sections) = 0;
  /// A key that decides which keys the rest of the section has: `rest` describes those of the choice that is set.
  virtual void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) = 0;
  /// Of two keys of this section, both described as optional, exactly one is to be given.
  virtual void exactly_one_of(std::string_view first, std::string_view second) = 0;

  template <typename Integer>
  void whole_number(const Key& key, const WholeRange& range, Integer& value) {
    auto wide = static_cast<std::int64_t>(value);
    visit_whole_number(key, range, wide);
    value = static_cast<Integer>(wide);
  }

  /// `choices` in the order of the enumeration, which counts from 0.
  template <typename Enumeration>
  void choice(const Key& key, std::span<const Choice> choices, Enumeration& value) {
    auto chosen = static_cast<std::size_t>(value);
    visit_choice(key, choices, chosen);
    value = static_cast<Enumeration>(chosen);
  }

 protected:
  virtual void visit_whole_number(const Key& key, const WholeRange& range, std::int64_t& value) = 0;
  virtual void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) = 0;
};

/// A whole mission file, section by section.
void describe(DescriptionVisitor& visitor, Mission& mission);

void describe(DescriptionVisitor& visitor, FieldSection& field);
void describe(DescriptionVisitor& visitor, DatumSection& datum);
void describe(DescriptionVisitor& visitor, TargetsSection& targets);
void describe(DescriptionVisitor& visitor, ClusterEntry& cluster);
void describe(DescriptionVisitor& visitor, AreaEntry& area);
void describe(DescriptionVisitor& visitor, NoFlyEntry& no_fly);
void describe(DescriptionVisitor& visitor, DroneEntry& drone);
void describe(DescriptionVisitor& visitor, DroneGridSection& grid);
void describe(DescriptionVisitor& visitor, StationEntry& station);
void describe(DescriptionVisitor& visitor, ControlSection& control);
void describe(DescriptionVisitor& visitor, SafetySection& safety);
void describe(DescriptionVisitor& visitor, HealthSection& health);
void describe(DescriptionVisitor& visitor, SensorSection& sensor);
void describe(DescriptionVisitor& visitor, SimulationSection& simulation);
void describe(DescriptionVisitor& visitor, VehicleSection& vehicle);
void describe(DescriptionVisitor& visitor, BatterySection& battery);
void describe(DescriptionVisitor& visitor, WindSection& wind);
void describe(DescriptionVisitor& visitor, LinkSection& link);
void describe(DescriptionVisitor& visitor, TrackerSection& tracker);
void describe(DescriptionVisitor& visitor, GoalsSection& goals);
void describe(DescriptionVisitor& visitor, EventEntry& event);

/// The names of enumerators in a mission file, for messages and reports.
[[nodiscard]] std::string_view name_of(OutsideField value);
[[nodiscard]] std::string_view name_of(ergodic::ControllerKind value);
[[nodiscard]] std::string_view name_of(Memory value);
[[nodiscard]] std::string_view name_of(ergodic::Accounting value);
[[nodiscard]] std::string_view name_of(safety::BarrierKind value);
[[nodiscard]] std::string_view name_of(Obstacles value);
[[nodiscard]] std::string_view name_of(StartState value);
[[nodiscard]] std::string_view name_of(EventKind value);

/// "must be a number in (0, 3] m"-like sentences, shared by messages and reference.
[[nodiscard]] std::string interval(const Range& range, std::string_view unit);
[[nodiscard]] std::string interval(const WholeRange& range, std::string_view unit);
[[nodiscard]] std::string_view rule_in_words(TextRule rule);
[[nodiscard]] bool follows(TextRule rule, std::string_view text);

/// The sections of a vector, for DescriptionVisitor::list.
template <typename Section>
[[nodiscard]] ListOfSections sections_of(std::vector<Section>& entries) {
  return {.size = entries.size(),
          .resize = [&entries](std::size_t size) { entries.resize(size); },
          .describe = [&entries](DescriptionVisitor& visitor, std::size_t i) { describe(visitor, entries[i]); }};
}

}  // namespace vigil::runtime

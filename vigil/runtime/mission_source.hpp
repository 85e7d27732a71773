#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/yaml_tree.hpp"

namespace vigil::runtime {

/// A change to a mission from the command line: `--set key=value`. The key is a path such as `safety.separation_m` or
/// `drones[1].start_m` (list entries counted from 0), the value is YAML (`[1, 2]` for a point) or `none`, which takes
/// an optional value or a list's entry away.
struct Override {
  std::string key;
  std::string value;
  std::string_view option = "";  ///< a literal such as "--seed", for messages; its value is never taken for `none`
};

/// "key=value" taken apart at the first `=`. Throws MissionError.
[[nodiscard]] Override parse_override(std::string_view text);

/// What was written, and where: the tree of a mission file with its overrides. A value.
class MissionSource {
 public:
  /// A mission that was not written but made: every place is `name`.
  explicit MissionSource(std::string name);
  /// Parses `text`, then applies the overrides one after the other. Throws MissionError.
  MissionSource(std::string_view text, std::string name, std::span<const Override> overrides);

  [[nodiscard]] const YamlNode& root() const { return root_; }
  /// "file:line:column"; for what an override wrote its option, or "--set key".
  [[nodiscard]] std::string place_of(const YamlNode& node) const;
  /// The node at a key path; null where nothing is written there.
  [[nodiscard]] const YamlNode* find(std::string_view key_path) const;
  /// True where an override wrote the value at the key path.
  [[nodiscard]] bool is_overridden(std::string_view key_path) const;

  /// Throws `fault` as MissionError, with place and value completed from what is written at its key, or at the nearest
  /// section around it.
  [[noreturn]] void refuse(MissionFault fault) const;

 private:
  void apply(const Override& change, int number);

  std::string name_;
  std::vector<std::string> override_places_;
  YamlNode root_;
};

/// What a node says, for a message: `0.3`, `"text"`, `[1, 2]`; long ones cut.
[[nodiscard]] std::string as_written(const YamlNode& node);

}  // namespace vigil::runtime

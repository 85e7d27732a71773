#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::runtime {

struct YamlEntry;

/// A node of a parsed YAML document: plain data, no cycles, nothing shared.
struct YamlNode {
  enum class Kind : std::uint8_t {
    kEmpty,   ///< nothing, ~ or null
    kScalar,  ///< `text`
    kList,    ///< `items`
    kMap,     ///< `entries`, in the order of the file, keys unique
    kUnset    ///< taken back by an override: as if it had never been written
  };
  Kind kind = Kind::kEmpty;
  bool is_quoted = false;   ///< a scalar in quotes or a block: text, whatever it looks like
  int override_number = 0;  ///< 0: from the file; n: from the n-th override
  int line = 0;             ///< from 1
  int column = 0;           ///< from 1
  std::string text;
  std::vector<YamlNode> items;
  std::vector<YamlEntry> entries;

  /// The value of a key of a map; null where it has none, or where this is no map.
  [[nodiscard]] const YamlNode* find(std::string_view key) const;
  [[nodiscard]] YamlNode* find(std::string_view key);
};

struct YamlEntry {
  YamlNode key;  ///< a scalar
  YamlNode value;
};

/// What a mission may be at most, so that no file costs more than a moment.
inline constexpr std::size_t kMostYamlDepth = 16;
inline constexpr std::size_t kMostYamlNodes = 200'000;
inline constexpr std::size_t kMostYamlScalarBytes = 4096;
inline constexpr std::size_t kMostYamlKeys = 64;

/// The one document in `text`. Refuses, as MissionError with `name`:line:column for the place: what require_plain_text
/// refuses, what is not YAML, anchors and aliases, tags, duplicate keys, keys that are not scalars, no or several
/// documents, and whatever exceeds the limits above.
[[nodiscard]] YamlNode parse_yaml(std::string_view text, const std::string& name);

}  // namespace vigil::runtime

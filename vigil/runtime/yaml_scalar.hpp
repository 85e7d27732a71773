#pragma once

#include <cstdint>
#include <string_view>

#include "vigil/runtime/yaml_tree.hpp"

/// What a scalar says, by the core schema of YAML 1.2 and nothing looser.
namespace vigil::runtime {

enum class ScalarType : std::uint8_t { kText, kNumber, kBoolean };

/// What other YAML readers take the scalar for; a mission's texts must be texts for them too.
[[nodiscard]] ScalarType scalar_type(const YamlNode& scalar);

struct ParsedNumber {
  double value = 0.0;        ///< finite; meaningful where problem is empty
  std::string_view problem;  ///< "is not a number", ...; empty where it is one
};

/// A finite decimal number: sign, digits with a point, exponent; nothing before or after it.
[[nodiscard]] ParsedNumber parse_number(const YamlNode& scalar);

struct ParsedWholeNumber {
  std::int64_t value = 0;
  std::string_view problem;
};

/// Decimal digits with a sign.
[[nodiscard]] ParsedWholeNumber parse_whole_number(const YamlNode& scalar);

}  // namespace vigil::runtime

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vigil/runtime/mission_description.hpp"

namespace vigil::runtime {

/// A number, a point or a list of them in YAML: the shortest decimals that read back as the same numbers.
[[nodiscard]] std::string in_yaml(double value);
[[nodiscard]] std::string in_yaml(const Vec2& point);
[[nodiscard]] std::string in_yaml(const std::vector<Vec2>& points);

/// Writes each value that has a key; how keys and sections are laid out is the heir's.
class YamlValues : public DescriptionVisitor {
 public:
  void number(const Key& key, const Range& range, double& value) override;
  void number(const Key& key, const Range& range, std::optional<double>& value) override;
  void truth(const Key& key, bool& value) override;
  void text(const Key& key, TextRule rule, std::string& value) override;
  void point(const Key& key, const Range& range, Vec2& value) override;
  void points(const Key& key, const Range& range, const Count& count, std::vector<Vec2>& value) override;
  void optional_section(const Key& key, const OptionalSection& part) override;
  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override;
  void exactly_one_of(std::string_view first, std::string_view second) override;

 protected:
  void visit_whole_number(const Key& key, const WholeRange& range, std::int64_t& value) override;
  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override;

  virtual void write(const Key& key, std::string_view value) = 0;
};

}  // namespace vigil::runtime

#include "vigil/runtime/mission_writer.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "vigil/runtime/yaml_scalar.hpp"
#include "vigil/runtime/yaml_values.hpp"

namespace vigil::runtime {
namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A word that every YAML reader takes for text.
bool is_plain_word(std::string_view text) {
  YamlNode scalar;
  scalar.kind = YamlNode::Kind::kScalar;
  scalar.text = text;
  constexpr std::array<std::string_view, 8> kSpecial{"null", "Null", "NULL", "yes", "no", "on", "off", "none"};
  return !text.empty() && is_letter(text.front()) &&
         std::ranges::all_of(text, [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '-'; }) &&
         std::ranges::find(kSpecial, text) == kSpecial.end() && scalar_type(scalar) == ScalarType::kText;
}

class Writer final : public YamlValues {
 public:
  [[nodiscard]] std::string take() { return std::move(yaml_); }

  void section(const Key& key, const Describe& describe) override {
    write(key, "");
    const std::size_t end_of_line = yaml_.size();
    indent_ += 2;
    describe(*this);
    indent_ -= 2;
    if (yaml_.size() == end_of_line) yaml_.insert(end_of_line - 1, " {}");
  }

  void list(const Key& key, const Count& count, const ListOfSections& sections) override {
    if (sections.size == 0) {
      if (count.low == 0) write(key, "[]");
      return;
    }
    write(key, "");
    indent_ += 4;
    for (std::size_t i = 0; i < sections.size; ++i) {
      begins_entry_ = true;
      sections.describe(*this, i);
    }
    indent_ -= 4;
  }

 protected:
  void write(const Key& key, std::string_view value) override {
    const bool is_first = std::exchange(begins_entry_, false);
    yaml_.append(is_first ? indent_ - 2 : indent_, ' ').append(is_first ? "- " : "").append(key.name).append(":");
    if (!value.empty()) yaml_.append(" ").append(value);
    yaml_ += '\n';
  }

 private:
  std::string yaml_;
  std::size_t indent_ = 0;
  bool begins_entry_ = false;
};

}  // namespace

std::string text_in_yaml(std::string_view text) {
  if (is_plain_word(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        quoted += c;
    }
  }
  return quoted + "\"";
}

std::string mission_yaml(const Mission& mission) {
  Mission shown = mission;
  if (shown.drone_grid) shown.drones.clear();
  Writer writer;
  describe(writer, shown);
  return writer.take();
}

}  // namespace vigil::runtime

#include "vigil/runtime/mission_error.hpp"

#include <utility>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

constexpr std::size_t kMostOfAPlace = 300;
constexpr std::size_t kMostOfAKey = 120;
constexpr std::size_t kMostOfAValue = 60;
constexpr std::size_t kMostOfASentence = 400;

bool continues_a_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// U+0080 to U+009F in UTF-8: terminals take some of them for commands.
bool is_second_control_set(std::string_view text, std::size_t i) {
  return text[i] == '\xC2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0U;
}

std::string escaped(char character) {
  switch (character) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return fmt::format("\\x{:02x}", static_cast<unsigned char>(character));
  }
}

std::string line_of(const MissionFault& fault) {
  std::string line = on_one_line(fault.place, kMostOfAPlace) + ":";
  if (!fault.key.empty()) line += " " + on_one_line(fault.key, kMostOfAKey);
  if (!fault.key.empty() && !fault.value.empty()) line += " =";
  if (!fault.value.empty()) line += " " + on_one_line(fault.value, kMostOfAValue);
  if (!fault.key.empty() || !fault.value.empty()) line += ":";
  std::string_view separator = " ";
  for (const std::string* part : {&fault.problem, &fault.valid, &fault.advice}) {
    if (part->empty()) continue;
    line += separator;
    line += on_one_line(*part, kMostOfASentence);
    separator = "; ";
  }
  return line;
}

}  // namespace

std::string on_one_line(std::string_view text, std::size_t most_bytes) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (line.size() >= most_bytes && !continues_a_character(text[i])) return line + "...";
    const bool is_control = static_cast<unsigned char>(text[i]) < 0x20U || text[i] == '\x7F';
    if (is_control) {
      line += escaped(text[i]);
    } else if (is_second_control_set(text, i)) {
      line += escaped(text[++i]);
    } else {
      line += text[i];
    }
  }
  return line;
}

MissionError::MissionError(MissionFault fault)
    : std::runtime_error(line_of(fault)), fault_(std::make_shared<const MissionFault>(std::move(fault))) {}

}  // namespace vigil::runtime

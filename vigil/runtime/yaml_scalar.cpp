#include "vigil/runtime/yaml_scalar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace vigil::runtime {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_sign(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return text;
}

/// Takes the digits off the front of `text` and says how many there were.
std::size_t take_digits(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_digit);
  const auto count = static_cast<std::size_t>(end - text.begin());
  text.remove_prefix(count);
  return count;
}

/// [+-] digits [. digits] [e [+-] digits], with at least one digit before the exponent. Reads past it in `text`.
bool take_number(std::string_view& text) {
  text = without_sign(text);
  std::size_t digits = take_digits(text);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    digits += take_digits(text);
  }
  if (digits == 0) return false;
  if (text.starts_with('e') || text.starts_with('E')) {
    std::string_view exponent = without_sign(text.substr(1));
    if (take_digits(exponent) == 0) return true;  // the e belongs to what follows the number
    text = exponent;
  }
  return true;
}

bool is_number(std::string_view text) { return take_number(text) && text.empty(); }

bool is_not_finite(std::string_view text) {
  constexpr std::array<std::string_view, 6> kInfinite{".inf", ".Inf", ".INF", "inf", "infinity", "Infinity"};
  constexpr std::array<std::string_view, 5> kNotANumber{".nan", ".NaN", ".NAN", "nan", "NaN"};
  const std::string_view unsigned_text = without_sign(text);
  return std::ranges::find(kInfinite, unsigned_text) != kInfinite.end() ||
         std::ranges::find(kNotANumber, unsigned_text) != kNotANumber.end();
}

/// 0x1F and 0o17, numbers by the core schema.
bool is_other_base(std::string_view text) {
  const auto is_hexadecimal = [](char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); };
  const auto is_octal = [](char c) { return c >= '0' && c <= '7'; };
  if (text.size() < 3) return false;
  const std::string_view digits = text.substr(2);
  return (text.starts_with("0x") && std::ranges::all_of(digits, is_hexadecimal)) ||
         (text.starts_with("0o") && std::ranges::all_of(digits, is_octal));
}

bool is_boolean(std::string_view text) {
  constexpr std::array<std::string_view, 6> kBooleans{"true", "True", "TRUE", "false", "False", "FALSE"};
  return std::ranges::find(kBooleans, text) != kBooleans.end();
}

std::string_view problem_of(const YamlNode& scalar) {
  if (scalar.is_quoted) return "is text in quotes";
  if (is_not_finite(scalar.text)) return "is not a finite number";
  std::string_view rest = scalar.text;
  if (!take_number(rest)) return "is not a number";
  return rest.empty() ? "" : "is more than a number";
}

}  // namespace

ScalarType scalar_type(const YamlNode& scalar) {
  if (scalar.is_quoted) return ScalarType::kText;
  if (is_boolean(scalar.text)) return ScalarType::kBoolean;
  const bool is_numeric = is_number(scalar.text) || is_other_base(scalar.text) || is_not_finite(scalar.text);
  return is_numeric ? ScalarType::kNumber : ScalarType::kText;
}

ParsedNumber parse_number(const YamlNode& scalar) {
  if (const std::string_view problem = problem_of(scalar); !problem.empty()) return {.value = 0.0, .problem = problem};
  std::string_view digits = scalar.text;
  if (digits.starts_with('+')) digits.remove_prefix(1);  // from_chars takes none
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) return {.value = 0.0, .problem = "is too large or too small to be kept"};
  const bool is_whole = error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
  return {.value = value, .problem = is_whole ? "" : "is not a number"};
}

ParsedWholeNumber parse_whole_number(const YamlNode& scalar) {
  if (const std::string_view problem = problem_of(scalar); !problem.empty()) return {.value = 0, .problem = problem};
  std::string_view digits = scalar.text;
  if (!std::ranges::all_of(without_sign(digits), is_digit)) return {.value = 0, .problem = "is not a whole number"};
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
  return {.value = value, .problem = is_whole ? "" : "is too large to be kept"};
}

}  // namespace vigil::runtime

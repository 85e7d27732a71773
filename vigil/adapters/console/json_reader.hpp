#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "vigil/core/field/vec2.hpp"

namespace vigil::console {

/// What is wrong with a JSON value from outside: where, and what is allowed.
class JsonFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A text as JSON: of a member that is there twice the value is the last, and `twice` its name.
struct ParsedJson {
  nlohmann::json value;
  std::string twice;

  /// What is wrong with it, for people; empty where nothing is.
  [[nodiscard]] std::string problem() const;
};
[[nodiscard]] ParsedJson parse_json(std::string_view text);

/// Reads the members of one JSON object; whatever is wrong is thrown as JsonFault with its place.
class JsonReader {
 public:
  /// `place`: how messages call the object; empty for the outermost one. The object outlives this.
  JsonReader(const nlohmann::json& object, std::string place);

  /// Refuses every member that is not named.
  void allow_only(std::initializer_list<std::string_view> members) const;
  [[nodiscard]] bool has(std::string_view member) const { return object_.contains(member); }

  [[nodiscard]] std::string text(std::string_view member, std::size_t most_bytes) const;
  [[nodiscard]] double number(std::string_view member) const;
  [[nodiscard]] bool flag(std::string_view member) const;
  /// 0 to 2^53 - 1.
  [[nodiscard]] std::uint64_t whole(std::string_view member) const;
  [[nodiscard]] Vec2 point(std::string_view member) const;
  [[nodiscard]] std::vector<Vec2> points(std::string_view member, std::size_t most) const;
  [[nodiscard]] JsonReader object(std::string_view member) const;
  /// The elements of a list of objects.
  [[nodiscard]] std::vector<JsonReader> objects(std::string_view member, std::size_t most) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view member, std::size_t most, std::size_t most_bytes) const;
  [[nodiscard]] bool is_text(std::string_view member) const { return at(member).is_string(); }
  [[nodiscard]] bool is_null(std::string_view member) const { return at(member).is_null(); }

  [[noreturn]] void refuse(std::string_view member, std::string_view problem) const;

 private:
  [[nodiscard]] const nlohmann::json& at(std::string_view member) const;
  [[nodiscard]] const nlohmann::json& list(std::string_view member, std::size_t most) const;
  [[nodiscard]] std::string place_of(std::string_view member) const;
  [[nodiscard]] Vec2 point_in(const nlohmann::json& value, std::string_view member) const;

  const nlohmann::json& object_;
  std::string place_;
};

}  // namespace vigil::console

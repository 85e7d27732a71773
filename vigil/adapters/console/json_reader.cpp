#include "vigil/adapters/console/json_reader.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "vigil/runtime/mission_error.hpp"

namespace vigil::console {
namespace {

constexpr std::uint64_t kLargestWhole = (std::uint64_t{1} << 53U) - 1;

bool is_point(const nlohmann::json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

/// Sees the members' names as a parser comes upon them, and keeps the first that its object had before.
class MemberWatch {
 public:
  using Event = nlohmann::json::parse_event_t;

  void see(Event event, const nlohmann::json& parsed) {
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event != Event::key || !twice_.empty()) return;
    const auto& name = parsed.get_ref<const std::string&>();
    if (!open_.back().insert(name).second) twice_ = name.empty() ? "(without a name)" : name;
  }
  [[nodiscard]] const std::string& twice() const { return twice_; }

 private:
  std::vector<std::set<std::string>> open_;
  std::string twice_;
};

}  // namespace

ParsedJson parse_json(std::string_view text) {
  MemberWatch watch;
  const auto see = [&watch](int /*depth*/, MemberWatch::Event event, const nlohmann::json& parsed) {
    watch.see(event, parsed);
    return true;
  };
  ParsedJson parsed;
  parsed.value = nlohmann::json::parse(text, see, false);
  parsed.twice = watch.twice();
  return parsed;
}

std::string ParsedJson::problem() const {
  if (value.is_discarded()) return "it is not JSON in UTF-8";
  if (twice.empty()) return {};
  return fmt::format("{}: is there twice in one object; give it once", runtime::on_one_line(twice, 60));
}

JsonReader::JsonReader(const nlohmann::json& object, std::string place) : object_(object), place_(std::move(place)) {
  if (!object.is_object()) throw JsonFault(fmt::format("{}: must be a JSON object", place_.empty() ? "it" : place_));
}

std::string JsonReader::place_of(std::string_view member) const {
  const std::string name = runtime::on_one_line(member, 60);
  return place_.empty() ? name : fmt::format("{}.{}", place_, name);
}

void JsonReader::refuse(std::string_view member, std::string_view problem) const {
  throw JsonFault(fmt::format("{}: {}", place_of(member), problem));
}

void JsonReader::allow_only(std::initializer_list<std::string_view> members) const {
  for (const auto& [name, value] : object_.items())
    if (std::find(members.begin(), members.end(), name) == members.end())
      refuse(name, fmt::format("is not a member here; those are: {}", fmt::join(members, ", ")));
}

const nlohmann::json& JsonReader::at(std::string_view member) const {
  const auto found = object_.find(member);
  if (found == object_.end()) refuse(member, "is missing");
  return *found;
}

std::string JsonReader::text(std::string_view member, std::size_t most_bytes) const {
  const nlohmann::json& value = at(member);
  if (!value.is_string()) refuse(member, "must be text");
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > most_bytes) refuse(member, fmt::format("must have at most {} bytes", most_bytes));
  return text;
}

double JsonReader::number(std::string_view member) const {
  const nlohmann::json& value = at(member);
  if (!value.is_number()) refuse(member, "must be a number");
  return value.get<double>();
}

bool JsonReader::flag(std::string_view member) const {
  const nlohmann::json& value = at(member);
  if (!value.is_boolean()) refuse(member, "must be true or false");
  return value.get<bool>();
}

std::uint64_t JsonReader::whole(std::string_view member) const {
  const nlohmann::json& value = at(member);
  const bool is_whole = value.is_number_unsigned() && value.get<std::uint64_t>() <= kLargestWhole;
  if (!is_whole) refuse(member, "must be a whole number from 0 to 2^53 - 1");
  return value.get<std::uint64_t>();
}

Vec2 JsonReader::point_in(const nlohmann::json& value, std::string_view member) const {
  if (!is_point(value)) refuse(member, "must be [x, y], two numbers in metres, world frame");
  return {value[0].get<double>(), value[1].get<double>()};
}

Vec2 JsonReader::point(std::string_view member) const { return point_in(at(member), member); }

const nlohmann::json& JsonReader::list(std::string_view member, std::size_t most) const {
  const nlohmann::json& value = at(member);
  if (!value.is_array()) refuse(member, "must be a list");
  if (value.size() > most) refuse(member, fmt::format("must have at most {} entries, not {}", most, value.size()));
  return value;
}

std::vector<Vec2> JsonReader::points(std::string_view member, std::size_t most) const {
  std::vector<Vec2> points;
  for (const nlohmann::json& value : list(member, most)) points.push_back(point_in(value, member));
  return points;
}

JsonReader JsonReader::object(std::string_view member) const { return {at(member), place_of(member)}; }

std::vector<JsonReader> JsonReader::objects(std::string_view member, std::size_t most) const {
  std::vector<JsonReader> readers;
  for (const nlohmann::json& value : list(member, most))
    readers.emplace_back(value, fmt::format("{}[{}]", place_of(member), readers.size()));
  return readers;
}

std::vector<std::string> JsonReader::texts(std::string_view member, std::size_t most, std::size_t most_bytes) const {
  std::vector<std::string> texts;
  for (const nlohmann::json& value : list(member, most)) {
    const bool is_fine = value.is_string() && value.get_ref<const std::string&>().size() <= most_bytes;
    if (!is_fine) refuse(member, fmt::format("must be a list of texts of at most {} bytes", most_bytes));
    texts.push_back(value.get<std::string>());
  }
  return texts;
}

}  // namespace vigil::console

#include "vigil/runtime/mission_reference.hpp"

#include <fmt/format.h>

#include "vigil/runtime/mission_description.hpp"

namespace vigil::runtime {
namespace {

constexpr std::string_view kIntroduction = R"(# The mission file

A mission file says everything that can be adjusted, once: the field, where to look, the swarm, how it is controlled, what
is kept whatever coverage asks for, and the simulated world. `vigil check MISSION` validates one and explains it;
`missions/` has examples. This page and `missions/mission.schema.json` (for editors) are written by the program from the
description that also reads the files, so they say what it does.

- Editors that know JSON Schema complete and check a file whose first line is
  `# yaml-language-server: $schema=mission.schema.json`.
- YAML 1.2, UTF-8, at most 1 MiB; one document; no anchors, aliases or tags; indented with spaces.
- SI units; the unit is part of a key's name. Write numbers alone: `0.3`, not `0.3 m/s`.
- Points are `[x, y]` in the *world* frame, the one in which operators and trackers speak. The field is a rectangle in it,
  placed by `field.origin_m` and turned by `field.yaw_rad`.
- Unknown keys, values outside their range and values that do not fit together are refused, each with its line and column,
  what was found, what is allowed and what to do.
- `--set key=value` on the command line changes one value, with the same checks: `--set safety.separation_m=0.25`,
  `--set drones[0].start_m=[0.1,0.2]` (list entries count from 0). `none` takes an optional value or a list's entry away.
  Where `simulation.duration_s` is set this way, later events are dropped; in a file they are an error.
)";

std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string default_of(const Key& key, std::string_view value) {
  return key.is_required ? "**required**" : fmt::format("`{}`", value);
}

/// One page: the section's table first, then those of the sections inside it.
class ReferenceWriter final : public DescriptionVisitor {
 public:
  ReferenceWriter(std::string path, std::string_view meaning) : path_(std::move(path)), meaning_(meaning) {}

  [[nodiscard]] std::string take() const {
    const std::string heading =
        path_.empty() ? "## Top level\n" : fmt::format("## `{}`\n\n{}\n", path_, sentence(meaning_));
    return heading + "\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n" + rows_ + after_ + "\n" +
           inner_;
  }

  void number(const Key& key, const Range& range, double& value) override {
    row(key, interval(range, key.unit), default_of(key, fmt::format("{}", value)));
  }
  void number(const Key& key, const Range& range, std::optional<double>& /*value*/) override {
    row(key, interval(range, key.unit), key.default_text);
  }
  void truth(const Key& key, bool& value) override {
    row(key, "`true`, `false`", default_of(key, value ? "true" : "false"));
  }
  void text(const Key& key, TextRule rule, std::string& value) override {
    row(key, rule_in_words(rule), default_of(key, value.empty() ? "\"\"" : value));
  }
  void point(const Key& key, const Range& range, Vec2& value) override {
    row(key, "`[x, y]`, both in " + interval(range, key.unit),
        default_of(key, fmt::format("[{}, {}]", value.x(), value.y())));
  }
  void points(const Key& key, const Range& /*range*/, const Count& count, std::vector<Vec2>& /*value*/) override {
    row(key, fmt::format("{} to {} points `[x, y]`, m", count.low, count.high), default_of(key, "[]"));
  }

  void section(const Key& key, const Describe& describe) override {
    row(key, "section", key.is_required ? "**required**" : "its keys' defaults");
    append(std::string(key.name), key, describe);
  }

  void optional_section(const Key& key, const OptionalSection& section) override {
    section.create();
    row(key, "section", "none");
    append(std::string(key.name), key, section.describe);
  }

  void list(const Key& key, const Count& count, const ListOfSections& sections) override {
    row(key, fmt::format("list of {} to {} sections", count.low, count.high), count.low == 0 ? "`[]`" : "none");
    sections.resize(1);
    append(fmt::format("{}[]", key.name), key, [&](DescriptionVisitor& visitor) { sections.describe(visitor, 0); });
  }

  void variants(const Key& key, std::span<const Choice> choices, std::size_t& chosen, const Describe& rest) override {
    row(key, "one of those below", "**required**");
    after_ += fmt::format("\n| `{}` | with the keys | what happens |\n| --- | --- | --- |\n", key.name);
    std::string rows;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      chosen = i;
      ReferenceWriter alternative("", "");
      rest(alternative);
      after_ += fmt::format("| `{}` | {} | {} |\n", choices[i].name, alternative.names_, cell(choices[i].meaning));
      add_new_rows(alternative.rows_);
    }
  }

  void exactly_one_of(std::string_view first, std::string_view second) override {
    after_ += fmt::format("\nExactly one of `{}` and `{}` is given.\n", first, second);
  }

 protected:
  void visit_whole_number(const Key& key, const WholeRange& range, std::int64_t& value) override {
    row(key, range.low == range.high ? fmt::format("`{}`", range.low) : "whole, " + interval(range, key.unit),
        default_of(key, fmt::format("{}", value)));
  }

  void visit_choice(const Key& key, std::span<const Choice> choices, std::size_t& chosen) override {
    std::string names;
    std::string meanings(key.meaning);
    for (const Choice& choice : choices) {
      names += fmt::format("{}`{}`", names.empty() ? "" : ", ", choice.name);
      meanings += fmt::format("<br>`{}`: {}", choice.name, choice.meaning);
    }
    rows_ += fmt::format("| `{}` | {} | {} | {} |\n", key.name, names, default_of(key, choices[chosen].name),
                         cell(meanings));
  }

 private:
  static std::string sentence(std::string_view text) {
    std::string capital(text);
    if (!capital.empty() && capital.front() >= 'a' && capital.front() <= 'z') {
      capital.front() = static_cast<char>(capital.front() - 'a' + 'A');
    }
    return capital + ".";
  }

  void row(const Key& key, std::string_view value, std::string_view default_value) {
    rows_ += fmt::format("| `{}` | {} | {} | {} |\n", key.name, value, default_value, cell(key.meaning));
    names_ += fmt::format("{}`{}`", names_.empty() ? "" : ", ", key.name);
  }

  /// Rows of an alternative that no alternative before it has shown.
  void add_new_rows(const std::string& rows) {
    for (std::size_t begin = 0; begin < rows.size();) {
      const std::size_t end = rows.find('\n', begin) + 1;
      const std::string row = rows.substr(begin, end - begin);
      if (rows_.find(row) == std::string::npos) rows_ += row;
      begin = end;
    }
  }

  void append(const std::string& name, const Key& key, const Describe& describe) {
    ReferenceWriter writer(path_.empty() ? name : path_ + "." + name, key.meaning);
    describe(writer);
    inner_ += writer.take();
  }

  std::string path_;
  std::string_view meaning_;
  std::string names_;
  std::string rows_;
  std::string after_;
  std::string inner_;
};

}  // namespace

std::string mission_reference_markdown() {
  ReferenceWriter writer("", "");
  Mission defaults;
  describe(writer, defaults);
  std::string page = std::string(kIntroduction) + "\n" + writer.take();
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

}  // namespace vigil::runtime

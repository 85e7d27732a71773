#include "vigil/runtime/yaml_tree.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_text.hpp"

namespace vigil::runtime {
namespace {

constexpr const char* kOneDocument = "must be one YAML document of `key: value` lines";

[[noreturn]] void refuse_at(const std::string& name, const YAML::Mark& mark, std::string problem, std::string valid,
                            std::string advice) {
  const bool has_place = mark.line >= 0 && mark.column >= 0;
  throw MissionError({.place = has_place ? fmt::format("{}:{}:{}", name, mark.line + 1, mark.column + 1) : name,
                      .key = "",
                      .value = "",
                      .problem = std::move(problem),
                      .valid = std::move(valid),
                      .advice = std::move(advice)});
}

YamlNode node_at(const YAML::Mark& mark, YamlNode::Kind kind) {
  YamlNode node;
  node.kind = kind;
  node.line = mark.line + 1;
  node.column = mark.column + 1;
  return node;
}

/// Builds the tree from the parser's events. Never holds more than the limits allow: it throws at the event that
/// exceeds.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& name) : name_(name) {}

  [[nodiscard]] std::optional<YamlNode> take() { return std::exchange(root_, std::nullopt); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (std::exchange(has_document_, true)) {
      refuse_at(name_, mark, "has a second document", kOneDocument, "remove the `---` and what does not belong");
    }
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    admit(mark, "", anchor);
    add(mark, node_at(mark, YamlNode::Kind::kEmpty));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { refuse_reference(mark); }
  void OnAnchor(const YAML::Mark& mark, const std::string& /*anchor_name*/) override { refuse_reference(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    admit(mark, tag, anchor);
    if (value.size() > kMostYamlScalarBytes) {
      refuse_at(name_, mark, fmt::format("has a text of {} bytes", value.size()),
                fmt::format("must be at most {} bytes", kMostYamlScalarBytes), "shorten it");
    }
    YamlNode node = node_at(mark, YamlNode::Kind::kScalar);
    node.is_quoted = tag == "!";
    node.text = value;
    add(mark, std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, YamlNode::Kind::kList);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, YamlNode::Kind::kMap);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map that is not complete yet.
  struct Open {
    YAML::Mark mark;
    YamlNode node;
    std::optional<YamlNode> key;  ///< of a map, waiting for its value
  };

  [[noreturn]] void refuse_reference(const YAML::Mark& mark) const {
    refuse_at(name_, mark, "has an anchor or alias (& or *)", "must say every value where it belongs",
              "write the value out, or quote a text that begins with & or *");
  }

  void admit(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0) refuse_reference(mark);
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse_at(name_, mark, fmt::format("has the tag {}", tag), "must be plain values without tags", "remove the tag");
    }
    if (++nodes_ > kMostYamlNodes) {
      refuse_at(name_, mark, "has too many values", fmt::format("must be at most {}", kMostYamlNodes),
                "use drone_grid for many drones, or areas for many targets");
    }
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YamlNode::Kind kind) {
    admit(mark, tag, anchor);
    if (stack_.size() >= kMostYamlDepth) {
      refuse_at(name_, mark, "is nested too deeply", fmt::format("must be at most {} levels", kMostYamlDepth),
                "check brackets and indentation");
    }
    require_scalar_key(mark);
    stack_.push_back({.mark = mark, .node = node_at(mark, kind), .key = std::nullopt});
  }

  void require_scalar_key(const YAML::Mark& mark) const {
    if (!stack_.empty() && stack_.back().node.kind == YamlNode::Kind::kMap && !stack_.back().key) {
      refuse_at(name_, mark, "has a list or section for a key", "must have plain words for keys", "check the brackets");
    }
  }

  void close() {
    Open done = std::move(stack_.back());
    stack_.pop_back();
    add(done.mark, std::move(done.node));
  }

  void add(const YAML::Mark& mark, YamlNode node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    if (parent.node.kind == YamlNode::Kind::kList) {
      parent.node.items.push_back(std::move(node));
    } else if (parent.key) {
      parent.node.entries.push_back({.key = std::move(*parent.key), .value = std::move(node)});
      parent.key.reset();
    } else {
      take_key(mark, parent, std::move(node));
    }
  }

  void take_key(const YAML::Mark& mark, Open& map, YamlNode key) const {
    if (key.kind != YamlNode::Kind::kScalar || key.text.empty()) {
      refuse_at(name_, mark, "has a value without a key", kOneDocument, "write `key: value`");
    }
    if (const YamlNode* first = std::as_const(map.node).find(key.text)) {
      refuse_at(name_, mark, fmt::format("has the key {} twice, first in line {}", key.text, first->line),
                "must have every key once", "remove one of them");
    }
    if (map.node.entries.size() >= kMostYamlKeys) {
      refuse_at(name_, mark, "has too many keys in one section", fmt::format("must be at most {}", kMostYamlKeys),
                "docs/mission-file.md lists every key");
    }
    map.key = std::move(key);
  }

  const std::string& name_;
  bool has_document_ = false;
  std::size_t nodes_ = 0;
  std::vector<Open> stack_;
  std::optional<YamlNode> root_;
};

std::optional<YamlNode> parse_events(std::string_view text, const std::string& name) {
  std::istringstream stream{std::string(text)};
  TreeBuilder builder(name);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const MissionError&) {
    throw;
  } catch (const YAML::Exception& error) {
    refuse_at(name, error.mark, "is not YAML: " + error.msg, kOneDocument,
              "check indentation, brackets and quotes near this place");
  } catch (const std::exception& error) {
    refuse_at(name, YAML::Mark::null_mark(), fmt::format("cannot be parsed: {}", error.what()), kOneDocument,
              "check indentation, brackets and quotes");
  }
  return builder.take();
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto found = std::ranges::find_if(entries, [&](const YamlEntry& entry) { return entry.key.text == key; });
  return found == entries.end() ? nullptr : &found->value;
}

YamlNode* YamlNode::find(std::string_view key) {
  return const_cast<YamlNode*>(std::as_const(*this).find(key));  // NOLINT: of a node that is not const itself
}

YamlNode parse_yaml(std::string_view text, const std::string& name) {
  require_plain_text(text, name);
  std::optional<YamlNode> root = parse_events(without_byte_order_mark(text), name);
  if (!root || root->kind == YamlNode::Kind::kEmpty) {
    throw MissionError({.place = name,
                        .key = "",
                        .value = "",
                        .problem = "is empty",
                        .valid = kOneDocument,
                        .advice = "start from missions/paper.yaml; docs/mission-file.md lists every key"});
  }
  return std::move(*root);
}

}  // namespace vigil::runtime

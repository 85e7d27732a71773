#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/target_edit.hpp"

namespace vigil::runtime {

/// Why a wish was not granted; nothing was changed.
struct Refusal {
  enum class Code : std::uint8_t {
    kInvalid,  ///< breaks a rule of mission files, or names what is not there
    kStale,    ///< somebody else changed the same thing since
    kNotNow    ///< nothing to undo or redo
  };
  Code code = Code::kInvalid;
  std::string reason;  ///< for people, on one line
};

/// A mission whose targets people change while it is flown: every change is checked by the rules of mission files, gets
/// a revision and can be undone. A value; one thread.
class MissionDesk {
 public:
  static constexpr std::size_t kMostUndo = 200;
  static constexpr std::size_t kMostEdits = 2000;  ///< in one change

  /// Precondition: a mission that mission checks accepted.
  explicit MissionDesk(Mission mission, std::uint64_t revision = 1, std::string by = "mission");

  /// With the present targets.
  [[nodiscard]] const Mission& mission() const noexcept { return mission_; }
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  [[nodiscard]] const std::string& by() const noexcept { return by_; }      ///< who made the last change
  [[nodiscard]] const std::string& what() const noexcept { return what_; }  ///< the last change in words

  /// Applies all of `edits`, in order, or none. Stale where an entry that they touch changed after revision `based_on`.
  [[nodiscard]] std::optional<Refusal> edit(std::span<const TargetEdit> edits, std::uint64_t based_on,
                                            const std::string& by);
  /// What edit() would make of the mission.
  [[nodiscard]] std::variant<Mission, Refusal> draft(std::span<const TargetEdit> edits, std::uint64_t based_on) const;

  /// Stale where `based_on` is not the newest revision: the change that would be taken back is another than was seen.
  [[nodiscard]] std::optional<Refusal> undo(std::uint64_t based_on, const std::string& by);
  [[nodiscard]] std::optional<Refusal> redo(std::uint64_t based_on, const std::string& by);
  /// What undo() and redo() would change, in words; null where they cannot.
  [[nodiscard]] const std::string* undo_what() const { return undo_.empty() ? nullptr : &undo_.back().what; }
  [[nodiscard]] const std::string* redo_what() const { return redo_.empty() ? nullptr : &redo_.back().what; }

 private:
  [[nodiscard]] Refusal changed_since() const;

  /// A change that was taken back or can be: its words, and the targets on its other side.
  struct Step {
    std::string what;
    MissionTargets targets;
  };

  void commit(MissionTargets targets, std::string what, const std::string& by);
  [[nodiscard]] bool is_stale(std::span<const TargetEdit> edits, std::uint64_t based_on) const;
  void note_changes(std::span<const TargetEdit> edits);
  void shorten_history();

  Mission mission_;
  std::uint64_t revision_;
  std::string by_;
  std::string what_;
  std::deque<Step> undo_;
  std::deque<Step> redo_;
  std::map<TargetName, std::uint64_t> changed_at_;
  std::uint64_t all_changed_at_;  ///< the revision since which changed_at_ is complete
};

/// Refuses what a mission file must not say of targets and no-fly polygons. The mission's other sections are taken to
/// be right.
[[nodiscard]] std::optional<Refusal> check_targets(const Mission& mission);

}  // namespace vigil::runtime

#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace vigil::runtime {

/// The processes that share a campaign's runs, on one machine or several. Rank 0 leads: it alone touches the campaign's
/// directory. Called from one thread of each process. A process that fails must call abandon(): the others wait for it.
class CampaignTeam {
 public:
  virtual ~CampaignTeam() = default;

  [[nodiscard]] virtual std::size_t rank() const noexcept = 0;  ///< in [0, size())
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  [[nodiscard]] virtual std::size_t size_here() const noexcept = 0;  ///< processes on this machine, this one too

  /// The leader's text, at everybody. Everybody calls it, in the same order.
  [[nodiscard]] virtual std::string share(std::string text) = 0;
  /// From anybody but the leader to the leader, in order.
  virtual void hand_in(const std::string& text) = 0;
  /// At the leader: one text that was handed in, if one is there. Does not wait.
  [[nodiscard]] virtual std::optional<std::string> take() = 0;
  /// Waits, nearly idle, until everybody has called it. The last call.
  virtual void part() = 0;
  /// Ends every process of the team at once, this one too, with the exit code; returns only if that fails.
  virtual void abandon(int exit_code) = 0;
};

}  // namespace vigil::runtime

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <sys/types.h>

namespace vigil::bench {

/// A child process that ends with this, or with the benchmark however that ends.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

/// A process that keeps one core as busy as the system lets it, at the benchmark's own niceness. To be called while
/// the benchmark has one thread.
[[nodiscard]] Child spin();

/// `vigil serve` on a free port of 127.0.0.1. To be called while the benchmark has one thread.
class ServedProgram {
 public:
  /// Without `may_have_priority` the system gives it no real-time priority, as a user without privileges. It keeps its
  /// state in `state_folder`, unless that is empty. Throws std::runtime_error where it does not come up.
  ServedProgram(const std::string& program, const std::string& mission, bool may_have_priority,
                const std::string& state_folder);

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Whether one of its threads has real-time priority.
  [[nodiscard]] bool has_priority() const;
  [[nodiscard]] std::size_t memory_kib() const;

 private:
  int output_ = -1;  ///< what it prints; never closed, for who writes to a closed pipe is ended
  Child child_;
  std::uint16_t port_;
};

}  // namespace vigil::bench

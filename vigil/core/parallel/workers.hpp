#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace vigil::parallel {

/// Most threads that share one run, the caller among them: what work space for each of them is sized by.
inline constexpr std::size_t kMostThreads = 8;

/// A function of (chunk, thread) that somebody else owns.
class Task {
 public:
  template <typename Function>
    requires(!std::is_same_v<Function, Task>)
  explicit Task(const Function& function) noexcept
      : object_(&function), call_([](const void* object, std::size_t chunk, std::size_t thread) {
          (*static_cast<const Function*>(object))(chunk, thread);
        }) {}

  void operator()(std::size_t chunk, std::size_t thread) const noexcept { call_(object_, chunk, thread); }

 private:
  const void* object_;
  void (*call_)(const void* object, std::size_t chunk, std::size_t thread);
};

/// Threads that are created once and then share out the chunks of one run after the other. They are born with the
/// scheduling of the thread that creates them: create them where they will be used from, after it has taken its
/// priority, or the least of them keeps the greatest waiting. Between runs they look out for work for a moment and then
/// sleep.
class Workers {
 public:
  /// `threads` in [1, kMostThreads], the caller of run() among them: one thread less is created. Throws
  /// std::system_error where the system gives none.
  explicit Workers(std::size_t threads);
  /// Ends them all. Not during a run.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] std::size_t threads() const noexcept;

  /// Calls task(chunk, thread) once for every chunk in [0, chunks), in any order, from several threads at once; returns
  /// when all are done, and what they wrote is seen by the caller. No two calls with the same `thread` (< threads(), 0
  /// for the caller) overlap: it may choose a work space. Which thread takes which chunk is chance: a result that must
  /// not depend on it is computed per chunk. Allocates nothing; sleeps only while others finish. One run at a time,
  /// none from within a task. Precondition: chunks < 65536.
  void run(std::size_t chunks, const Task& task) noexcept;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

/// Calls part(first, last, thread) for the parts of [0, count) of `size` each (the last may be shorter), which depend
/// on nothing else; by the workers where there are any and several parts, one after the other otherwise. Precondition:
/// 0 < size, fewer than 65536 parts; part throws nothing.
template <typename Part>
void for_each_part(Workers* workers, std::size_t count, std::size_t size, Part&& part) noexcept {
  const std::size_t parts = (count + size - 1) / size;
  const auto one = [&](std::size_t chunk, std::size_t thread) {
    part(chunk * size, std::min(count, (chunk + 1) * size), thread);
  };
  if (workers != nullptr && parts > 1) {
    workers->run(parts, Task(one));
  } else {
    for (std::size_t chunk = 0; chunk < parts; ++chunk) one(chunk, 0);
  }
}

}  // namespace vigil::parallel

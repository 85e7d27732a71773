#include "vigil/core/parallel/workers.hpp"

#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <thread>

namespace vigil::parallel {
namespace {

/// What several threads write to is kept apart by this.
constexpr std::size_t kCacheLine = 64;
/// How often a thread looks before it sleeps: some tens of microseconds, as long as the pauses within a tick.
constexpr int kLooks = 1000;

void breathe() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Returns once `value` is not `old` any more.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) noexcept {
  for (int look = 0; look < kLooks; ++look) {
    if (value.load(std::memory_order_acquire) != old) return;
    breathe();
  }
  value.wait(old, std::memory_order_acquire);
}

constexpr std::uint32_t kChunks = 0xffff;  ///< the part of a ticket that counts chunks
constexpr std::uint32_t kRound = kChunks + 1;

}  // namespace

/// A run is a ticket: its number in the upper half, how many chunks nobody has taken yet in the lower. Who takes the
/// ticket down by one owns the chunk of that number, and may read the task: it stays until that chunk is finished. Who
/// comes late finds no chunk, and nobody waits for him.
struct Workers::Shared {
  alignas(kCacheLine) std::atomic<std::uint32_t> ticket{0};
  alignas(kCacheLine) std::atomic<std::uint32_t> unfinished{0};
  alignas(kCacheLine) std::atomic<bool> is_over{false};
  const Task* task = nullptr;
  std::size_t threads = 1;
  std::array<std::jthread, kMostThreads - 1> others;

  void take_chunks(std::size_t thread) noexcept {
    std::uint32_t seen = ticket.load(std::memory_order_acquire);
    while ((seen & kChunks) != 0) {
      if (!ticket.compare_exchange_weak(seen, seen - 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      (*task)((seen & kChunks) - 1, thread);
      if (unfinished.fetch_sub(1, std::memory_order_acq_rel) == 1) unfinished.notify_one();
      seen = ticket.load(std::memory_order_acquire);
    }
  }

  void work(std::size_t thread) noexcept {
    while (!is_over.load(std::memory_order_acquire)) {
      const std::uint32_t seen = ticket.load(std::memory_order_acquire);
      if ((seen & kChunks) != 0)
        take_chunks(thread);
      else
        wait_for_change(ticket, seen);
    }
  }

  void end() noexcept {
    is_over.store(true, std::memory_order_release);
    ticket.fetch_add(kRound, std::memory_order_release);
    ticket.notify_all();
    for (std::jthread& other : others)
      if (other.joinable()) other.join();
  }
};

Workers::Workers(std::size_t threads) : shared_(std::make_unique<Shared>()) {
  assert(threads >= 1 && threads <= kMostThreads);
  try {
    for (; shared_->threads < threads; ++shared_->threads) {
      const std::size_t thread = shared_->threads;
      shared_->others[thread - 1] = std::jthread([shared = shared_.get(), thread] { shared->work(thread); });
    }
  } catch (...) {
    shared_->end();
    throw;
  }
}

Workers::~Workers() { shared_->end(); }

std::size_t Workers::threads() const noexcept { return shared_->threads; }

void Workers::run(std::size_t chunks, const Task& task) noexcept {
  assert(chunks <= kChunks);
  if (chunks == 0) return;
  shared_->task = &task;
  shared_->unfinished.store(static_cast<std::uint32_t>(chunks), std::memory_order_relaxed);
  const std::uint32_t round = (shared_->ticket.load(std::memory_order_relaxed) & ~kChunks) + kRound;
  shared_->ticket.store(round | static_cast<std::uint32_t>(chunks), std::memory_order_release);
  shared_->ticket.notify_all();
  shared_->take_chunks(0);
  for (std::uint32_t left; (left = shared_->unfinished.load(std::memory_order_acquire)) != 0;)
    wait_for_change(shared_->unfinished, left);
}

}  // namespace vigil::parallel

#include "vigil/adapters/console/desk_thread.hpp"

#include <chrono>
#include <utility>

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookEvery = 200ms;

}  // namespace

DeskThread::DeskThread(Desk& desk, std::function<void(std::string)> trouble)
    : desk_(desk), trouble_(std::move(trouble)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

DeskThread::~DeskThread() = default;

bool DeskThread::post(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() >= kMostTasks) return false;
    tasks_.push_back(std::move(task));
  }
  arrived_.notify_one();
  return true;
}

/// The next task; none where none came in time.
DeskThread::Task DeskThread::next(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, stop, kLookEvery, [this] { return !tasks_.empty(); });
  if (tasks_.empty()) return nullptr;
  Task task = std::move(tasks_.front());
  tasks_.pop_front();
  return task;
}

void DeskThread::attempt(const Task& task) {
  try {
    task(desk_);
  } catch (const std::exception& error) {
    trouble_(error.what());
  }
}

void DeskThread::run(const std::stop_token& stop) {
  auto next_look = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    if (const Task task = next(stop)) attempt(task);
    if (std::chrono::steady_clock::now() < next_look) continue;
    next_look = std::chrono::steady_clock::now() + kLookEvery;
    attempt([](Desk& desk) { desk.look(); });
  }
}

}  // namespace vigil::console

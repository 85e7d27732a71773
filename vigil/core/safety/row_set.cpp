#include "vigil/core/safety/row_set.hpp"

#include <algorithm>

namespace vigil::safety {
namespace {

/// The more speed a row asks for, the more it presses; what gives way later presses more.
double pressure(const HalfPlane& row) {
  return row.offset + static_cast<double>(kPriorities - 1 - static_cast<std::size_t>(row.priority));
}

bool presses_more(const GivenRow& a, const GivenRow& b) { return pressure(a.half_plane) > pressure(b.half_plane); }

/// A full set as a heap, the row that presses least in front: rows of another layout, so this is slow; only a throng
/// comes here.
template <typename Change>
void change_heap(std::array<HalfPlane, kMaxRows>& half_planes, std::array<HoldingRow, kMaxRows>& whats,
                 const Change& change) {
  std::array<GivenRow, kMaxRows> heap;
  for (std::size_t i = 0; i < kMaxRows; ++i) heap[i] = {half_planes[i], whats[i]};
  change(heap);
  for (std::size_t i = 0; i < kMaxRows; ++i) {
    half_planes[i] = heap[i].half_plane;
    whats[i] = heap[i].what;
  }
}

}  // namespace

void RowSet::heap_up() noexcept {
  change_heap(half_planes_, whats_, [](auto& heap) { std::make_heap(heap.begin(), heap.end(), presses_more); });
}

void RowSet::replace(const HalfPlane& half_plane, const HoldingRow& what) noexcept {
  is_crowded_ = true;
  if (pressure(half_plane) <= pressure(half_planes_.front())) return;
  change_heap(half_planes_, whats_, [&](auto& heap) {
    std::pop_heap(heap.begin(), heap.end(), presses_more);  // the one that presses least goes to the end
    heap.back() = {half_plane, what};
    std::push_heap(heap.begin(), heap.end(), presses_more);
  });
}

}  // namespace vigil::safety

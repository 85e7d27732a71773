#include "vigil/core/safety/pair_rows.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/safety/parameters_for_tests.hpp"

namespace vigil::safety {
namespace {

using InstructionSet = PairRows::InstructionSet;

/// What this machine can run.
std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512})
    if (set <= PairRows::best_instruction_set()) sets.push_back(set);
  return sets;
}

/// Bodies near and far, some in one point, some old.
Body any_body(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Body body;
  const double spread = random() % 8 == 0 ? 0.0 : random() % 4 == 0 ? 0.1 : 0.6;
  body.position.x() = spread * unit(random);
  body.position.y() = spread * unit(random);
  if (random() % 4 != 0) {
    body.velocity.x() = 0.3 * unit(random);
    body.velocity.y() = 0.3 * unit(random);
  }
  if (random() % 3 == 0) body.age_s = 0.1 * (1.0 + unit(random));
  return body;
}

PairBatch batch_of(const BarrierParameters& parameters, const std::vector<Body>& others) {
  PairBatch batch{};
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Vec2 point = barrier_point(parameters, others[i]);
    batch.point_x[i] = point.x();
    batch.point_y[i] = point.y();
    batch.position_x[i] = others[i].position.x();
    batch.position_y[i] = others[i].position.y();
    batch.velocity_x[i] = others[i].velocity.x();
    batch.velocity_y[i] = others[i].velocity.y();
    batch.age_s[i] = others[i].age_s;
  }
  return batch;
}

/// Compares each column with pair_row() of that pair alone. Returns how many rows bind.
int compare_with_single_pairs(const BarrierParameters& parameters, InstructionSet set, std::mt19937_64& random) {
  const Body own = any_body(random);
  std::vector<Body> others(random() % (PairBatch::kSize + 1));
  for (Body& other : others) other = any_body(random);
  const Vec2 z = barrier_point(parameters, own);
  PairBatch batch = batch_of(parameters, others);
  PairRows(parameters, set).compute(own, z, 0.5, others.size(), batch);
  int binding = 0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Vec2 z_ij = z - barrier_point(parameters, others[i]);
    const auto row = pair_row(parameters, separation_barrier(parameters, own, others[i]), z_ij,
                              own.velocity - others[i].velocity, 0, 1, Priority::kDoubt);
    EXPECT_EQ(batch.distance_m[i], (own.position - others[i].position).norm());
    EXPECT_EQ(batch.offset[i] > -parameters.u_max_m_s, row.has_value());
    if (!row) continue;
    ++binding;
    EXPECT_EQ(batch.offset[i], row->offset);
    if (batch.lever[i] <= pair_formula::kCoincident) continue;
    EXPECT_EQ(batch.normal_x[i], row->normal.x());
    EXPECT_EQ(batch.normal_y[i], row->normal.y());
  }
  return binding;
}

TEST(PairRows, Many_pairs_at_once_have_the_bits_of_each_alone_on_every_instruction_set) {
  for (const InstructionSet set : instruction_sets()) {
    for (BarrierParameters parameters : {paper(), lag_aware()}) {
      for (const double lag_s : {0.0, 0.1}) {
        if (parameters.kind == BarrierKind::kLagAware) parameters.lag_s = lag_s;
        std::mt19937_64 random(9);
        int binding = 0;
        for (int round = 0; round < 500; ++round) binding += compare_with_single_pairs(parameters, set, random);
        EXPECT_GT(binding, 1000);
      }
    }
  }
}

TEST(PairRows, A_pair_beyond_the_reach_or_the_set_range_is_marked) {
  BarrierParameters parameters = lag_aware();
  parameters.sensing_range_m = 1.0;
  std::vector<Body> others(3);
  others[0].position.x() = 0.9;
  others[1].position.x() = 1.1;
  others[2].position.x() = 1.1;
  others[2].age_s = 1.0;  // whoever was not seen for long is sensed from farther
  for (const InstructionSet set : instruction_sets()) {
    PairBatch batch = batch_of(parameters, others);
    const PairRows rows(parameters, set);
    rows.compute(Body{}, Vec2::Zero(), 5.0, others.size(), batch);
    EXPECT_LE(batch.excess_m[0], 0.0);
    EXPECT_GT(batch.excess_m[1], 0.0);
    EXPECT_LE(batch.excess_m[2], 0.0);
    rows.compute(Body{}, Vec2::Zero(), 0.8, others.size(), batch);
    EXPECT_GT(batch.excess_m[0], 0.0);
  }
}

}  // namespace
}  // namespace vigil::safety

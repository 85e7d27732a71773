#pragma once

// The planar solver for eight problems at once, for one instruction set: included by one source for each, which is
// compiled for it. All is in an unnamed namespace: nothing of it may be shared with another source. The operations are
// those of planar_qp.cpp in the same order, each rounded by itself.
//
// `Numbers` are eight numbers: all(), load(), store(), the operators + - * /, magnitude(), greatest(), root(). `Marks`
// say yes or no to each lane: is_less(a, b), false where one is not a number; differ(a, b), true there; & | and
// without(a, b), which is a and not b; any(), bits(); chosen(marks, a, b) is a where marked, b elsewhere.

#include "vigil/core/safety/planar_qp_arithmetic.hpp"
#include "vigil/core/safety/planar_qp_columns.hpp"

namespace vigil::safety {
namespace {

/// Numbers beyond these are for the solver that takes its time.
constexpr double kHuge = 1e30;
constexpr double kTiny = 1e-30;

constexpr double kNumber[PlanarQpColumns::kMostRows] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11,
                                                        12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};

template <typename Numbers>
struct LanesSolver {
  using Marks = typename Numbers::Marks;

  struct Points {
    Numbers x, y;
  };

  /// A row of each problem.
  struct Row {
    Numbers x, y, offset;
    Numbers size;  ///< |x| + |y|
  };

  struct Chord {
    Points base, direction;
    Numbers half;
  };

  /// The best points so far, and what holds them.
  struct State {
    Points u;
    Numbers line, end;
    Marks on_disk, is_failed;
  };

  static Numbers none() { return Numbers::all(-1.0); }
  static Numbers number(std::size_t row) { return Numbers::all(kNumber[row]); }

  static Row sized(const Numbers& x, const Numbers& y, const Numbers& offset) {
    return {x, y, offset, magnitude(x) + magnitude(y)};
  }

  static Row chosen_row(const Marks& which, const Row& a, const Row& b) {
    return {chosen(which, a.x, b.x), chosen(which, a.y, b.y), chosen(which, a.offset, b.offset),
            chosen(which, a.size, b.size)};
  }

  static Numbers clamp(const Numbers& a, const Numbers& low, const Numbers& high) {
    return chosen(is_less(a, low), low, chosen(is_less(high, a), high, a));
  }

  static Numbers gap(const Row& row, const Points& u) { return row.offset - (row.x * u.x + row.y * u.y); }
  static Numbers size(const Points& u) { return magnitude(u.x) + magnitude(u.y); }
  static Numbers rounding(const Row& row, const Numbers& u_size) {
    return Numbers::all(planar_qp::kRounding) * (magnitude(row.offset) + row.size * u_size);
  }
  /// The rounding is not negative: a gap that exceeds it is above 0.
  static Marks broken(const Row& row, const Points& u, const Numbers& u_size) {
    return is_less(rounding(row, u_size), gap(row, u));
  }

  static Row normalised(const Row& row) {
    const Numbers off = magnitude(row.x * row.x + row.y * row.y - Numbers::all(1.0));
    const Marks is_other = is_less(Numbers::all(planar_qp::kUnit), off);
    if (!any(is_other)) return row;
    const Numbers largest = greatest(magnitude(row.x), magnitude(row.y));
    const Numbers x = row.x / largest;
    const Numbers y = row.y / largest;
    const Numbers length = root(x * x + y * y);
    return chosen_row(is_other, sized(x / length, y / length, row.offset / largest / length), row);
  }

  static Points clipped(const Points& u, double radius) {
    const Numbers squared = u.x * u.x + u.y * u.y;
    const Marks is_beyond = is_less(Numbers::all(radius * radius), squared);
    if (!any(is_beyond)) return u;
    const Numbers shorter = Numbers::all(radius) / root(squared);
    return {chosen(is_beyond, u.x * shorter, u.x), chosen(is_beyond, u.y * shorter, u.y)};
  }

  static Chord chord_of(const Row& unit, double radius) {
    const Numbers reach = clamp(unit.offset, Numbers::all(-radius), Numbers::all(radius));
    const Numbers squared = (Numbers::all(radius) - unit.offset) * (Numbers::all(radius) + unit.offset);
    return {{unit.x * reach, unit.y * reach}, {-unit.y, unit.x}, root(greatest(Numbers::all(0.0), squared))};
  }

  static Points at(const Chord& chord, const Numbers& t) {
    return {chord.base.x + t * chord.direction.x, chord.base.y + t * chord.direction.y};
  }

  /// A problem in one variable for each lane: the point of a row's line closest to u_nom that satisfies others.
  struct Line {
    Numbers index;
    Chord chord;
    Numbers base_size;
    Points u;
    Numbers u_size;
    Numbers end;
    Marks on_disk, is_failed;

    Line(const Points& u_nom, const Row& row, const Numbers& row_index, double radius) : index(row_index), end(none()) {
      const Row unit = normalised(row);
      chord = chord_of(unit, radius);
      base_size = size(chord.base);
      const Numbers t_nom = chord.direction.x * u_nom.x + chord.direction.y * u_nom.y;
      const Numbers t = clamp(t_nom, -chord.half, chord.half);
      u = at(chord, t);
      u_size = size(u);
      on_disk = differ(t, t_nom);
      is_failed = broken(unit, u, u_size);
    }

    /// Moves on to where the row is satisfied, in the lanes of `which` where it is broken.
    void satisfy(const Row& row, const Numbers& row_index, const Marks& which) {
      const Marks moves = which & broken(row, u, u_size);
      if (!any(moves)) return;
      const Numbers slope = row.x * chord.direction.x + row.y * chord.direction.y;
      is_failed = is_failed | without(moves, is_less(Numbers::all(planar_qp::kParallel) * row.size, magnitude(slope)));
      const Numbers wanted = (gap(row, chord.base) - Numbers::all(0.5) * rounding(row, base_size)) / slope;
      const Numbers t = clamp(wanted, -chord.half, chord.half);
      const Points there = at(chord, t);
      const Marks is_at_end = differ(t, wanted);
      u = {chosen(moves, there.x, u.x), chosen(moves, there.y, u.y)};
      u_size = size(u);
      on_disk = (moves & is_at_end) | without(on_disk, moves);
      end = chosen(moves, chosen(is_at_end, none(), row_index), end);
    }

    void check(const Row& row, const Marks& which) { is_failed = is_failed | (which & broken(row, u, u_size)); }

    void write(const Marks& which, State& state) const {
      state.u = {chosen(which, u.x, state.u.x), chosen(which, u.y, state.u.y)};
      state.line = chosen(which, index, state.line);
      state.end = chosen(which, end, state.end);
      state.on_disk = (which & on_disk) | without(state.on_disk, which);
      state.is_failed = state.is_failed | (which & is_failed);
    }
  };

  static Row row_of(const PlanarQpColumns& problems, std::size_t i) {
    return sized(Numbers::load(problems.normal_x[i]), Numbers::load(problems.normal_y[i]),
                 Numbers::load(problems.offset[i]));
  }

  static void solve(PlanarQpColumns& problems, double radius) {
    const std::size_t count = problems.rows;
    const Points u_nom{Numbers::load(problems.u_nom_x), Numbers::load(problems.u_nom_y)};
    const Numbers huge = Numbers::all(kHuge);
    // Whether the slow solver would find nothing about a problem to be careful with.
    Marks plain = is_less(magnitude(u_nom.x), huge) & is_less(magnitude(u_nom.y), huge);
    State state{.u = clipped(u_nom, radius),
                .line = none(),
                .end = none(),
                .on_disk = is_less(Numbers::all(radius * radius), u_nom.x * u_nom.x + u_nom.y * u_nom.y),
                .is_failed = without(plain, plain)};

    // The row that is broken most comes first: it often leaves no other to be broken.
    Numbers u_size = size(state.u);
    Numbers worst = Numbers::all(0.0);
    Numbers first = none();
    Row first_row = sized(worst, worst, worst);
    for (std::size_t i = 0; i < count; ++i) {
      const Row row = row_of(problems, i);
      plain = plain & is_less(magnitude(row.offset) + row.size, huge) & is_less(Numbers::all(kTiny), row.size);
      const Numbers g = gap(row, state.u);
      const Marks is_worse = is_less(greatest(worst, rounding(row, u_size)), g);
      worst = chosen(is_worse, g, worst);
      first = chosen(is_worse, number(i), first);
      first_row = chosen_row(is_worse, row, first_row);
    }
    state.is_failed = without(Marks::all(), plain);
    Marks going = is_less(none(), first) & plain;
    if (any(going)) Line(u_nom, first_row, first, radius).write(going, state);

    Numbers done = none();  // of each lane the last row that was looked at
    for (going = without(going, state.is_failed); any(going); going = without(going, state.is_failed)) {
      u_size = size(state.u);
      Numbers next = none();
      Row next_row = first_row;
      Marks is_found = without(going, going);
      std::size_t end = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Row row = row_of(problems, i);
        const Numbers index = number(i);
        const Marks is_next =
            without(going & differ(index, first) & is_less(done, index) & broken(row, state.u, u_size), is_found);
        if (!any(is_next)) continue;
        is_found = is_found | is_next;
        next = chosen(is_next, index, next);
        next_row = chosen_row(is_next, row, next_row);
        end = i;
      }
      going = is_found;
      if (!any(going)) break;
      Line line(u_nom, next_row, next, radius);
      line.satisfy(first_row, first, going);
      for (std::size_t i = 0; i < end; ++i)
        line.satisfy(row_of(problems, i), number(i), earlier(going, i, first, next));
      line.check(first_row, going);
      for (std::size_t i = 0; i < end; ++i) line.check(row_of(problems, i), earlier(going, i, first, next));
      line.write(going, state);
      done = chosen(going, next, done);
    }

    const Points u = clipped(state.u, radius);
    u.x.store(problems.u_x);
    u.y.store(problems.u_y);
    state.line.store(problems.line);
    state.end.store(problems.end);
    problems.on_disk = bits(state.on_disk);
    problems.is_solved = bits(without(Marks::all(), state.is_failed));
  }

  /// Those of `going` in which row i comes before the next, and is not the first.
  static Marks earlier(const Marks& going, std::size_t i, const Numbers& first, const Numbers& next) {
    const Numbers index = number(i);
    return going & is_less(index, next) & differ(index, first);
  }
};

}  // namespace
}  // namespace vigil::safety

#pragma once

#include "vigil/core/ergodic/lanes_code.hpp"

/// The inner loops, for any Part of the lanes: Part::kWidth numbers in one register, with load, store, all(), + - * /,
/// fused(a, b, c) = a b + c, rounded() to the nearest integer, and sum_lanes() of the first kMostRows of some rows.
///
/// Only for the files that are compiled for one instruction set each. What they instantiate must not be shared with
/// other files, or the linker might let everybody run the code of one: every Part is a type of an unnamed namespace, so
/// that all of this has internal linkage; every function here is a template over Part; nothing of the standard library
/// or Eigen is called. A test looks at the object files.
namespace vigil::ergodic::lanes {

template <typename Part>
struct Turn {
  Part sine;
  Part cosine;
};

/// sum of coefficients[i] x^i.
template <typename Part, std::size_t kCount>
inline Part polynomial(const double (&coefficients)[kCount], Part x) noexcept {
  Part sum = Part::all(coefficients[kCount - 1]);
  for (std::size_t i = kCount - 1; i > 0; --i) sum = fused(sum, x, Part::all(coefficients[i - 1]));
  return sum;
}

/// sin(pi t), cos(pi t). With t = n + r, n an integer and |r| <= 1/2, both exact, they are (-1)^n sin(pi r), (-1)^n
/// cos(pi r): Taylor's series, whose first term left out is below 2e-17.
template <typename Part>
inline Turn<Part> turn_of(Part half_turns) noexcept {
  // (-1)^i pi^(2i+1) / (2i+1)!, but for pi itself, which is added in two parts, and (-1)^i pi^(2i) / (2i)!.
  constexpr double kSine[] = {1.2246467991473532e-16,  -5.16771278004997,       2.5501640398773455,
                              -0.5992645293207921,     0.08214588661112823,     -0.0073704309457143504,
                              0.00046630280576761255,  -2.1915353447830217e-05, 7.952054001475513e-07,
                              -2.2948428997269873e-08, 5.392664662608129e-10};
  constexpr double kCosine[] = {1.0,
                                -4.934802200544679,
                                4.0587121264167685,
                                -1.3352627688545895,
                                0.2353306303588932,
                                -0.02580689139001406,
                                0.0019295743094039231,
                                -0.0001046381049248457,
                                4.303069587032947e-06,
                                -1.3878952462213771e-07,
                                3.604730797462501e-09};
  constexpr double kPi = 3.141592653589793;
  const Part n = rounded(half_turns);
  const Part r = half_turns - n;
  const Part parity = fused(rounded(Part::all(0.5) * n), Part::all(-2.0), n);  // 0 or +-1
  const Part sign = fused(Part::all(-2.0) * parity, parity, Part::all(1.0));
  const Part r2 = r * r;
  const Part sine = fused(r, Part::all(kPi), r * polynomial(kSine, r2));
  return {sign * sine, sign * polynomial(kCosine, r2)};
}

/// Part n of m nearly equal ones of a whole.
template <typename Part>
inline std::size_t portion(std::size_t whole, std::size_t m, std::size_t n) noexcept {
  return whole / m + (n < whole % m ? 1 : 0);
}

/// Calls visit(k, sin(k theta), cos(k theta)) for k = 0, 1, ...: each pair of indices is the pair before turned by 2
/// theta, so that the pair's two turns need not wait for each other. Errors grow by a rounding a turn.
template <typename Part, typename Visit>
inline void for_each_index(Part half_turns, std::size_t indices, Visit visit) noexcept {
  Turn<Part> odd = turn_of(half_turns);
  Turn<Part> even{Part::all(0.0), Part::all(1.0)};
  const Part twice_sine = Part::all(2.0) * odd.sine;
  const Turn<Part> step{twice_sine * odd.cosine, fused(Part::all(-1.0) * twice_sine, odd.sine, Part::all(1.0))};
  const Part minus_sine = Part::all(-1.0) * step.sine;
  const auto turned = [&](const Turn<Part>& from) -> Turn<Part> {
    return {fused(from.sine, step.cosine, from.cosine * step.sine),
            fused(from.cosine, step.cosine, from.sine * minus_sine)};
  };
  for (std::size_t k = 0; k < indices; k += 2) {
    visit(k, even.sine, even.cosine);
    if (k + 1 < indices) visit(k + 1, odd.sine, odd.cosine);
    even = turned(even);
    odd = turned(odd);
  }
}

/// Sums of kRows x kColumns row products, the lanes not added yet.
template <typename Part, std::size_t kRows, std::size_t kColumns>
inline void add_up_tile(const double* rows, const double* columns, std::size_t stride,
                        double (&lanes)[Part::kMostColumns][kLanes][kLanes]) noexcept {
  for (std::size_t part = 0; part < kLanes; part += Part::kWidth) {
    Part sums[kColumns][kRows];
    for (auto& column : sums)
      for (Part& sum : column) sum = Part::all(0.0);
    for (std::size_t j = part; j < stride; j += kLanes) {
      Part column[kColumns];
      for (std::size_t c = 0; c < kColumns; ++c) column[c] = Part::load(columns + c * stride + j);
      for (std::size_t r = 0; r < kRows; ++r) {
        const Part row = Part::load(rows + r * stride + j);
        for (std::size_t c = 0; c < kColumns; ++c) sums[c][r] = fused(row, column[c], sums[c][r]);
      }
    }
    for (std::size_t c = 0; c < kColumns; ++c)
      for (std::size_t r = 0; r < kRows; ++r) sums[c][r].store(&lanes[c][r][part]);
  }
}

template <typename Part, std::size_t kRows, std::size_t kColumns>
inline void tile(const RowProducts& products, std::size_t row, std::size_t column,
                 double (&lanes)[Part::kMostColumns][kLanes][kLanes]) noexcept {
  add_up_tile<Part, kRows, kColumns>(products.rows + row * products.stride, products.columns + column * products.stride,
                                     products.stride, lanes);
  for (std::size_t c = 0; c < kColumns; ++c) {
    alignas(kLanesAlignment) double sums[kLanes];
    Part::sum_lanes(lanes[c], sums);
    double* out = products.out + row * products.out_row_stride + (column + c) * products.out_column_stride;
    for (std::size_t r = 0; r < kRows; ++r) out[r * products.out_row_stride] = sums[r];
  }
}

/// Tiles of so many columns, and one of the rest.
template <typename Part, std::size_t kRows, std::size_t kColumns>
inline void tiles_of_columns(const RowProducts& products, std::size_t row, std::size_t column,
                             double (&lanes)[Part::kMostColumns][kLanes][kLanes]) noexcept {
  for (; column + kColumns <= products.column_count; column += kColumns)
    tile<Part, kRows, kColumns>(products, row, column, lanes);
  if constexpr (kColumns > 1) tiles_of_columns<Part, kRows, kColumns - 1>(products, row, column, lanes);
}

/// The template for the number that is known only now.
template <typename Part, std::size_t kRows>
inline void tiles_of_rows(const RowProducts& products, std::size_t row, std::size_t rows,
                          double (&lanes)[Part::kMostColumns][kLanes][kLanes]) noexcept {
  if (rows == kRows) return tiles_of_columns<Part, kRows, Part::kMostColumns>(products, row, 0, lanes);
  if constexpr (kRows > 1) tiles_of_rows<Part, kRows - 1>(products, row, rows, lanes);
}

template <typename Part>
inline void row_products(const RowProducts& products) noexcept {
  alignas(kLanesAlignment) double lanes[Part::kMostColumns][kLanes][kLanes] = {};
  const std::size_t tiles = (products.row_count + Part::kMostRows - 1) / Part::kMostRows;
  std::size_t row = 0;
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::size_t rows = portion<Part>(products.row_count, tiles, t);
    tiles_of_rows<Part, Part::kMostRows>(products, row, rows, lanes);
    row += rows;
  }
}

/// Coordinates of up to kChunk drones, each axis for itself; after the last drone zeros fill the lanes.
template <typename Part>
struct Positions {
  alignas(kLanesAlignment) double x[kChunk];
  alignas(kLanesAlignment) double y[kChunk];
  std::size_t filled = 0;  ///< a multiple of kLanes

  inline void take(const double* xy, std::size_t drones) noexcept {
    filled = (drones + kLanes - 1) / kLanes * kLanes;
    for (std::size_t i = 0; i < drones; ++i) {
      x[i] = xy[2 * i];
      y[i] = xy[2 * i + 1];
    }
    for (std::size_t i = drones; i < filled; ++i) x[i] = y[i] = 0.0;
  }
};

/// sum_k += 1/h_k sum over i of cos(k1 pi x_i / L1) weight_i cos(k2 pi y_i / L2): (5)
template <typename Part>
inline void add_chunk(const BasisNumbers& basis, const Positions<Part>& positions, const double* weights,
                      double* sum_k) noexcept {
  const std::size_t n = basis.indices;
  const std::size_t stride = positions.filled;
  double* const cos_x = basis.work;
  double* const weighted_cos_y = cos_x + n * stride;
  double* const sums = weighted_cos_y + n * stride;
  for (std::size_t i = 0; i < stride; i += Part::kWidth) {
    const Part weight = Part::load(weights + i);
    for_each_index(Part::load(positions.x + i) / Part::all(basis.length_x), n,
                   [&](std::size_t k, Part, Part cosine) { cosine.store(cos_x + k * stride + i); });
    for_each_index(Part::load(positions.y + i) / Part::all(basis.length_y), n,
                   [&](std::size_t k, Part, Part cosine) { (weight * cosine).store(weighted_cos_y + k * stride + i); });
  }
  row_products<Part>({.rows = cos_x,
                      .columns = weighted_cos_y,
                      .row_count = n,
                      .column_count = n,
                      .stride = stride,
                      .out = sums,
                      .out_row_stride = 1,
                      .out_column_stride = n});
  for (std::size_t k = 0; k < n * n; ++k) sum_k[k] += basis.inverse_norm[k] * sums[k];
}

template <typename Part>
inline void add_basis(const BasisNumbers& basis, const double* xy, const double* weights, std::size_t drones,
                      double* sum_k) noexcept {
  Positions<Part> positions;
  alignas(kLanesAlignment) double weight[kChunk];
  for (std::size_t first = 0; first < drones; first += kChunk) {
    const std::size_t present = drones - first < kChunk ? drones - first : kChunk;
    positions.take(xy + 2 * first, present);
    for (std::size_t i = 0; i < present; ++i) weight[i] = weights[first + i];
    for (std::size_t i = present; i < positions.filled; ++i) weight[i] = 0.0;
    add_chunk(basis, positions, weight, sum_k);
  }
}

/// Of one part of the lanes: index k at k Part::kWidth.
struct SlopeTables {
  double* cos_x;
  double* slope_x;  ///< the derivative of cos(k1 pi x / L1) by x
  double* cos_y;
  double* slope_y;
};

template <typename Part>
inline void tabulate(Part half_turns, const double* wave_numbers, std::size_t indices, double* cosines,
                     double* slopes) noexcept {
  for_each_index(half_turns, indices, [&](std::size_t k, Part sine, Part cosine) {
    cosine.store(cosines + k * Part::kWidth);
    (Part::all(-wave_numbers[k]) * sine).store(slopes + k * Part::kWidth);
  });
}

/// b += sum over kRows k1 of [slope_x(k1) sum over k2 of a_k/h_k cos_y(k2),  cos_x(k1) sum over k2 of a_k/h_k
/// slope_y(k2)]: (7), (8)
template <typename Part, std::size_t kRows>
inline void add_slopes(const SlopeTables& tables, const double* scaled_a, std::size_t indices, std::size_t k1,
                       Part& b_x, Part& b_y) noexcept {
  Part along_cos[kRows];
  Part along_slope[kRows];
  for (std::size_t r = 0; r < kRows; ++r) along_cos[r] = along_slope[r] = Part::all(0.0);
  for (std::size_t k2 = 0; k2 < indices; ++k2) {
    const Part cosine = Part::load(tables.cos_y + k2 * Part::kWidth);
    const Part slope = Part::load(tables.slope_y + k2 * Part::kWidth);
    for (std::size_t r = 0; r < kRows; ++r) {
      const Part a = Part::all(scaled_a[k2 * indices + k1 + r]);
      along_cos[r] = fused(a, cosine, along_cos[r]);
      along_slope[r] = fused(a, slope, along_slope[r]);
    }
  }
  for (std::size_t r = 0; r < kRows; ++r) {
    b_x = fused(Part::load(tables.slope_x + (k1 + r) * Part::kWidth), along_cos[r], b_x);
    b_y = fused(Part::load(tables.cos_x + (k1 + r) * Part::kWidth), along_slope[r], b_y);
  }
}

template <typename Part, std::size_t kRows>
inline void add_slopes_of_rows(const SlopeTables& tables, const double* scaled_a, std::size_t indices, std::size_t k1,
                               std::size_t rows, Part& b_x, Part& b_y) noexcept {
  if (rows == kRows) return add_slopes<Part, kRows>(tables, scaled_a, indices, k1, b_x, b_y);
  if constexpr (kRows > 1) add_slopes_of_rows<Part, kRows - 1>(tables, scaled_a, indices, k1, rows, b_x, b_y);
}

/// The slopes of one part of the lanes take the place of its positions.
template <typename Part>
inline void slopes_in_place(const BasisNumbers& basis, const double* scaled_a, double* x, double* y) noexcept {
  const std::size_t n = basis.indices;
  const std::size_t size = n * Part::kWidth;
  double* const work = basis.work;
  const SlopeTables tables{work, work + size, work + 2 * size, work + 3 * size};
  tabulate(Part::load(x) / Part::all(basis.length_x), basis.wave_numbers_x, n, tables.cos_x, tables.slope_x);
  tabulate(Part::load(y) / Part::all(basis.length_y), basis.wave_numbers_y, n, tables.cos_y, tables.slope_y);
  Part b_x = Part::all(0.0);
  Part b_y = Part::all(0.0);
  const std::size_t tiles = (n + Part::kMostRows - 1) / Part::kMostRows;
  std::size_t k1 = 0;
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::size_t rows = portion<Part>(n, tiles, t);
    add_slopes_of_rows<Part, Part::kMostRows>(tables, scaled_a, n, k1, rows, b_x, b_y);
    k1 += rows;
  }
  b_x.store(x);
  b_y.store(y);
}

template <typename Part>
inline void gradient(const BasisNumbers& basis, const double* xy, std::size_t drones, const double* scaled_a,
                     double* out_xy) noexcept {
  Positions<Part> positions;
  for (std::size_t first = 0; first < drones; first += kChunk) {
    const std::size_t present = drones - first < kChunk ? drones - first : kChunk;
    positions.take(xy + 2 * first, present);
    for (std::size_t i = 0; i < positions.filled; i += Part::kWidth)
      slopes_in_place<Part>(basis, scaled_a, positions.x + i, positions.y + i);
    double* const out = out_xy + 2 * first;
    for (std::size_t i = 0; i < present; ++i) {
      out[2 * i] = positions.x[i];
      out[2 * i + 1] = positions.y[i];
    }
  }
}

template <typename Part>
inline void sine_cosine(const double* half_turns, double* sine, double* cosine) noexcept {
  for (std::size_t i = 0; i < kLanes; i += Part::kWidth) {
    const Turn<Part> turn = turn_of(Part::load(half_turns + i));
    turn.sine.store(sine + i);
    turn.cosine.store(cosine + i);
  }
}

template <typename Part>
const LanesCode& code_of() noexcept {
  static constexpr LanesCode kCode{add_basis<Part>, gradient<Part>, row_products<Part>, sine_cosine<Part>};
  return kCode;
}

}  // namespace vigil::ergodic::lanes

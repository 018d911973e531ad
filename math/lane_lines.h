#pragma once

#include "math/lanes.h"

#include <cstddef>
#include <functional>

/// Moving batches between lanes and records that stand one a cache line: eight records of eight doubles
/// become eight lane values (a transposition in registers). On Zen 5 this is twice as fast as gathering from
/// separate arrays, because each record costs one load.
namespace plash {

namespace lane_lines_detail {

using HalfLine = double __attribute__((vector_size(32)));

inline Lanes line_at(const double* aligned)
{
    Lanes line;
    std::memcpy(&line, __builtin_assume_aligned(aligned, sizeof line), sizeof line);
    return line;
}

inline void set_line(double* aligned, const Lanes& line)
{
    std::memcpy(__builtin_assume_aligned(aligned, sizeof line), &line, sizeof line);
}

inline HalfLine half_line_at(const double* aligned)
{
    HalfLine line;
    std::memcpy(&line, __builtin_assume_aligned(aligned, sizeof line), sizeof line);
    return line;
}

/// Rows become columns: 24 shuffles of two registers.
inline void transpose(Lanes (&row)[8])
{
    Lanes pair[8], quad[8];
    for (int i = 0; i < 8; i += 2) {
        pair[i] = __builtin_shufflevector(row[i], row[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        pair[i + 1] = __builtin_shufflevector(row[i], row[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += 4) {
        for (int odd = 0; odd < 2; ++odd) {
            quad[i + odd] =
                __builtin_shufflevector(pair[i + odd], pair[i + 2 + odd], 0, 1, 4, 5, 8, 9, 12, 13);
            quad[i + 2 + odd] =
                __builtin_shufflevector(pair[i + odd], pair[i + 2 + odd], 2, 3, 6, 7, 10, 11, 14, 15);
        }
    }
    for (int i = 0; i < 4; ++i) {
        row[i] = __builtin_shufflevector(quad[i], quad[i + 4], 0, 1, 4, 5, 8, 9, 12, 13);
        row[i + 4] = __builtin_shufflevector(quad[i], quad[i + 4], 2, 3, 6, 7, 10, 11, 14, 15);
    }
}

/// Lines become change(line, lane of the values), lane after lane.
template <class Place, class Change>
inline void change_lines(double* records, const Place* place, const Lanes (&value)[8], Change change)
{
    Lanes row[8];
    for (int k = 0; k < 8; ++k) row[k] = value[k];
    transpose(row);
    for (int l = 0; l < 8; ++l) {
        double* line = records + std::size_t(place[l]) * 8;
        set_line(line, change(line_at(line), row[l]));
    }
}

} // namespace lane_lines_detail

/// value[k] lane l = records[place[l] * 8 + k]; records are 64-byte lines.
template <class Place>
inline void load_lines(const double* records, const Place* place, Lanes (&value)[8])
{
    for (int l = 0; l < 8; ++l) value[l] = lane_lines_detail::line_at(records + std::size_t(place[l]) * 8);
    lane_lines_detail::transpose(value);
}

template <class Place>
inline void load_lines(const double* records, const Place* place, double (&value)[8])
{
    for (int k = 0; k < 8; ++k) value[k] = records[std::size_t(*place) * 8 + k];
}

/// value[k] lane l = records[place[l] * 4 + k]; records are half lines of 32 bytes.
template <class Place>
inline void load_half_lines(const double* records, const Place* place, Lanes (&value)[4])
{
    using namespace lane_lines_detail;
    Lanes row[4], pair[4];
    for (int l = 0; l < 4; ++l) {
        row[l] = __builtin_shufflevector(half_line_at(records + std::size_t(place[l]) * 4),
                                         half_line_at(records + std::size_t(place[l + 4]) * 4), 0, 1, 2, 3, 4,
                                         5, 6, 7);
    }
    for (int l = 0; l < 4; l += 2) {
        pair[l] = __builtin_shufflevector(row[l], row[l + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        pair[l + 1] = __builtin_shufflevector(row[l], row[l + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int odd = 0; odd < 2; ++odd) {
        value[odd] = __builtin_shufflevector(pair[odd], pair[2 + odd], 0, 1, 8, 9, 4, 5, 12, 13);
        value[2 + odd] = __builtin_shufflevector(pair[odd], pair[2 + odd], 2, 3, 10, 11, 6, 7, 14, 15);
    }
}

template <class Place>
inline void load_half_lines(const double* records, const Place* place, double (&value)[4])
{
    for (int k = 0; k < 4; ++k) value[k] = records[std::size_t(*place) * 4 + k];
}

/// records[place[l] * 8 + k] += lane l of value[k], lane after lane, so that places may repeat.
template <class Place>
inline void add_to_lines(double* records, const Place* place, const Lanes (&value)[8])
{
    lane_lines_detail::change_lines(records, place, value, std::plus<>{});
}

template <class Place>
inline void add_to_lines(double* records, const Place* place, const double (&value)[8])
{
    for (int k = 0; k < 8; ++k) records[std::size_t(*place) * 8 + k] += value[k];
}

/// records[place[l] * 8 + k] -= lane l of value[k], likewise.
template <class Place>
inline void subtract_from_lines(double* records, const Place* place, const Lanes (&value)[8])
{
    lane_lines_detail::change_lines(records, place, value, std::minus<>{});
}

template <class Place>
inline void subtract_from_lines(double* records, const Place* place, const double (&value)[8])
{
    for (int k = 0; k < 8; ++k) records[std::size_t(*place) * 8 + k] -= value[k];
}

/// values[place[l]] += lane l, lane after lane.
template <class Place>
inline void add_to_places(double* values, const Place* place, Lanes a)
{
    alignas(sizeof(Lanes)) double lane[lane_count];
    std::memcpy(lane, &a, sizeof a);
    for (int l = 0; l < lane_count; ++l) values[place[l]] += lane[l];
}

template <class Place>
inline void add_to_places(double* values, const Place* place, double a)
{
    values[*place] += a;
}

/// Sum over the lanes, in a fixed order.
inline double sum_of_lanes(Lanes a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

inline double sum_of_lanes(double a)
{
    return a;
}

/// line[k] += sum over the lanes of value[k], in the order of sum_of_lanes: halves are added while columns
/// become rows.
inline void add_sums_to_line(double* line, const Lanes (&value)[8])
{
    Lanes half[4], quarter[2];
    for (int k = 0; k < 4; ++k) {
        half[k] = __builtin_shufflevector(value[k], value[k + 4], 0, 1, 2, 3, 8, 9, 10, 11) +
                  __builtin_shufflevector(value[k], value[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
    for (int k = 0; k < 2; ++k) {
        quarter[k] = __builtin_shufflevector(half[k], half[k + 2], 0, 1, 8, 9, 4, 5, 12, 13) +
                     __builtin_shufflevector(half[k], half[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    const Lanes sum = __builtin_shufflevector(quarter[0], quarter[1], 0, 8, 2, 10, 4, 12, 6, 14) +
                      __builtin_shufflevector(quarter[0], quarter[1], 1, 9, 3, 11, 5, 13, 7, 15);
    lane_lines_detail::set_line(line, lane_lines_detail::line_at(line) + sum);
}

inline void add_sums_to_line(double* line, const double (&value)[8])
{
    for (int k = 0; k < 8; ++k) line[k] += value[k];
}

/// 1 / sqrt(a) to 6e-9 (one Newton step on the machine's estimate of 14 bits), or better.
inline Lanes reciprocal_root(Lanes a)
{
#if defined(__AVX512F__)
    const auto y = reinterpret_cast<Lanes>(_mm512_maskz_rsqrt14_pd(0xff, reinterpret_cast<__m512d>(a)));
    return y * (1.5 - 0.5 * a * (y * y));
#else
    Lanes y{};
    for (int l = 0; l < lane_count; ++l) y[l] = 1 / std::sqrt(a[l]);
    return y;
#endif
}

inline double reciprocal_root(double a)
{
    return 1 / std::sqrt(a);
}

/// 1 / a to 4e-9 (one Newton step on the machine's estimate of 14 bits), or better.
inline Lanes reciprocal(Lanes a)
{
#if defined(__AVX512F__)
    const auto y = reinterpret_cast<Lanes>(_mm512_maskz_rcp14_pd(0xff, reinterpret_cast<__m512d>(a)));
    return y * (2.0 - a * y);
#else
    return 1.0 / a;
#endif
}

inline double reciprocal(double a)
{
    return 1 / a;
}

} // namespace plash

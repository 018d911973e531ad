#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/// A lane type holds one value of each of several elements, so that one kernel text serves a batch
/// (Lanes, eight elements at once) and a single element (double, the readable reference that tests
/// compare the batch with). Arithmetic, comparison and `mask ? a : b` work alike on both.
namespace plash {

inline constexpr int lane_count = 8;

/// Eight doubles in one AVX-512 register (or what the compiler makes of it on a smaller machine).
using Lanes = double __attribute__((vector_size(8 * lane_count)));
/// What a comparison of Lanes gives: all bits set where true.
using LaneMask = std::int64_t __attribute__((vector_size(8 * lane_count)));

/// Number of elements that one value of a lane type carries.
template <class Lane>
inline constexpr int lanes_in = sizeof(Lane) / sizeof(double);

/// What a comparison of two lane values gives: bool for double, LaneMask for Lanes.
template <class Lane>
using MaskOf = decltype(Lane{} < Lane{});

/// The values at address[0 .. lanes), at any alignment.
template <class Lane>
inline Lane load(const double* address)
{
    Lane value;
    std::memcpy(&value, address, sizeof value);
    return value;
}

template <class Lane>
inline void store(double* address, Lane value)
{
    std::memcpy(address, &value, sizeof value);
}

/// The same value in every lane.
template <class Lane>
inline Lane broadcast(double value)
{
    return value - Lane{};
}

inline double sqrt(double a)
{
    return std::sqrt(a);
}

inline Lanes sqrt(Lanes a)
{
    alignas(sizeof(Lanes)) double values[lane_count];
    std::memcpy(values, &a, sizeof a);
    for (double& value : values) value = std::sqrt(value); // becomes one vector instruction
    std::memcpy(&a, values, sizeof a);
    return a;
}

inline double abs(double a)
{
    return std::fabs(a);
}

inline Lanes abs(Lanes a)
{
    const LaneMask without_sign = reinterpret_cast<LaneMask>(a) & 0x7fffffffffffffffLL;
    return reinterpret_cast<Lanes>(without_sign);
}

inline double min(double a, double b)
{
    return a < b ? a : b;
}

/// As `a < b ? a : b`, which compilers make two instructions of; likewise max.
inline Lanes min(Lanes a, Lanes b)
{
#if defined(__AVX512F__)
    return reinterpret_cast<Lanes>(
        _mm512_maskz_min_pd(0xff, reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b)));
#else
    return a < b ? a : b;
#endif
}

inline double max(double a, double b)
{
    return a > b ? a : b;
}

inline Lanes max(Lanes a, Lanes b)
{
#if defined(__AVX512F__)
    return reinterpret_cast<Lanes>(
        _mm512_maskz_max_pd(0xff, reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b)));
#else
    return a > b ? a : b;
#endif
}

inline bool any(bool mask)
{
    return mask;
}

inline bool any(LaneMask mask)
{
#if defined(__AVX512DQ__)
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0;
#else
    std::int64_t bits = 0;
    for (int lane = 0; lane < lane_count; ++lane) bits |= mask[lane];
    return bits != 0;
#endif
}

inline bool lane_of(bool mask, int)
{
    return mask;
}

inline bool lane_of(LaneMask mask, int lane)
{
    return mask[lane] != 0;
}

/// One bit a lane: set where the mask is.
inline unsigned bits_of(LaneMask mask)
{
#if defined(__AVX512DQ__)
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < lane_count; ++lane) bits |= (mask[lane] ? 1u : 0u) << lane;
    return bits;
#endif
}

/// Element `lane` of a batch value (the value itself for a single element).
inline double lane_of(double a, int)
{
    return a;
}

inline double lane_of(Lanes a, int lane)
{
    return a[lane];
}

inline void set_lane(double& a, int, double value)
{
    a = value;
}

inline void set_lane(Lanes& a, int lane, double value)
{
    a[lane] = value;
}

/// table[position] for every lane.
inline double gather(const double* table, std::int64_t position)
{
    return table[position];
}

inline Lanes gather(const double* table, LaneMask position)
{
#if defined(__AVX512F__)
    return _mm512_mask_i64gather_pd(Lanes{}, 0xff, reinterpret_cast<__m512i>(position), table, 8);
#else
    Lanes result{};
    for (int lane = 0; lane < lane_count; ++lane) result[lane] = table[position[lane]];
    return result;
#endif
}

/// function(value) for every lane, for what has no vector form (table look-up, pow).
template <class Lane, class Function>
inline Lane map_lanes(Lane a, Function&& function)
{
    Lane result{};
    for (int lane = 0; lane < lanes_in<Lane>; ++lane) set_lane(result, lane, function(lane_of(a, lane)));
    return result;
}

} // namespace plash

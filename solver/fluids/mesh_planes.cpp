#include "solver/fluids/mesh_planes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace plash {

namespace {

constexpr double growth = 1.1;
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr char axis_names[] = "xyz";

/// What the water of one part asks for along one axis.
struct Body {
    std::vector<double> planes; ///< of its pieces
    double size = 0;            ///< of its smallest piece along the axis [length]
};

/// Coordinates that differ by more than a deck's precision, ascending.
std::vector<double> distinct_planes(std::vector<double> values, double precision)
{
    std::sort(values.begin(), values.end());
    std::vector<double> planes;
    for (double value : values)
        if (planes.empty() || value - planes.back() > precision) planes.push_back(value);
    return planes;
}

std::vector<Body> bodies_along(const Water& water, int axis, double precision)
{
    std::map<Index, std::vector<double>> values;
    for (const WaterPiece& piece : water.pieces)
        for (const Vec3& corner : piece.corners) values[piece.part].push_back(corner.*vector_component[axis]);
    std::vector<Body> bodies;
    for (auto& [part, list] : values) {
        Body body;
        body.planes = distinct_planes(std::move(list), precision);
        body.size = unlimited;
        for (std::size_t i = 1; i < body.planes.size(); ++i)
            body.size = std::min(body.size, body.planes[i] - body.planes[i - 1]);
        bodies.push_back(std::move(body));
    }
    return bodies;
}

/// A stretch along an axis between two places where something begins or ends.
struct Interval {
    double begin, end;
    double size;                ///< wanted inside [length]
    std::vector<double> planes; ///< given ones, `begin` left away; empty: to be made
    bool dry = false;           ///< no water stands in it

    /// Thinner than half a cell, without water: its own layer of cells would set the step and the spacing of
    /// coupling points for all.
    bool sliver() const { return dry && end - begin < 0.5 * size; }
};

/// How far the mesh reaches along one axis.
std::array<double, 2> reach_along(int axis, const Water& water, const std::vector<WaterWall>& walls,
                                  const FluidChoice& choice, const std::vector<Vec3>& structure, int up,
                                  double size)
{
    const auto component = vector_component[axis];
    const double low = water.low.*component, high = water.high.*component;
    std::array<double, 2> reach{low, high};
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1 : 1;
        // The nearest wall on this side ends the mesh.
        const WaterWall* nearest = nullptr;
        for (const WaterWall& wall : walls) {
            if (wall.axis != axis || wall.water_above != (side == 0)) continue;
            if (!nearest || sign * (wall.at - nearest->at) < 0) nearest = &wall;
        }
        if (nearest) {
            reach[side] = nearest->at;
            continue;
        }
        double furthest = sign * reach[side];
        for (const Vec3& node : structure) furthest = std::max(furthest, sign * (node.*component) + 2 * size);
        const bool upward = up == 2 * axis + side;
        if (upward && furthest == sign * reach[side]) // room for waves
            furthest += std::max(2 * size, 0.25 * (high - low));
        if (upward && choice.height > 0) furthest = sign * reach[side] + choice.height;
        reach[side] = sign * furthest;
    }
    if (!choice.region) return reach;
    reach = {choice.region->low.*component, choice.region->high.*component};
    const double precision = 1e-6 * (high - low);
    if (reach[0] > low + precision || reach[1] < high - precision)
        throw DeckError(choice.where,
                        fmt::format("*PLASH_FLUID, field BOXID: the box from {0} = {1:g} to {2:g} does "
                                    "not hold the water from {0} = {3:g} to {4:g}",
                                    axis_names[axis], reach[0], reach[1], low, high));
    return reach;
}

std::vector<Interval> intervals_along(const std::vector<Body>& bodies, const std::array<double, 2>& reach,
                                      double scale, bool as_given, double precision)
{
    std::vector<double> breaks{reach[0], reach[1]};
    for (const Body& body : bodies) {
        breaks.push_back(body.planes.front());
        breaks.push_back(body.planes.back());
    }
    breaks = distinct_planes(std::move(breaks), precision);
    std::vector<Interval> intervals;
    for (std::size_t i = 1; i < breaks.size(); ++i) {
        Interval interval{breaks[i - 1], breaks[i], unlimited, {}, false};
        const Body* finest = nullptr;
        for (const Body& body : bodies) {
            if (body.planes.front() > interval.begin + precision ||
                body.planes.back() < interval.end - precision)
                continue;
            if (!finest || body.size < finest->size) finest = &body;
        }
        if (finest) {
            interval.size = scale * finest->size;
            if (as_given)
                for (double plane : finest->planes)
                    if (plane > interval.begin + precision && plane < interval.end - precision)
                        interval.planes.push_back(plane);
            if (as_given) interval.planes.push_back(interval.end);
        }
        intervals.push_back(std::move(interval));
    }
    // Where no water stands: as fine as the water beside.
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        if (intervals[i].size < unlimited) continue;
        intervals[i].dry = true;
        if (i > 0) intervals[i].size = intervals[i - 1].size;
        for (std::size_t j = i + 1; j < intervals.size(); ++j) {
            if (intervals[j].size == unlimited) continue;
            intervals[i].size = std::min(intervals[i].size, intervals[j].size);
            break;
        }
    }
    return intervals;
}

} // namespace

void append_interval(std::vector<double>& planes, double end, double wanted, double first, double last)
{
    const double begin = planes.back(), length = end - begin;
    std::vector<double> left, right; // widths from both ends
    double from_left = first > 0 ? first : unlimited, from_right = last > 0 ? last : unlimited;
    double sum = 0;
    while (sum < length * (1 - 1e-9)) {
        const bool leftward = from_left <= from_right;
        double& limit = leftward ? from_left : from_right;
        limit *= growth;
        if (limit >= wanted) { // the rest is even
            const double rest = std::max(1.0, std::round((length - sum) / wanted));
            left.insert(left.end(), static_cast<std::size_t>(rest), wanted);
            sum += rest * wanted;
            break;
        }
        (leftward ? left : right).push_back(limit);
        sum += limit;
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    const double stretch = length / sum;
    double at = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        at += stretch * left[i];
        planes.push_back(i + 1 == left.size() ? end : begin + at);
    }
}

MeshPlanes mesh_planes(const Water& water, const std::vector<WaterWall>& walls, const FluidChoice& choice,
                       const std::vector<Vec3>& structure, int up)
{
    MeshPlanes result;
    const double scale = choice.size > 0 ? choice.size / water.smallest_size : 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double precision = 1e-4 * water.smallest_size;
        const std::vector<Body> bodies = bodies_along(water, axis, precision);
        double finest = unlimited;
        for (const Body& body : bodies) finest = std::min(finest, body.size);
        const std::array<double, 2> reach =
            reach_along(axis, water, walls, choice, structure, up, scale * finest);
        std::vector<Interval> intervals = intervals_along(bodies, reach, scale, choice.size == 0, precision);
        // A neighbour that is much finer sets the size at the common plane.
        const auto limit = [&](std::size_t own, std::size_t other) {
            return intervals[other].size < 0.99 * intervals[own].size ? intervals[other].size : 0;
        };
        std::vector<double>& planes = result[axis];
        planes.push_back(reach[0]);
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            Interval& interval = intervals[i];
            if (interval.sliver() && i == 0) continue; // the first cells of the next reach to the end
            if (interval.sliver() && i + 1 == intervals.size()) {
                planes.back() = interval.end;
                continue;
            }
            const double first = i > 0 ? limit(i, i - 1) : 0;
            const double last = i + 1 < intervals.size() ? limit(i, i + 1) : 0;
            const bool even = first == 0 && last == 0;
            if (even && !interval.planes.empty())
                planes.insert(planes.end(), interval.planes.begin(), interval.planes.end());
            else
                append_interval(planes, interval.end, interval.size, first, last);
        }
    }
    return result;
}

} // namespace plash

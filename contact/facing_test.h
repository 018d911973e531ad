#pragma once

#include "contact/mesh_motion.h"

#include <algorithm>
#include <span>
#include <vector>

namespace plash {

/// How far two surfaces whose outward normals meet at cosine -c face one another: 1 up to 37 degrees of tilt,
/// 0 from 60 degrees on. What is missing to 1 is left to nodes on segments: rims of shells on faces, sharp
/// corners.
inline double facing_weight(double c)
{
    return std::min(1.0, std::max(0.0, (c - 0.5) / 0.3));
}

/// Two facets that may press on one another.
struct FacingPair {
    Index first = none, second = none;
    double due = 0;     ///< path before which they cannot touch [length]
    Index touch = none; ///< its place among the touches of the last cycle
};

/// A pair that the cheap test has left to be looked at.
struct FacingCandidate {
    Index pair = none;
    bool alone = false; ///< neither facet touched anything in the last cycle
    Index old = none;   ///< its place among the touches of the last cycle
    Vec3 old_normal{};  ///< of that touch: the side on which it is kept
    Vec3 normal{};      ///< along which to project, on the side of the second facet's normal
    Vec3 first_normal{}, second_normal{};
    double along = 0; ///< cosine between the facets' normals
};

/// Cheap test of pairs of facets, eight at a time: whether they may touch in this step; those that do not are
/// told before which path they cannot (FacingPair::due).
///
/// A pair cannot touch
/// - while all corners of the first lie beyond the second's plane by more than the contact reaches;
/// - while their normals do not face one another. On a path p (of any two nodes relative to one another) the
///   normal of a facet with diagonals d1, d2 turns by at most (|d1| + |d2|) p / |d1 x d2|, to first order,
///   and by no more than twice as much while that stays below a quarter;
/// - while their shadows along the mean of the normals are apart, or all of one lies too far over the other.
///   Points that touch lie over one another along a normal that turns with the facets. Between shells
///   `too far` is the same on both sides, as either may be the one that is kept, and only `gap` outward once
///   the side is known: from the pair's own touch, or because nothing around has met.
class FacingTest {
public:
    /// standing  by facet: weight of its normal in the mean, which is the direction of projection
    FacingTest(const ContactMesh& mesh, const ContactMotion& motion, const std::vector<double>& standing)
        : mesh_(mesh), motion_(motion), standing_(standing)
    {}

    /// Adds to `left` what of `due` (where pair, alone, old and old_normal are given) has to be looked at.
    void test(std::vector<FacingPair>& pairs, std::span<const FacingCandidate> due,
              std::vector<FacingCandidate>& left) const;

private:
    const ContactMesh& mesh_;
    const ContactMotion& motion_;
    const std::vector<double>& standing_;

    void test_batch(std::vector<FacingPair>& pairs, std::span<const FacingCandidate> batch,
                    std::vector<FacingCandidate>& left) const;
};

} // namespace plash

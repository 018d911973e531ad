#pragma once

#include "core/archive.h"
#include "math/lanes.h"
#include "sph/cells.h"
#include "sph/motion_record.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace plash {

/// What the search needs to know of particles and their images, by sorted place: all particles first. Images
/// are listed as neighbours, but have none of their own.
struct SearchInput {
    std::span<const MotionRecord> motion; ///< positions [length]
    /// Two particles are listed below the sum of theirs: half the radius of the kernel, and of a skin
    /// [length].
    std::span<const float> reach;
    std::size_t real_count = 0; ///< particles
    /// Of particles alone; 1: no neighbours of its own, as an image. Empty: nobody sleeps.
    std::span<const std::uint8_t> asleep;
    /// Groups of particles and who sees whom: particles a and b are neighbours when bit group[b] of
    /// sees[group[a]] is set. Empty: all see all.
    std::span<const std::uint8_t> group;
    std::span<const std::uint64_t> sees;
};

/// Inside neighbours stand in pairs of batches, so that pair loops take two batches at once without asking.
inline constexpr int pair_count = 2 * lane_count;

/// Neighbours of a run of consecutive sorted particles [begin, end). A pair with both particles in the run
/// and neither asleep stands once, with one of the two ("inside"): the pair loop adds to both
/// sides. Any other pair stands with each of its particles that are awake ("outside"). So a run is worked on
/// by one thread without touching what others write, in an order that depends on the positions alone.
///
/// Lists inside are filled up to whole pairs of batches with the particle itself, which exerts nothing on
/// itself; those outside follow one another without gaps. All places are 16 bits wide: lists are most of what
/// a particle costs in memory.
struct NeighbourRun {
    struct Counts {
        std::uint16_t inside = 0, outside = 0; ///< entries
    };
    Index begin = 0, end = 0;
    std::vector<Counts> counts;         ///< by particle of the run
    std::vector<std::uint16_t> inside;  ///< offsets from `begin`
    std::vector<std::uint16_t> outside; ///< numbers in `halo`; a batch may be read past the last list
    std::vector<Index> halo;            ///< sorted places of all that the outside lists name

    Index length() const { return end - begin; }
    void serialise(Archive& archive) { archive(begin, end, counts, inside, outside, halo); }
};

/// visit(place, other, inside) for each entry of a run's lists: an inside pair stands once, any other with
/// each of its particles that are awake. Lists inside are filled up with the particle itself.
template <class Visit>
void for_listed(const NeighbourRun& run, Visit&& visit)
{
    const std::uint16_t* inside = run.inside.data();
    const std::uint16_t* outside = run.outside.data();
    for (Index i = 0; i < run.length(); ++i) {
        for (int k = 0; k < run.counts[i].inside; ++k) visit(run.begin + i, run.begin + *inside++, true);
        for (int k = 0; k < run.counts[i].outside; ++k) visit(run.begin + i, run.halo[*outside++], false);
    }
}

/// Longest run; offsets in a run fit sixteen bits. A run whose halo would not fit them is cut in halves.
inline constexpr Index longest_run = 8192;

/// The length of the longest of some runs.
inline Index longest_of(const std::vector<NeighbourRun>& runs)
{
    Index longest = 0;
    for (const NeighbourRun& run : runs) longest = std::max(longest, run.length());
    return longest;
}

/// Lists of all pairs closer than the sum of their reaches, and of some that are further apart by less than
/// 4e-6 of a cell: distances are looked at in single precision. `cells` must have sorted `input.position`
/// with a side of at least the largest sum. largest_halo  that a run may have; below that of 16 bits only in
/// tests
void build_neighbours(const ParticleCells& cells, const SearchInput& input, std::vector<NeighbourRun>& runs,
                      std::size_t largest_halo = 65535);

} // namespace plash

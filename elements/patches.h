#pragma once

#include "core/state.h"
#include "elements/corner_access.h"

#include <cstdint>
#include <omp.h>
#include <span>
#include <vector>

namespace plash {

/// The nodes of one patch as one thread works on them: four doubles a node (the fourth is padding), in the
/// patch's own numbering, so that a batch of corners is loaded from and added to first-level cache.
struct NodeCopies {
    using Values = std::vector<double, CacheAligned<double>>;
    Values position;
    Values velocity;
    Values force;
    Values angular_velocity; ///< only with rotations, like `moment`
    Values moment;
};

/// The elements of one group, cut into compact patches of a fixed number of elements that do not depend on
/// the number of threads. A patch sums the forces of its elements in a fixed order in a copy of its nodes;
/// nodes inside the patch then go straight to the State, and nodes that several patches touch are summed in
/// patch order afterwards. So the result has the same bits for any number of threads, without atomics or
/// colours.
///
/// Elements are worked on in batches of lane_count. The last batch of the group may be part empty: its spare
/// lanes repeat the last element and must not be summed or scattered (active_lanes).
class Patches {
public:
    struct Patch {
        Index first_batch = 0;
        Index batch_count = 0;
        Index first_node = 0; ///< into `nodes`
        Index node_count = 0;
    };

    Patches() = default;

    /// corners       number of corners an element
    /// elements      what the group calls its elements (positions in the Model's element array)
    /// connectivity  `corners` State indices for each of `elements`, in the same order
    /// position      of all nodes of the State, for cutting along compact boxes
    /// patch_length  elements a patch, a multiple of lane_count
    Patches(int corners, std::span<const Index> elements, std::span<const Index> connectivity,
            std::span<const Vec3> position, int patch_length);

    int corners = 0;
    Index element_count = 0;
    std::vector<Patch> patches;
    std::vector<Index> elements;            ///< batch x lane: as given to the constructor
    std::vector<std::uint16_t> corner_node; ///< batch x corner x lane: offset into a copy (4 x local node)
    std::vector<Index> nodes;               ///< patch after patch: State index of each local node

    Index batch_count() const { return static_cast<Index>(elements.size() / lane_count); }
    /// Lanes of a batch that hold an element of their own.
    int active_lanes(Index batch) const
    {
        return static_cast<int>(std::min<Index>(lane_count, element_count - batch * lane_count));
    }
    /// Corner offsets of one corner of one batch, one a lane.
    const std::uint16_t* corner_offsets(Index batch, int corner) const
    {
        return corner_node.data() + (static_cast<std::size_t>(batch) * corners + corner) * lane_count;
    }

    /// Gives corners of cross sections copies of their own, so that what elements exert there can be told
    /// apart. sections_of(element, node)  bits of the sections that want the element's force on the node
    template <class SectionsOf>
    void watch(std::size_t state_size, SectionsOf&& sections_of)
    {
        std::vector<std::uint64_t> bits(corner_node.size());
        bool any = false;
        for (const Patch& patch : patches) {
            for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
                for (int corner = 0; corner < corners; ++corner) {
                    const std::size_t place =
                        (static_cast<std::size_t>(batch) * corners + corner) * lane_count;
                    for (int lane = 0; lane < lane_count; ++lane) {
                        const Index element = elements[static_cast<std::size_t>(batch) * lane_count + lane];
                        const Index node = nodes[patch.first_node + corner_node[place + lane] / 4];
                        bits[place + lane] = sections_of(element, node);
                        any = any || bits[place + lane] != 0;
                    }
                }
            }
        }
        if (any) separate(bits, state_size);
    }
    /// visit(section bits, node, force, moment) for what the last for_each has found; in a fixed order.
    template <class Visit>
    void for_each_watched(Visit&& visit) const
    {
        for (const Watched& watched : watched_) {
            const Index slot = slot_[watched.entry];
            visit(watched.sections, nodes[watched.entry], slot_force_[slot],
                  slot_moment_.empty() ? Vec3{} : slot_moment_[slot]);
        }
    }

    /// work(patch_number, patch, copies) for every patch, on all threads; `copies` holds position and
    /// velocity (and angular velocity, with rotations) and zeroed force (and moment), which are added to the
    /// State.
    template <class Work>
    void for_each(State& state, bool with_rotation, Work&& work)
    {
        prepare_scratch(with_rotation);
        const auto patch_total = static_cast<std::ptrdiff_t>(patches.size());
#pragma omp parallel if (patch_total > 1)
        {
            NodeCopies& copies = scratch_[omp_get_thread_num()];
#pragma omp for schedule(dynamic)
            for (std::ptrdiff_t number = 0; number < patch_total; ++number) {
                load(patches[number], state, with_rotation, copies);
                work(number, patches[number], copies);
                store(patches[number], state, with_rotation, copies);
            }
            sum_shared(state, with_rotation);
        }
    }

private:
    std::vector<Index> slot_; ///< like `nodes`: where a shared node's sum goes, none = node of one patch
    std::vector<Index> shared_node_;  ///< State index of each node that several patches touch
    std::vector<Index> shared_begin_; ///< its slots: shared_begin_[i] .. shared_begin_[i+1]
    std::vector<Vec3> slot_force_;
    std::vector<Vec3> slot_moment_;
    std::vector<NodeCopies> scratch_; ///< one a thread
    Index largest_node_count_ = 0;
    struct Watched {
        Index entry;            ///< into `nodes`
        std::uint64_t sections; ///< bits
    };
    std::vector<Watched> watched_;

    void number_nodes(std::span<const Index> connectivity, std::span<const Index> order,
                      std::size_t state_size);
    void assign_slots(std::size_t state_size);
    void separate(const std::vector<std::uint64_t>& bits, std::size_t state_size);
    void prepare_scratch(bool with_rotation);
    void load(const Patch&, const State&, bool with_rotation, NodeCopies&) const;
    void store(const Patch&, State&, bool with_rotation, const NodeCopies&);
    /// To be called by all threads of a parallel region.
    void sum_shared(State&, bool with_rotation);
};

} // namespace plash

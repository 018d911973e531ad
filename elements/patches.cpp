#include "elements/patches.h"

#include "core/parallel.h"
#include "math/bisection.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace plash {

Patches::Patches(int corner_count, std::span<const Index> group_elements, std::span<const Index> connectivity,
                 std::span<const Vec3> position, int patch_length)
    : corners(corner_count), element_count(static_cast<Index>(group_elements.size()))
{
    std::vector<Vec3> center(group_elements.size());
    for (std::size_t element = 0; element < center.size(); ++element) {
        for (int corner = 0; corner < corners; ++corner) {
            center[element] += position[connectivity[element * corners + corner]];
        }
    }
    std::vector<Index> order(group_elements.size());
    std::iota(order.begin(), order.end(), 0);
    bisect(order, center, patch_length);

    const Index batches = (element_count + lane_count - 1) / lane_count;
    const Index batches_per_patch = patch_length / lane_count;
    for (Index batch = 0; batch < batches; batch += batches_per_patch) {
        patches.push_back({batch, std::min(batches_per_patch, batches - batch), 0, 0});
    }
    order.resize(static_cast<std::size_t>(batches) * lane_count, order.empty() ? 0 : order.back());
    for (Index element : order) elements.push_back(group_elements[element]);
    number_nodes(connectivity, order, position.size());
    assign_slots(position.size());
}

void Patches::number_nodes(std::span<const Index> connectivity, std::span<const Index> order,
                           std::size_t state_size)
{
    corner_node.resize(order.size() * corners);
    std::vector<Index> local(state_size, none);
    for (Patch& patch : patches) {
        patch.first_node = static_cast<Index>(nodes.size());
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            for (int lane = 0; lane < lane_count; ++lane) {
                const Index element = order[static_cast<std::size_t>(batch) * lane_count + lane];
                for (int corner = 0; corner < corners; ++corner) {
                    const Index node = connectivity[static_cast<std::size_t>(element) * corners + corner];
                    if (local[node] == none) {
                        local[node] = static_cast<Index>(nodes.size()) - patch.first_node;
                        nodes.push_back(node);
                    }
                    const std::size_t place =
                        (static_cast<std::size_t>(batch) * corners + corner) * lane_count;
                    corner_node[place + lane] = static_cast<std::uint16_t>(4 * local[node]);
                }
            }
        }
        patch.node_count = static_cast<Index>(nodes.size()) - patch.first_node;
        largest_node_count_ = std::max(largest_node_count_, patch.node_count);
        for (Index i = patch.first_node; i < patch.first_node + patch.node_count; ++i) local[nodes[i]] = none;
    }
}

void Patches::assign_slots(std::size_t state_size)
{
    std::vector<Index> touching(state_size, 0);
    for (Index node : nodes) ++touching[node];
    for (const Watched& watched : watched_) { // a slot even where nobody else touches the node
        if (touching[nodes[watched.entry]] == 1) ++touching[nodes[watched.entry]];
    }
    std::vector<Index> next(state_size, none);
    shared_begin_.push_back(0);
    for (Index node : nodes) {
        if (touching[node] > 1 && next[node] == none) {
            next[node] = shared_begin_.back();
            shared_node_.push_back(node);
            shared_begin_.push_back(shared_begin_.back() + touching[node]);
        }
    }
    slot_.reserve(nodes.size());
    for (Index node : nodes) slot_.push_back(touching[node] > 1 ? next[node]++ : none);
    slot_force_.resize(shared_begin_.back());
}

void Patches::separate(const std::vector<std::uint64_t>& bits, std::size_t state_size)
{
    const std::vector<Index> before = std::exchange(nodes, {});
    largest_node_count_ = 0;
    for (Patch& patch : patches) {
        const Index first_before = patch.first_node;
        patch.first_node = static_cast<Index>(nodes.size());
        std::map<std::pair<Index, std::uint64_t>, Index> local; // by old local number and sections
        const std::size_t begin = static_cast<std::size_t>(patch.first_batch) * corners * lane_count;
        const std::size_t end = begin + static_cast<std::size_t>(patch.batch_count) * corners * lane_count;
        for (std::size_t place = begin; place < end; ++place) {
            const Index old_number = corner_node[place] / 4;
            const auto number = static_cast<Index>(nodes.size()) - patch.first_node;
            const auto [entry, is_new] = local.try_emplace({old_number, bits[place]}, number);
            corner_node[place] = static_cast<std::uint16_t>(4 * entry->second);
            if (!is_new) continue;
            if (bits[place] != 0) watched_.push_back({static_cast<Index>(nodes.size()), bits[place]});
            nodes.push_back(before[first_before + old_number]);
        }
        patch.node_count = static_cast<Index>(nodes.size()) - patch.first_node;
        largest_node_count_ = std::max(largest_node_count_, patch.node_count);
    }
    slot_.clear();
    shared_node_.clear();
    shared_begin_.clear();
    slot_force_.clear();
    assign_slots(state_size);
}

void Patches::prepare_scratch(bool with_rotation)
{
    const std::size_t threads = omp_get_max_threads();
    const std::size_t length = 4 * static_cast<std::size_t>(largest_node_count_);
    if (scratch_.size() < threads) scratch_.resize(threads);
    for (NodeCopies& copies : scratch_) {
        copies.position.resize(length);
        copies.velocity.resize(length);
        copies.force.resize(length);
        if (!with_rotation) continue;
        copies.angular_velocity.resize(length);
        copies.moment.resize(length);
    }
    if (with_rotation) slot_moment_.resize(slot_force_.size());
}

void Patches::load(const Patch& patch, const State& state, bool with_rotation, NodeCopies& copies) const
{
    const auto put = [](double* place, const Vec3& value) {
        place[0] = value.x;
        place[1] = value.y;
        place[2] = value.z;
    };
    const std::size_t length = 4 * static_cast<std::size_t>(patch.node_count);
    for (Index i = 0; i < patch.node_count; ++i) {
        const Index node = nodes[patch.first_node + i];
        put(&copies.position[4 * i], state.position[node]);
        put(&copies.velocity[4 * i], state.velocity[node]);
        if (with_rotation) put(&copies.angular_velocity[4 * i], state.angular_velocity[node]);
    }
    std::fill_n(copies.force.begin(), length, 0.0);
    if (with_rotation) std::fill_n(copies.moment.begin(), length, 0.0);
}

void Patches::store(const Patch& patch, State& state, bool with_rotation, const NodeCopies& copies)
{
    const auto get = [](const double* place) { return Vec3{place[0], place[1], place[2]}; };
    for (Index i = 0; i < patch.node_count; ++i) {
        const Index node = nodes[patch.first_node + i];
        const Index slot = slot_[patch.first_node + i];
        const Vec3 force = get(&copies.force[4 * i]);
        if (slot == none) {
            state.force[node] += force;
        } else {
            slot_force_[slot] = force;
        }
        if (!with_rotation) continue;
        const Vec3 moment = get(&copies.moment[4 * i]);
        if (slot == none) {
            state.moment[node] += moment;
        } else {
            slot_moment_[slot] = moment;
        }
    }
}

void Patches::sum_shared(State& state, bool with_rotation)
{
    const auto shared = static_cast<std::ptrdiff_t>(shared_node_.size());
#pragma omp for schedule(static)
    for (std::ptrdiff_t i = 0; i < shared; ++i) {
        Vec3 force{}, moment{};
        for (Index slot = shared_begin_[i]; slot < shared_begin_[i + 1]; ++slot) {
            force += slot_force_[slot];
            if (with_rotation) moment += slot_moment_[slot];
        }
        state.force[shared_node_[i]] += force;
        if (with_rotation) state.moment[shared_node_[i]] += moment;
    }
}

} // namespace plash

#include "contact/pair_search.h"

#include "contact/closest_point.h"
#include "core/parallel.h"

#include <algorithm>
#include <numeric>

namespace plash {

namespace {

template <class Lane>
Vector3<Lane> in_all_lanes(const Vec3& v)
{
    return {broadcast<Lane>(v.x), broadcast<Lane>(v.y), broadcast<Lane>(v.z)};
}

} // namespace

PairSearch::PairSearch(const ContactMesh& mesh, const std::vector<std::array<Index, 8>>& solid_nodes,
                       const std::vector<std::array<Index, 8>>* thick_nodes, const Model* model)
    : solid_nodes_(&solid_nodes), thick_nodes_(thick_nodes), model_(model)
{
    // A third of the median facet: enough for dozens of cycles at speeds well below sound, and small enough
    // that nodes of a plain sheet do not see the facets beyond their own.
    margin_ = mesh.typical_size(0.5) / 3;
}

void PairSearch::update(const ContactMesh& mesh, const ContactMotion& motion,
                        const std::vector<std::uint8_t>* only)
{
    if (!holds(motion)) search(mesh, motion, only);
    pairs_.paths.advance(motion);
}

bool PairSearch::holds(const ContactMotion& motion)
{
    const NodeVectors& position = motion.position;
    if (searched_at_.size() != position.size()) return false;
    if (motion.travelled + motion.step_range < test_due_) return true;
    std::vector<Bounds> partial((position.size() + chunk_length - 1) / chunk_length);
    for_chunks(position.size(), [&](std::size_t begin, std::size_t end) {
        Bounds moved;
        for (std::size_t i = begin; i < end; ++i) moved.add(position[i] - searched_at_[i]);
        partial[begin / chunk_length] = moved;
    });
    Bounds moved;
    for (const Bounds& part : partial) {
        moved.add(part.low);
        moved.add(part.high);
    }
    const double left = margin_ - norm(moved.high - moved.low);
    test_due_ = motion.travelled + left;
    return left >= motion.step_range;
}

bool PairSearch::may_touch(const ContactMesh& mesh, Index node, Index number) const
{
    const ContactMesh::Facet& facet = mesh.facets[number];
    if ((mesh.nodes[node].acts_on & facet.belongs) == 0) return false;
    if (facet.rigid && facet.part == mesh.nodes[node].part) return false;
    for (Index corner : facet.corner) {
        if (corner == node) return false;
    }
    const Index solid = mesh.segments[number].solid;
    if (solid == none) return true;
    if (const auto* ten = model_ ? ten_nodes(*model_, solid) : nullptr)
        return std::find(ten->begin(), ten->end(), mesh.nodes[node].node) == ten->end();
    const auto solids = static_cast<Index>(solid_nodes_->size());
    for (Index behind : solid < solids ? (*solid_nodes_)[solid] : (*thick_nodes_)[solid - solids]) {
        if (behind == mesh.nodes[node].node) return false;
    }
    return true;
}

void PairSearch::search_nodes(const ContactMesh& mesh, std::span<const Vec3> position, double margin,
                              std::size_t begin, std::size_t end, const std::vector<std::uint8_t>* only,
                              PairList& found) const
{
    const auto acts = [&](Index node) { return mesh.nodes[node].acts_on != 0 && (!only || (*only)[node]); };
    std::vector<Index> candidates[lane_count];
    for (std::size_t first = begin; first < end; first += lane_count) {
        const int lanes = static_cast<int>(std::min<std::size_t>(lane_count, end - first));
        Bounds box;
        Vector3<Lanes> x{};
        Lanes half_thickness{};
        double thickest = 0;
        bool acting = false;
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index node = order_[first + std::min(lane, lanes - 1)];
            const Vec3& place = position[node];
            box.add(place);
            x.x[lane] = place.x;
            x.y[lane] = place.y;
            x.z[lane] = place.z;
            half_thickness[lane] = mesh.nodes[node].half_thickness;
            thickest = std::max(thickest, mesh.nodes[node].half_thickness);
            acting = acting || acts(node);
            candidates[lane].clear();
        }
        if (!acting) continue;
        box.grow(thickest);
        tree_.query(box, [&](Index number) {
            const ContactMesh::Facet& facet = mesh.facets[number];
            const SegmentCorners<Lanes> corners{in_all_lanes<Lanes>(position[facet.corner[0]]),
                                                in_all_lanes<Lanes>(position[facet.corner[1]]),
                                                in_all_lanes<Lanes>(position[facet.corner[2]]),
                                                in_all_lanes<Lanes>(position[facet.corner[3]])};
            const Lanes reach =
                max(half_thickness + facet.half_thickness, broadcast<Lanes>(facet.depth)) + margin;
            unsigned near = bits_of(closest_point(x, corners).distance2 <= reach * reach);
            near &= (1u << lanes) - 1;
            for (; near != 0; near &= near - 1) {
                const int lane = std::countr_zero(near);
                const Index node = order_[first + lane];
                if (acts(node) && may_touch(mesh, node, number)) candidates[lane].push_back(number);
            }
        });
        for (int lane = 0; lane < lanes; ++lane) {
            if (candidates[lane].empty()) continue;
            std::sort(candidates[lane].begin(), candidates[lane].end());
            found.node.insert(found.node.end(), candidates[lane].size(), order_[first + lane]);
            found.facet.insert(found.facet.end(), candidates[lane].begin(), candidates[lane].end());
        }
    }
}

void PairSearch::search(const ContactMesh& mesh, const ContactMotion& motion,
                        const std::vector<std::uint8_t>* only)
{
    ++searches_;
    of_all_ = only == nullptr;
    const NodeVectors& position = motion.position;
    searched_at_.assign(position.begin(), position.end());
    test_due_ = motion.travelled + margin_;
    // A node faster than the margin is seen a step ahead.
    const double margin = std::max(margin_, 1.5 * motion.step_range);
    std::vector<Bounds> boxes(mesh.facets.size());
    for_chunks(boxes.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ContactMesh::Facet& facet = mesh.facets[i];
            if (!facet.exposed) continue;
            for (Index corner : facet.corner) boxes[i].add(position[corner]);
            boxes[i].grow(std::max(facet.half_thickness, facet.depth) + margin);
        }
    });
    tree_.fit(boxes);

    if (order_.empty()) order_ = spatial_order(position);
    std::vector<PairList> found((position.size() + chunk_length - 1) / chunk_length);
    for_chunks(position.size(), [&](std::size_t begin, std::size_t end) {
        search_nodes(mesh, position, margin, begin, end, only, found[begin / chunk_length]);
    });
    sort_by_node(position.size(), found);
    set_owners(mesh);
}

void PairSearch::narrow(const ContactMesh& mesh, const std::vector<std::uint8_t>& only)
{
    if (!of_all_) {
        forget();
        return;
    }
    std::size_t kept = 0;
    for (std::size_t pair = 0; pair < pairs_.node.size(); ++pair) {
        if (!only[pairs_.node[pair]]) continue;
        pairs_.node[kept] = pairs_.node[pair];
        pairs_.facet[kept++] = pairs_.facet[pair];
    }
    pairs_.node.resize(kept);
    pairs_.facet.resize(kept);
    pairs_.node.shrink_to_fit();
    pairs_.facet.shrink_to_fit();
    of_all_ = false;
    set_owners(mesh);
}

void PairSearch::set_owners(const ContactMesh& mesh)
{
    pairs_.set_owners();
    pairs_.paths.set(mesh, pairs_.owner, pairs_.begin, pairs_.facet);
}

void PairList::set_owners()
{
    owner.clear();
    begin.clear();
    for (std::size_t pair = 0; pair < node.size(); ++pair) {
        if (!owner.empty() && owner.back() == node[pair]) continue;
        owner.push_back(node[pair]);
        begin.push_back(static_cast<Index>(pair));
    }
    begin.push_back(static_cast<Index>(node.size()));
    look_at_all();
}

void PairList::look_at_all()
{
    due.assign(node.size(), 0.0);
    quiet.assign(owner.size(), 0.0);
    close.assign(owner.size(), 0);
    others_due.assign(owner.size(), 0.0);
}

/// Nodes were searched in their order in space: brings the pairs into the order of the mesh's nodes.
void PairSearch::sort_by_node(std::size_t node_count, const std::vector<PairList>& found)
{
    std::vector<Index> next(node_count + 1);
    for (const PairList& part : found) {
        for (Index node : part.node) ++next[node + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    pairs_.node.resize(next.back());
    pairs_.facet.resize(next.back());
    for (const PairList& part : found) {
        for (std::size_t i = 0; i < part.node.size(); ++i) {
            const Index place = next[part.node[i]]++;
            pairs_.node[place] = part.node[i];
            pairs_.facet[place] = part.facet[i];
        }
    }
}

void PairSearch::leave_out(Index node)
{
    const auto [first, last] = std::equal_range(pairs_.node.begin(), pairs_.node.end(), node);
    std::fill(pairs_.due.begin() + (first - pairs_.node.begin()),
              pairs_.due.begin() + (last - pairs_.node.begin()), std::numeric_limits<double>::infinity());
    const auto owner = std::lower_bound(pairs_.owner.begin(), pairs_.owner.end(), node);
    if (owner == pairs_.owner.end() || *owner != node) return;
    pairs_.quiet[owner - pairs_.owner.begin()] = 0;
    pairs_.others_due[owner - pairs_.owner.begin()] = 0;
}

} // namespace plash

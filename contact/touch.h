#pragma once

#include "contact/mesh_motion.h"
#include "contact/pair_search.h"

namespace plash {

/// A node in contact with a facet, with what it remembers from cycle to cycle.
struct Touch {
    Index node = none;  ///< of the mesh
    Index facet = none; ///< of the mesh
    int count = 0;      ///< of touches of this node from here on
    double s = 0, t = 0;
    Vec3 normal{};          ///< unit, from the facet to the node's side
    double penetration = 0; ///< geometric: sum of half thicknesses less the distance [length]
    double baseline = 0;    ///< penetration that gives no force, because the node was found there [length]
    double rounding = 0;    ///< width over which the force sets in [length]
    double stiffness = 0;   ///< [force/length]
    double weight =
        -1;          ///< share that is not left to segments on segments, as at its onset; -1: not known yet
    Vec3 friction{}; ///< tangential force on the node [force]
    Vec3 force{};    ///< whole force on the node [force]

    double active_penetration() const { return penetration - baseline; }
};

/// Touches of one cycle in chunks, by rising node; a node has at most three, with clearly different normals.
struct TouchList {
    std::vector<std::vector<Touch>> chunks;
    std::vector<const Touch*> first; ///< by mesh node: its first touch, or nullptr

    std::span<const Touch> of(Index node) const
    {
        if (first.empty() || first[node] == nullptr) return {};
        return {first[node], static_cast<std::size_t>(first[node]->count)};
    }
    template <class Function>
    void for_each(Function&& function) const
    {
        for (const auto& chunk : chunks) {
            for (const Touch& touch : chunk) function(touch);
        }
    }
    std::size_t size() const;
    void clear();
    /// Takes the touches out of `first`, before the chunks are filled anew.
    void forget();
    /// Enters a chunk into `first`, which has an entry for every mesh node.
    void index(std::size_t chunk);
    /// The chunks; `first` must be made anew after loading.
    void serialise(Archive& archive) { archive(chunks); }
};

/// Finds which of the pairs touch.
///
/// A node touches the point of a surface that is closest to it, so that the penetration is a continuous
/// function of the node's place over facets, edges and corners alike: a contact point on an edge or corner
/// counts only if no neighbouring facet is closer (the node lies in the feature's Voronoi region), which
/// leaves no holes at convex edges and no false contact between neighbours of one sheet. Where several facets
/// are near, the closest wins, and others count beside it if their normals are more than 60 degrees apart
/// (corners of a room).
///
/// Shells act on both sides; the side on which a node came is kept while it touches, also behind the nodes'
/// plane, and a node that has passed a whole shell within one step is seen to have done so. Solids act
/// outward: a node inside counts only if it touched before or came from outside in this step.
class TouchFinder {
public:
    TouchFinder(const ContactMesh& mesh, const ContactMotion& motion, const TouchList& before,
                bool square_edges)
        : mesh_(mesh), motion_(motion), before_(before), square_edges_(square_edges)
    {}

    /// Touches of the owners of pairs number begin to end, by rising node. Stiffness and forces are left to
    /// the law.
    void find(PairList& pairs, std::size_t begin, std::size_t end, std::vector<Touch>& touches) const;

private:
    /// The closest point of one facet to a node.
    struct Near {
        Index node = none, facet = none;
        int feature = 0;
        double s = 0, t = 0;
        double distance2 = 0;
        Vec3 offset{}; ///< from the closest point to the node
        Vec3 normal{}; ///< of the facet there
    };
    const ContactMesh& mesh_;
    const ContactMotion& motion_;
    const TouchList& before_;
    bool square_edges_;

    void collect_near(PairList& pairs, std::size_t begin, std::size_t end, std::vector<Near>& near) const;
    double quiet_until(const PairList& pairs, std::size_t owner, std::span<const Near> near,
                       std::span<const Touch> touches) const;
    double room_of(const Touch& touch, int feature) const;
    bool flat_around(Index facet) const;
    bool follow(std::span<Touch* const> batch) const;
    void drop_ended(PairList& pairs, std::size_t begin, std::size_t end, std::vector<Touch>& touches) const;
    void measure(PairList& pairs, std::span<const Index> batch, std::vector<Near>& near) const;
    /// order  room that is used again from node to node
    void resolve(std::span<const Near> near, std::vector<const Near*>& order,
                 std::vector<Touch>& touches) const;
    bool touch_of(const Near& near, std::span<const Touch> before, Touch& touch) const;
    bool touch_on_rim(const Near& near, std::span<const Touch> before, Vec3& normal, double& distance,
                      bool& known) const;
    void inherit(const Near& near, std::span<const Touch> before, Touch& touch) const;
    bool keeps_side(const Near& near, std::span<const Touch> before, const Vec3& normal, double& side) const;
    double side_of_new(const Near& near, double distance) const;
    bool comes_from_outside(const Near& near, const Vec3& normal, double distance) const;
    double closing_speed(const Near& near, const Vec3& normal) const;
    bool closest_of_feature(const Near& near) const;
    Vec3 normal_around(const Near& near) const;
    bool faces(Index node, const Vec3& normal) const;
    int same_sense(Index facet, Index other) const;
    Vec3 facet_normal(Index facet) const;
};

} // namespace plash

#pragma once

#include "contact/pair_search.h"
#include "contact/touch_table.h"

#include <algorithm>

namespace plash {

inline bool share_a_corner(const ContactMesh::Facet& a, const ContactMesh::Facet& b)
{
    const auto& corners = b.corner;
    return std::any_of(a.corner.begin(), a.corner.end(), [&](Index corner) {
        return std::find(corners.begin(), corners.end(), corner) != corners.end();
    });
}

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
    /// The closest point of one facet to a node.
    struct Near {
        Index node = none, facet = none;
        int feature = 0;
        double s = 0, t = 0;
        double distance2 = 0;
        Vec3 offset{};     ///< from the closest point to the node
        Vec3 normal{};     ///< of the facet there
        bool over = false; ///< stands over the face of a solid: does not touch, but may begin in any step
    };
    /// A pair that has to be looked at.
    struct Due {
        Index pair = none, owner = none;
    };

public:
    TouchFinder(const ContactMesh& mesh, const ContactMotion& motion, bool square_edges)
        : mesh_(mesh), motion_(motion), square_edges_(square_edges)
    {}

    /// Room that is used again from chunk to chunk.
    struct Room {
        std::vector<Due> due;
        std::vector<Near> near;
        std::vector<const Near*> order;
        std::vector<Touch> before, touches; ///< of one owner
    };

    /// Finds the touches of the owners begin to end anew, but for those of quiet ones, which are marked to be
    /// followed. Stiffness and forces are left to the law.
    void find(PairList& pairs, std::size_t begin, std::size_t end, TouchTable& table, Room& room) const;

private:
    const ContactMesh& mesh_;
    const ContactMotion& motion_;
    bool square_edges_;

    void collect_near(PairList& pairs, std::size_t begin, std::size_t end, const TouchTable& table,
                      Room& room) const;
    void sort_pairs(PairList& pairs, std::size_t owner) const;
    double quiet_until(const PairList& pairs, std::size_t owner, std::span<const Near> near,
                       std::span<const Touch> touches) const;
    bool holds_off(const Touch& touch, const Near& near) const;
    bool goes_on_in_plane(const Touch& touch) const;
    double within(const Touch& touch) const;
    double room_of(const Touch& touch, int feature) const;
    double room_beside(const Near& near, std::span<const Touch> touches) const;
    bool flat_around(Index facet) const;
    Touch touch_before(const TouchTable& table, std::size_t owner, int layer) const;
    bool call_again(PairList& pairs, std::size_t owner, std::span<const Touch> before,
                    std::span<const Touch> touches) const;
    double wait_for_sheet(const Near& near, double gap, const TouchTable& table, std::size_t owner) const;
    bool in_front(const Near& near, double gap) const;
    double wait_for_solid(const Near& near, double gap, bool touches, double step) const;
    struct Rim;
    double wait_at_rim(const Near& near, double gap) const;
    double wait_at_edge(const Near& near, int side, double slide) const;
    double wait_at_corner(const Near& near, int corner, double slide) const;
    double wait_in_front(const Rim& rim, std::span<const Index> around) const;
    void measure(PairList& pairs, std::span<const Due> batch, const TouchTable& table,
                 std::vector<Near>& near) const;
    /// order  room that is used again from node to node
    void resolve(std::span<const Near> near, std::span<const Touch> before, std::vector<const Near*>& order,
                 std::vector<Touch>& touches) const;
    bool touch_of(const Near& near, std::span<const Touch> before, Touch& touch) const;
    bool touch_on_rim(const Near& near, std::span<const Touch> before, Vec3& normal, double& distance,
                      bool& known) const;
    void inherit(std::span<const Touch> before, Touch& touch) const;
    bool keeps_side(const Near& near, std::span<const Touch> before, const Vec3& normal, double& side) const;
    double side_of_new(const Near& near, double distance) const;
    bool comes_from_outside(const Near& near, const Vec3& normal, double distance) const;
    double approach(Index node, Index number, double s, double t, const Vec3& normal) const;
    double turned_under(Index node, Index number, double s, double t, const Vec3& normal) const;
    bool closest_of_feature(const Near& near) const;
    Vec3 normal_around(const Near& near) const;
    bool faces(Index node, const Vec3& normal) const;
    int same_sense(Index facet, Index other) const;
    Vec3 facet_normal(Index facet) const;
};

} // namespace plash

#pragma once

#include "contact/bounding_tree.h"
#include "contact/contact_mesh.h"
#include "contact/mesh_motion.h"
#include "core/archive.h"

namespace plash {

/// How far the nodes of a neighbourhood may have moved relative to one another: cells of owners that stand
/// beside one another in a PairList, each with the nodes that it may have to do with (its own, and those of
/// its pairs' facets and of the facets around these). What waits for a path waits for that of its cell, so
/// that a blow here wakes nobody there.
class PathCells {
public:
    static constexpr std::size_t owners_at_once = 64;

    /// Makes the cells of all owners, none of which has moved.
    void set(const ContactMesh& mesh, std::span<const Index> owner, std::span<const Index> begin,
             std::span<const Index> facet);
    /// Adds the last step of the motion.
    void advance(const ContactMotion& motion);

    /// Bound of the relative path of any two nodes of an owner's cell since the cells were made [length].
    double travelled(std::size_t owner) const { return travelled_[owner / owners_at_once]; }
    /// The same in the last step.
    double step_range(std::size_t owner) const { return step_range_[owner / owners_at_once]; }
    /// Up to where pairs have to be looked at: a step ahead.
    double now(std::size_t owner) const { return travelled(owner) + step_range(owner); }

    void serialise(Archive& archive) { archive(begin_, block_, travelled_, step_range_); }

private:
    /// Blocks of nodes (ContactMotion::block_range) of each cell; none: it has to do with more than pays, and
    /// moves as all nodes may have.
    std::vector<Index> begin_, block_;
    std::vector<double> travelled_, step_range_;
};

/// Which facets each node may come to touch before the list is made anew. Paths are those of the owner's
/// cell.
struct PairList {
    std::vector<Index> node;  ///< of each pair, rising
    std::vector<Index> facet; ///< of each pair
    /// Path (see PathCells::travelled) before which the pair cannot touch [length]; kept by the TouchFinder.
    std::vector<double> due;
    /// Nodes that have pairs, rising, where the pairs of each begin (and the last end), and the path before
    /// which a node's touches stay on their facets and no other begins [length]; kept by the TouchFinder.
    std::vector<Index> owner, begin;
    std::vector<double> quiet;
    /// The pairs of an owner that were due soon when all were last looked at stand first: their number, and
    /// the path before which none of the others is due [length]; kept by the TouchFinder.
    std::vector<Index> close;
    std::vector<double> others_due;
    PathCells paths;

    /// Finds the owners of the pairs, all to be looked at.
    void set_owners();
    /// Every pair is due, and no owner quiet.
    void look_at_all();
    void serialise(Archive& archive)
    {
        archive(node, facet, due, owner, begin, quiet, close, others_due, paths);
    }
};

/// Finds pairs closer than what contact needs plus a margin, and tells when they must be found again.
///
/// A pair is left out when the node is a corner of the facet or of the solid behind it, and when the node
/// does not act on the facet, or when both are of one rigid part. The list holds until nodes of the mesh have
/// moved relative to one another by the margin: the diagonal of the box of all displacements since the search
/// bounds every relative displacement, so a car that drives as a whole needs no search.
class PairSearch {
public:
    PairSearch() = default;
    /// solid_nodes, thick_nodes: of the Model's bricks, for the nodes behind a facet; model: for those on the
    /// edges of ten-node tetrahedra, if there are any.
    PairSearch(const ContactMesh& mesh, const std::vector<std::array<Index, 8>>& solid_nodes,
               const std::vector<std::array<Index, 8>>* thick_nodes = nullptr, const Model* model = nullptr);

    /// Finds all pairs if those at hand do not hold any more, and goes on along the paths; once a cycle.
    /// only   if given, nodes that count (by mesh node, not 0)
    void update(const ContactMesh& mesh, const ContactMotion& motion,
                const std::vector<std::uint8_t>* only = nullptr);
    /// Makes the next search come before the next cycle (surfaces have changed).
    void forget() { searched_at_.clear(); }

    /// Goes on with the pairs of some nodes where those of all have been found, instead of a new search.
    void narrow(const ContactMesh& mesh, const std::vector<std::uint8_t>& only);

    /// The pairs of a mesh node are never due again.
    void leave_out(Index node);

    PairList& pairs() { return pairs_; }
    const PairList& pairs() const { return pairs_; }
    double margin() const { return margin_; }
    long searches() const { return searches_; }
    void serialise(Archive& archive) { archive(order_, searched_at_, test_due_, pairs_, searches_); }

private:
    const std::vector<std::array<Index, 8>>* solid_nodes_ = nullptr;
    const std::vector<std::array<Index, 8>>* thick_nodes_ = nullptr; ///< behind those of solids
    const Model* model_ = nullptr;
    double margin_ = 0;        ///< [length]
    std::vector<Index> order_; ///< mesh nodes with neighbours in space beside one another
    std::vector<Vec3> searched_at_;
    double test_due_ = 0; ///< path before which no relative displacement can exceed the margin [length]
    BoundingTree tree_;
    PairList pairs_;
    bool of_all_ = false; ///< the pairs are those of all nodes
    long searches_ = 0;

    bool holds(const ContactMotion& motion);
    void search(const ContactMesh& mesh, const ContactMotion& motion, const std::vector<std::uint8_t>* only);
    void search_nodes(const ContactMesh& mesh, std::span<const Vec3> position, double margin,
                      std::size_t begin, std::size_t end, const std::vector<std::uint8_t>* only,
                      PairList& found) const;
    void set_owners(const ContactMesh& mesh);
    void sort_by_node(std::size_t node_count, const std::vector<PairList>& found);
    bool may_touch(const ContactMesh& mesh, Index node, Index facet) const;
};

} // namespace plash

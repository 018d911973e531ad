#pragma once

#include "contact/mesh_motion.h"
#include "core/archive.h"
#include "math/lanes.h"

#include <span>

namespace plash {

/// A node in contact with a facet, with what it remembers from cycle to cycle.
struct Touch {
    Index node = none;  ///< of the mesh
    Index facet = none; ///< of the mesh
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

/// All touches of one moment, by rising node.
struct TouchList {
    std::vector<Touch> all;

    template <class Function>
    void for_each(Function&& function) const
    {
        for (const Touch& touch : all) function(touch);
    }
    std::size_t size() const { return all.size(); }
};

/// Touches from cycle to cycle: those of one node (an owner, see PairList) stand in up to three layers.
/// Within a layer, eight owners make a block with a line of eight values for each number that a touch
/// remembers, so that eight nodes are worked through at once, their numbers are beside one another in memory
/// (a stream, and one page for a touch that is looked at alone), and lines that are not needed cost nothing.
///
/// A touch that is followed keeps its facet and the side of it on which its node is: its normal and
/// penetration are found anew from the places of the nodes and are not kept.
class TouchTable {
public:
    static constexpr int layers = 3; ///< touches that a node can have
    enum Field {
        normal_x, ///< normal and penetration: of touches that are not followed only
        normal_y,
        normal_z,
        penetration,
        side, ///< +1, -1: the node is where the facet's normal points to, or behind; followed ones only
        at_s,
        at_t,
        baseline,
        rounding,
        stiffness,
        weight,
        pressing, ///< normal force [force]
        friction_x,
        friction_y,
        friction_z
    };

    explicit TouchTable(bool with_friction = true) : fields_(with_friction ? 15 : 12) {}

    /// Takes the touches of nodes that go on to be owners over to the new order, and drops the others.
    void set_owners(std::span<const Index> owner);
    /// Without touches or owners.
    void clear();

    std::size_t owners() const { return owner_.size(); }
    Index node(std::size_t owner) const { return owner_[owner]; }
    int count(std::size_t owner) const { return count_[owner]; }
    /// Touches of eight owners from `owner` on, a byte each; owner is a multiple of eight.
    const std::uint8_t* counts(std::size_t owner) const { return &count_[owner]; }
    /// Whether the touches of an owner were followed when they were last looked at.
    bool followed(std::size_t owner) const { return followed_[owner] != 0; }
    void set_followed(std::size_t owner, bool followed) { followed_[owner] = followed; }
    bool with_friction() const { return fields_ > friction_x; }

    /// One field of eight owners from `owner` on, a multiple of eight.
    double* line(Field field, int layer, std::size_t owner) { return &values_[place(field, layer, owner)]; }
    double& value(Field field, int layer, std::size_t owner) { return values_[place(field, layer, owner)]; }
    double value(Field field, int layer, std::size_t owner) const
    {
        return values_[place(field, layer, owner)];
    }
    const Index* facets(int layer) const { return &facet_[layer * stride_]; }
    /// Calls for the lines of eight owners that are followed.
    void prefetch(int layer, std::size_t owner) const
    {
        const double* line = &values_[place(side, layer, owner)];
        for (std::size_t i = side; i < fields_; ++i, line += lane_count) __builtin_prefetch(line);
    }

    /// One touch as it stands; normal and penetration of a followed one by the places of the nodes now.
    Touch touch(const ContactMesh& mesh, const ContactMotion& motion, std::size_t owner, int layer) const;
    /// Puts all touches of an owner, at most as many as there are layers.
    void put(std::size_t owner, std::span<const Touch> touches);
    TouchList list(const ContactMesh& mesh, const ContactMotion& motion) const;

    void serialise(Archive& archive)
    {
        archive(fields_, stride_, owner_, count_, followed_, facet_, values_);
    }

private:
    std::size_t fields_;
    std::size_t stride_ = 0; ///< owners, rounded up to a whole batch
    std::vector<Index> owner_;
    std::vector<std::uint8_t> count_, followed_;
    std::vector<Index> facet_;
    std::vector<double> values_;

    std::size_t place(std::size_t field, int layer, std::size_t owner) const
    {
        return (layer * stride_ + owner / lane_count * lane_count) * fields_ + field * lane_count +
               owner % lane_count;
    }
    void copy(const TouchTable& from, std::size_t source, int source_layer, std::size_t to, int layer);
};

} // namespace plash

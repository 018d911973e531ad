#pragma once

#include "contact/bounding_tree.h"
#include "contact/contact_mesh.h"
#include "core/clock.h"
#include "core/parallel.h"

namespace plash {

/// A vector for each node of a contact mesh: those of the State where they stand in the mesh's order there,
/// else a copy.
class NodeVectors {
public:
    /// Looks at `count` vectors that stand elsewhere, as long as they do.
    void look_at(const Vec3* vectors, std::size_t count)
    {
        elsewhere_ = vectors;
        count_ = count;
    }

    std::size_t size() const { return elsewhere_ ? count_ : own_.size(); }
    bool empty() const { return size() == 0; }
    const Vec3* data() const { return elsewhere_ ? elsewhere_ : own_.data(); }
    const Vec3* begin() const { return data(); }
    const Vec3* end() const { return data() + size(); }
    const Vec3& operator[](std::size_t node) const { return data()[node]; }
    /// The copy.
    std::vector<Vec3>& own() { return own_; }

private:
    std::vector<Vec3> own_;
    const Vec3* elsewhere_ = nullptr;
    std::size_t count_ = 0;
};

/// Where the nodes of a contact mesh are and how they move, from load() to the end of the cycle.
struct ContactMotion {
    NodeVectors position;  ///< at n [length]
    NodeVectors velocity;  ///< at n-1/2
    double last_step = 0;  ///< [time]
    double step_range = 0; ///< bound of the relative motion of any two nodes in the last step [length]
    double travelled = 0;  ///< sum of step_range over all steps: bound of every relative path [length]
    /// Nodes whose velocities are bounded together, in the mesh's order.
    static constexpr std::size_t block_length = 64;
    std::vector<Bounds> block_range; ///< of the velocities, by block

    /// Takes positions and velocities from the State, and calls also(begin, end) while a chunk of them is at
    /// hand.
    template <class Also>
    void load(const ContactMesh& mesh, const Clock& clock, const State& state, Also&& also)
    {
        const std::size_t count = mesh.nodes.size();
        if (mesh.first_node != none) {
            position.look_at(state.position.data() + mesh.first_node, count);
            velocity.look_at(state.velocity.data() + mesh.first_node, count);
        } else {
            position.own().resize(count);
            velocity.own().resize(count);
        }
        last_step = clock.last_step;
        block_range.resize((count + block_length - 1) / block_length);
        for_chunks(count, [&](std::size_t begin, std::size_t end) {
            if (mesh.first_node == none) copy(mesh, state, begin, end);
            bound_velocities(begin, end);
            also(begin, end);
        });
        travel();
    }
    void load(const ContactMesh& mesh, const Clock& clock, const State& state)
    {
        load(mesh, clock, state, [](std::size_t, std::size_t) {});
    }

    /// Takes positions and velocities as they stand, over a step that has led to them.
    void follow(double step)
    {
        last_step = step;
        block_range.resize((velocity.size() + block_length - 1) / block_length);
        bound_velocities(0, velocity.size());
        travel();
    }

    Vec3 previous(Index node) const { return position[node] - last_step * velocity[node]; }

private:
    void copy(const ContactMesh& mesh, const State& state, std::size_t begin, std::size_t end);
    void bound_velocities(std::size_t begin, std::size_t end);
    void travel();
};

} // namespace plash

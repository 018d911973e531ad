#pragma once

#include "core/state.h"
#include "math/matrix3.h"
#include "sph/particle_arrays.h"

#include <span>
#include <vector>

namespace plash {

/// *BOUNDARY_SPH_SYMMETRY_PLANE: particles see their mirror images behind it, a wall without friction.
struct MirrorPlane {
    Vec3 point{};
    Vec3 normal{};        ///< unit, pointing to the particles
    bool no_slip = false; ///< images move so that the fluid sticks to the wall, as viscosity sees it
    Vec3 velocity{};      ///< of the wall in its own plane, with no_slip [velocity]
    /// No wall: waves go out through it (*BOUNDARY_SPH_NON_REFLECTING), and so do particles
    /// (sph/absorption.h).
    bool absorbing = false;

    Vec3 reflected(const Vec3& direction) const { return direction - 2 * dot(direction, normal) * normal; }
};

/// *BOUNDARY_SPH_PERIODIC: what leaves through one plane comes in through the other. The planes are parallel;
/// `period` leads from the lower to the upper one. *PLASH_SPH_MOVING_PERIODIC: they go along with a node, and
/// what approaches the lower plane is calmed down (sph/moving_domain.h).
struct PeriodicPair {
    Vec3 lower{}; ///< a point of the lower plane
    Vec3 period{};
    Index node = none; ///< that the planes follow along the period
    double calm = 0;   ///< length of the zone in front of the lower plane [length]
};

/// Mirror and periodic copies of the particles near boundaries.
class Images {
public:
    Images() = default;
    Images(std::span<const MirrorPlane> mirrors, std::span<const PeriodicPair> periods);

    bool any() const { return !steps_.empty(); }
    bool any_absorbing() const; ///< whether waves leave through one of the planes
    /// by part of the body: speed of shear waves over that of longitudinal ones [-]
    void set_shear_sounds(std::vector<double> by_part) { shear_sound_ = std::move(by_part); }
    /// Whether the image that stands `number` places behind the particles lets waves out.
    bool absorbs(std::size_t number) const { return transforms_[images_[number].transform].planes > 0; }
    /// Sorted place of its original, and how its velocity follows from that of the original, what is carried
    /// on left out.
    Index source(std::size_t number) const { return images_[number].source; }
    const Matrix3& flow(std::size_t number) const { return transforms_[images_[number].transform].flow; }

    /// Moves the planes of the pairs that follow a node to where the node is. Returns by how far the farthest
    /// one has moved [length].
    double follow(const State& state, const std::vector<Vec3>& start);
    /// How far `follow` would move them.
    double behind(const State& state, const std::vector<Vec3>& start) const;
    std::span<const PeriodicPair> periods() const { return periods_; } ///< where they stand now

    /// Brings a particle that left through a periodic boundary back in; says whether it moved.
    bool wrap(Vec3& position) const;

    /// Finds the images of all particles closer than `range` to a boundary, and appends their positions.
    void find(double range, std::vector<Vec3>& position);

    std::size_t size() const { return images_.size(); }
    void serialise(Archive& archive) { archive(periods_, transforms_, images_); }

    /// After sorting: puts the images into their order and gives them their kind and the part of their
    /// source. order  by sorted place: a particle, or behind all of them an image, by its number
    void settle(std::span<const Index> order, ParticleArrays& arrays);
    /// Copies reaches from sources to images.
    void copy_reaches(ParticleArrays& arrays) const;
    /// Copies motion from sources to images, as the continuity equation sees walls.
    void refresh_motion(ParticleArrays& arrays) const;
    /// Copies motion and push, as pressure and viscosity see walls.
    void refresh_all(ParticleArrays& arrays) const;

    bool any_sticking() const; ///< whether there is a wall without slip
    /// After refresh_all: what stands behind a wall without slip moves such that the velocity there, the one
    /// of the particle and its slope there, arrays.wall_gradient, are those of one parabola. Sets
    /// arrays.bend, by how much this differs from what refresh_all gave. Images in corners of two walls stay
    /// as they are.
    void bend_at_walls(ParticleArrays& arrays) const;

    /// A particle that has passed a mirror changes places with its image: both go on as before.
    void reflect_passed(ParticleArrays& arrays, State& state) const;

private:
    struct Image {
        Index source;    ///< the particle that it copies: its number, once settled its sorted place
        Index transform; ///< which copy it is
    };
    /// Copies what stands between two parallel planes beyond one of them.
    struct Step {
        Vec3 point{}, normal{}; ///< of the boundary; sources stand within the range on the normal's side
        Matrix3 turn;           ///< reflection, or identity
        Vec3 shift{};           ///< position -> turn * position + shift
        Matrix3 flow;           ///< velocity -> flow * velocity, as continuity sees it
        Matrix3 drag;           ///< velocity -> drag * velocity + carry, as viscosity sees it
        Vec3 carry{};
        bool absorbing = false;
        bool sticks = false; ///< a wall without slip
    };
    struct Transform {
        Matrix3 turn = Matrix3::identity();
        Vec3 shift{};
        Matrix3 flow = Matrix3::identity();
        Matrix3 drag = Matrix3::identity();
        Vec3 carry{};
        int planes = 0;    ///< absorbing ones that it goes through
        Vec3 outward[3]{}; ///< their unit normals, away from the particles, as the image sees them
        Vec3 point[3]{};   ///< and a point of each
        int walls = 0;     ///< without slip that it goes through
        Vec3 wall_outward{}, wall_point{}; ///< of the last of them, likewise
    };
    std::vector<MirrorPlane> mirrors_;
    std::vector<PeriodicPair> periods_;
    std::vector<Vec3> first_lower_;        ///< of the pairs at the start
    std::vector<std::vector<Step>> steps_; ///< by boundary; steps of one boundary do not build on each other
    std::vector<Transform> transforms_;    ///< the first one is the identity
    std::vector<Image> images_;            ///< once settled as they stand behind the particles
    std::vector<double> shear_sound_;      ///< by part of the body; may be empty

    Vec3 lower_now(std::size_t pair, const State& state, const std::vector<Vec3>& start) const;
    Index transform_after(Index first, const Step& step);
    static std::vector<Index> places_near(const Step& step, double range, std::span<const Vec3> position);
    void carry_on(const Transform& transform, Index source, Index place, ParticleArrays& arrays) const;
    void absorb(const Transform& transform, Index source, Index place, ParticleArrays& arrays) const;
};

} // namespace plash

#pragma once

#include "ale/fluid_term.h"

namespace plash {

/// *DATABASE_TRACER: points whose state is recorded (*DATABASE_TRHIST). They change nothing.
///
/// In an Eulerian mesh a tracer that follows the material goes from n to n + 1 by Heun's method,
/// x' = x + dt / 2 (v_n(x) + v_(n+1)(x + dt v_n(x))), of second order in time; velocities are trilinear
/// between those nodes of a cell that carry mass, so that void beside a surface slows nothing. A tracer whose
/// surroundings have run empty flies on with its last velocity. In a solid of a structure it keeps its place
/// within the element.
class Tracers : public Term {
public:
    /// fluids  of the same scene, before this term
    Tracers(const Model& model, std::vector<EulerianFluid*> fluids);

    std::string_view name() const override { return "tracers"; }
    std::size_t items() const override { return tracers_.size(); }
    /// Begins with those whose time has come.
    void add_forces(const Clock& clock, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;
    std::vector<std::string> notices(const State& state) const override;

private:
    enum class Track : int { material, space, mesh };
    struct Tracer {
        double start = 0; ///< [time]
        Track track = Track::material;
        int group = none; ///< whose state is recorded, by its number in the deck from 0; none: of all
        Vec3 place{};
        Vec3 velocity{};              ///< the last one of the material here [velocity]
        bool started = false;         ///< its time has come
        Index solid = none;           ///< element of the Model to which it is tied; none: it is free
        std::array<double, 3> part{}; ///< place in that element, 0 to 1 along its axes
        int fluid = none;             ///< mesh in which it lies, or lay last
        std::array<int, 3> cell{};    ///< of that mesh
    };
    const Model& model_;
    std::vector<EulerianFluid*> fluids_;
    std::vector<Tracer> tracers_;
    std::vector<bool> eulerian_; ///< by part

    struct Host {
        Index solid = none;
        std::array<double, 3> part{};
    };
    /// The solid that holds a point; `of_fluids` looks in Eulerian meshes, else in structures.
    Host find_solid(const Vec3& point, const State& state, bool of_fluids) const;
    bool locate(Tracer& tracer, const Vec3& point, MeshPoint& found) const;
    bool follow_fluid(Tracer& tracer, const Vec3& point) const;
    void begin(Tracer& tracer, const State& state);
    ElementResults::Tracer state_in_fluid(const Tracer& tracer, const MeshPoint& at) const;
    ElementResults::Tracer state_of(const Tracer& tracer, const State& state) const;
};

/// The tracers of a Model; null when it has none, or no *DATABASE_TRHIST.
std::unique_ptr<Tracers> make_tracers(const Model& model, std::vector<EulerianFluid*> fluids);

} // namespace plash

#pragma once

#include "model/model.h"
#include "solver/explicit_loop.h"
#include "sph/fluid_law.h"
#include "sph/particle_body.h"

#include <cmath>
#include <functional>
#include <random>

/// Small bodies of particles for tests, built without a deck.
namespace plash {

/// p = (gamma - 1) rho e.
struct TestGas {
    double density, gamma, energy, bulk_modulus = 0, relative_volume = 1;

    TestGas(double rho, double pressure, double gamma_)
        : density(rho), gamma(gamma_), energy(pressure / (gamma_ - 1))
    {}
    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        return {Lane{}, (gamma - 1) * compression, Lane{}, broadcast<Lane>(gamma - 1)};
    }
};

/// Tait: p = rho0 c0^2 / 7 ((rho / rho0)^7 - 1).
struct TestTait {
    double density, sound, energy = 0, bulk_modulus, relative_volume = 1;

    TestTait(double rho, double c) : density(rho), sound(c), bulk_modulus(rho * c * c) {}
    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane cube = compression * compression * compression, sixth = cube * cube;
        return {(bulk_modulus / 7) * (sixth * compression - 1.0), Lane{}, bulk_modulus * sixth, Lane{}};
    }
};

/// p = rho0 c0^2 mu: linear, for acoustics.
struct TestLinear {
    double density, sound, energy = 0, bulk_modulus, relative_volume = 1;

    TestLinear(double rho, double c) : density(rho), sound(c), bulk_modulus(rho * c * c) {}
    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        return {bulk_modulus * (compression - 1.0), Lane{}, broadcast<Lane>(bulk_modulus), Lane{}};
    }
};

/// A Model of nodes alone, and what a scene would make of it.
struct ParticleWorld {
    Model model;
    State state;
    Clock clock;
    std::vector<ParticlePart> parts;
    ParticleOptions options;

    ParticleWorld() { options.viscosity = {1.5, 0.06}; }

    /// A part with one particle at each position; h = smoothing, and it may halve and double.
    template <class Eos>
    ParticlePart& add_part(const Eos& eos, const std::vector<Vec3>& positions, double particle_mass,
                           double smoothing, double smallest_pressure = -INFINITY)
    {
        NullFluid fluid;
        fluid.density = eos.density;
        fluid.lowest_pressure = smallest_pressure;
        return add_part(std::make_shared<FluidLaw<Eos>>(fluid, eos), eos.density, positions, particle_mass,
                        smoothing);
    }
    ParticlePart& add_part(std::shared_ptr<const ParticleLaw> law, double density,
                           const std::vector<Vec3>& positions, double particle_mass, double smoothing)
    {
        ParticlePart part;
        part.model_part = static_cast<Index>(parts.size());
        part.id = part.model_part + 1;
        model.parts.emplace_back();
        const std::size_t nodes = model.nodes.id.size() + positions.size(); // exact: memory is measured
        model.nodes.id.reserve(nodes);
        model.nodes.position.reserve(nodes);
        part.nodes.reserve(positions.size());
        part.mass.reserve(positions.size());
        for (const Vec3& position : positions) {
            part.nodes.push_back(static_cast<Index>(model.nodes.id.size()));
            part.mass.push_back(particle_mass);
            model.nodes.id.push_back(part.nodes.back() + 1);
            model.nodes.position.push_back(position);
        }
        part.law = std::move(law);
        part.constants.density = density;
        part.constants.smoothing = smoothing;
        part.constants.smallest_smoothing = 0.2 * smoothing;
        part.constants.largest_smoothing = 2 * smoothing;
        parts.push_back(std::move(part));
        return parts.back();
    }

    /// Nodal arrays for all parts added; velocities are set by the caller before make_body.
    void open_state()
    {
        state.position = model.nodes.position;
        state.velocity.assign(state.size(), {});
        state.force.assign(state.size(), {});
        state.mass.assign(state.size(), 0.0);
    }

    /// A scene with the particles as its only term; more may be added. `body` points into it.
    Scene make_scene_of_particles()
    {
        auto term = make_body();
        body = term.get();
        Scene scene{model, state, {}, {}, 0, {}};
        scene.terms.push_back(std::move(term));
        return scene;
    }

    ParticleBody* body = nullptr;

    std::unique_ptr<ParticleBody> make_body()
    {
        for (ParticlePart& part : parts) {
            part.constants.viscosity = options.viscosity;
        }
        return std::make_unique<ParticleBody>(parts, options, model, state);
    }
};

/// Looks at the scene in every cycle, when the forces at n are known.
class ParticleProbe : public Term {
public:
    std::function<void(const Clock&, const State&)> look;
    std::string_view name() const override { return "probe"; }
    void add_forces(const Clock& clock, State& state) override { look(clock, state); }
};

inline void add_particle_probe(Scene& scene, std::function<void(const Clock&, const State&)> look)
{
    auto probe = std::make_unique<ParticleProbe>();
    probe->look = std::move(look);
    scene.terms.push_back(std::move(probe));
}

/// Positions of a block of nx x ny x nz cells of edge `spacing` from `origin`, at the middles of the cells.
inline std::vector<Vec3> lattice(const Vec3& origin, int nx, int ny, int nz, double spacing)
{
    std::vector<Vec3> positions;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                positions.push_back(origin + spacing * Vec3{i + 0.5, j + 0.5, k + 0.5});
    return positions;
}

/// Moves each position by up to `amount` along each axis; z stays in the plane.
inline void disturb(std::vector<Vec3>& positions, double amount, unsigned seed, int dimension = 3)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (Vec3& position : positions) {
        position.x += shift(random);
        position.y += shift(random);
        if (dimension == 3) position.z += shift(random);
    }
}

} // namespace plash

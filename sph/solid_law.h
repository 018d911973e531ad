#pragma once

#include "materials/history.h"
#include "sph/law_lanes.h"

namespace plash {

/// A particle with strength: any law of materials/ that updates solid stresses. Stress turns with the spin of
/// the velocity gradient (Hughes & Winget 1980); density follows the volume strain, h the density.
template <class Material>
class SolidParticleLaw : public ParticleLaw {
public:
    explicit SolidParticleLaw(const Material& material) : material_(material)
    {
        const double e = material.young_modulus, nu = material.poisson_ratio;
        wave_modulus_ = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
        shear_sound_ = std::sqrt((1 - 2 * nu) / (2 * (1 - nu)));
    }

    bool has_strength() const override { return true; }
    double shear_sound() const override { return shear_sound_; }
    int history_size() const override { return Material::history_size; }
    void start_history(double* variables) const override
    {
        const auto start = material_.initial_history();
        std::copy(start.begin(), start.end(), variables);
    }

    double plastic_strain([[maybe_unused]] const double* variables) const override
    {
        if constexpr (requires { Material::plastic_strain; }) {
            return variables[Material::plastic_strain];
        } else {
            return 0;
        }
    }

    ParticleVote advance(const PartConstants& part, std::span<const Index> places, double step,
                         ParticleArrays& arrays) const override
    {
        return for_batches(
            places, [&](std::span<const Index> batch) { return advance_batch(part, batch, step, arrays); });
    }

private:
    Material material_;
    double wave_modulus_; ///< of longitudinal waves [stress]
    double shear_sound_;  ///< of shear waves, over that of longitudinal ones [-]

    static Tensor3<Lanes> gather_gradient(std::span<const Index> places, const ParticleArrays& arrays)
    {
        const auto from = [&](double Tensor3<double>::*component) {
            return gather(places, [&](Index p) { return arrays.gradient[p].*component; });
        };
        using T = Tensor3<double>;
        return {from(&T::xx), from(&T::xy), from(&T::xz), from(&T::yx), from(&T::yy),
                from(&T::yz), from(&T::zx), from(&T::zy), from(&T::zz)};
    }

    static SymmetricTensor<Lanes> gather_stress(std::span<const Index> places, const ParticleArrays& arrays)
    {
        const auto from = [&](double SymmetricTensor<double>::*component) {
            return gather(places, [&](Index p) { return arrays.stress[p].*component; });
        };
        using T = SymmetricTensor<double>;
        return {from(&T::xx), from(&T::yy), from(&T::zz), from(&T::xy), from(&T::yz), from(&T::zx)};
    }

    /// IEROD = 1: a particle whose material has failed keeps its mass and its neighbours but no stress.
    static void drop_failed(const LaneMask& failed, SymmetricTensor<Lanes>& stress)
    {
        for (Lanes* component : {&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.zx}) {
            *component = failed ? Lanes{} : *component;
        }
    }

    ParticleVote advance_batch(const PartConstants& part, std::span<const Index> places, double step,
                               ParticleArrays& arrays) const
    {
        const auto from = [&](const auto& array) {
            return gather(places, [&](Index p) { return array[p]; });
        };
        const Tensor3<Lanes> gradient = gather_gradient(places, arrays);
        const Vector3<Lanes> half_turn = broadcast<Lanes>(0.5 * step) * axial_vector(gradient);
        const SymmetricTensor<Lanes> increment =
            turned_half(broadcast<Lanes>(step) * symmetric_part(gradient), half_turn);
        const Tensor3<Lanes> rotation = incremental_rotation(half_turn);
        const Lanes expansion = trace(increment),
                    before = gather(places, [&](Index p) { return arrays.density(p); });
        const Lanes density = advanced_density(true, before, -expansion);

        std::array<Lanes, Material::history_size> variables;
        const int stride = arrays.history_size;
        for (int k = 0; k < Material::history_size; ++k) {
            variables[k] =
                gather(places, [&](Index p) { return arrays.history[std::size_t(p) * stride + k]; });
        }
        const HistoryView<Lanes> history{variables.data()};
        SymmetricTensor<Lanes> stress = rotated(gather_stress(places, arrays), rotation);
        const SymmetricTensor<Lanes> stress_before = stress;
        if constexpr (requires { material_.rotate_history(history, rotation); }) {
            material_.rotate_history(history, rotation);
        }
        if (step > 0) material_.update(stress, increment, history, step);
        if constexpr (requires { material_.failed(history); }) {
            if (part.failed_carry_nothing) drop_failed(material_.failed(history), stress);
        }

        const Lanes compression = density * (1 / part.density);
        const Lanes middle_volume = part.density * (0.5 / before + 0.5 / density);
        const Lanes closing = -(gradient.xx + gradient.yy + gradient.zz);
        const Lanes bulk = bulk_viscosity(part, places, step > 0 ? closing : Lanes{}, arrays);
        const Lanes bulk_work = -(exchange_bulk(places, bulk, arrays) + bulk) * expansion;
        const Lanes energy = from(arrays.energy) +
                             0.5 * middle_volume * (contract(stress_before + stress, increment) + bulk_work);
        const Lanes sound = sqrt(wave_modulus_ / density);
        const Lanes h = smoothing_length(part, places, compression, closing, step, arrays);
        const Lanes stable = stable_step(part, size_for_step(places, h, arrays), sound, closing);

        ParticleVote vote;
        for (std::size_t l = 0; l < places.size(); ++l) {
            const Index p = places[l];
            arrays.energy[p] = energy[l];
            arrays.stress[p] = {stress.xx[l], stress.yy[l], stress.zz[l],
                                stress.xy[l], stress.yz[l], stress.zx[l]};
            for (int k = 0; k < Material::history_size; ++k) {
                arrays.history[std::size_t(p) * stride + k] = variables[k][l];
            }
            set_records(part, p, density[l], h[l], sound[l], arrays);
            arrays.set_pressure(p, -trace(arrays.stress[p]) / 3);
            SymmetricTensor<double> pushing = arrays.stress[p];
            pushing.xx -= bulk[l], pushing.yy -= bulk[l], pushing.zz -= bulk[l];
            set_push(part, p, pushing, arrays);
            vote.take({stable[l], p});
        }
        return vote;
    }
};

} // namespace plash

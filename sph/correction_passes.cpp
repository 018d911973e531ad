#include "core/parallel.h"
#include "sph/density_filter.h"
#include "sph/laminar_force.h"
#include "sph/pair_passes.h"
#include "sph/tensile_force.h"

#include <algorithm>

/// Pair loops of options that a plain deck does not have.
namespace plash {

namespace {

/// Runs a pass with one line of sums a particle over all runs.
template <class Sums, class MakePass>
void walk_runs(const std::vector<NeighbourRun>& runs, MakePass&& make_pass,
               const std::function<void(const NeighbourRun&, const Sums*)>& take)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
#pragma omp parallel if (count > 1)
    {
        std::vector<Sums> sums(longest_of(runs));
#pragma omp for schedule(dynamic)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const NeighbourRun& run = runs[i];
            std::fill_n(sums.begin(), run.length(), Sums{});
            auto pass = make_pass(run, sums.data());
            walk_pairs<Lanes>(run, pass);
            take(run, sums.data());
        }
    }
}

PairRecords records_of(const ParticleArrays& arrays)
{
    return {arrays.motion.data(), arrays.push.data(), nullptr};
}

} // namespace

void sum_drifts(Kernel kernel, int dimension, bool volume_weighted, const std::vector<NeighbourRun>& runs,
                const ParticleArrays& arrays,
                const std::function<void(const NeighbourRun&, const DriftSums*)>& take)
{
    with_kernel(kernel, [&]<class K>(K) {
        const auto pass = [&](const NeighbourRun& run, DriftSums* sums) {
            return DriftPass<Lanes, K>(records_of(arrays), run.begin, dimension, volume_weighted, sums);
        };
        walk_runs<DriftSums>(runs, pass, take);
    });
}

void sum_tensile_forces(Kernel kernel, int dimension, bool volume_weighted, double strength,
                        const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                        const std::function<void(const NeighbourRun&, const ForceSums*)>& take)
{
    with_kernel(kernel, [&]<class K>(K) {
        const auto pass = [&](const NeighbourRun& run, ForceSums* sums) {
            return TensileForce<Lanes, K>(records_of(arrays), run.begin, dimension, volume_weighted, strength,
                                          sums);
        };
        walk_runs<ForceSums>(runs, pass, take);
    });
}

void sum_laminar_forces(Kernel kernel, int dimension, const std::vector<NeighbourRun>& runs,
                        const ParticleArrays& arrays,
                        const std::function<void(const NeighbourRun&, const ForceSums*)>& take)
{
    with_kernel(kernel, [&]<class K>(K) {
        const auto pass = [&](const NeighbourRun& run, ForceSums* sums) {
            return LaminarForce<Lanes, K>(arrays.motion.data(), arrays.laminar.data(),
                                          arrays.bend.empty() ? nullptr : arrays.bend.data(),
                                          arrays.real_count(), run.begin, dimension, sums);
        };
        walk_runs<ForceSums>(runs, pass, take);
    });
}

std::vector<double> filtered_densities(Kernel kernel, int dimension, bool volume_weighted,
                                       const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays)
{
    std::vector<double> mass(arrays.real_count()), volume(arrays.real_count());
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    with_kernel(kernel, [&]<class K>(K) {
#pragma omp parallel for schedule(dynamic) if (count > 1)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const NeighbourRun& run = runs[i];
            DensityFilter<Lanes, K> pass(records_of(arrays), run.begin, dimension, volume_weighted,
                                         mass.data() + run.begin, volume.data() + run.begin);
            walk_pairs<Lanes>(run, pass);
        }
    });
    for_chunks(mass.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            mass[p] /= volume[p];
        }
    });
    return mass;
}

} // namespace plash

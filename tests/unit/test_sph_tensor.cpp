#include "sph/pair_force.h"
#include "sph/velocity_gradient.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A disordered block with free surfaces and a velocity that is linear in the position.
struct LinearField {
    ParticleWorld world;
    std::unique_ptr<ParticleBody> body;
    static constexpr Tensor3<double> gradient{0.3, -0.2, 0.5, 0.1, -0.4, 0.25, -0.6, 0.15, 0.2};

    LinearField()
    {
        auto positions = lattice({0, 0, 0}, 9, 8, 7, 1.0);
        disturb(positions, 0.25, 5);
        world.add_part(TestTait(1, 10), positions, 1.0, 1.3);
        world.options.renormalised = true;
        world.open_state();
        for (std::size_t i = 0; i < positions.size(); ++i) world.state.velocity[i] = gradient * positions[i];
        body = world.make_body();
        body->add_forces(Clock{}, world.state);
    }
};

double difference(const Tensor3<double>& a, const Tensor3<double>& b)
{
    double largest = 0;
    using T = Tensor3<double>;
    for (double T::*c : {&T::xx, &T::xy, &T::xz, &T::yx, &T::yy, &T::yz, &T::zx, &T::zy, &T::zz}) {
        largest = std::max(largest, std::abs(a.*c - b.*c));
    }
    return largest;
}

template <class Lane>
std::vector<GradientSums> gradient_sums(const ParticleBody& body)
{
    std::vector<GradientSums> all;
    for (const NeighbourRun& run : body.runs()) {
        std::vector<GradientSums> sums(run.length());
        VelocityGradient<Lane, CubicSpline> pass(body.arrays().motion.data(), run.begin, 3, 0.0, sums.data());
        walk_pairs<Lane>(run, pass);
        all.insert(all.end(), sums.begin(), sums.end());
    }
    return all;
}

} // namespace

TEST(SphTensor, CorrectedGradientIsExactForLinearFieldsUpToTheSurface)
{
    LinearField field;
    // A second look at the same places: a step so short that nothing moves.
    Clock clock;
    clock.last_step = 1e-9;
    field.body->add_forces(clock, field.world.state);
    const ParticleArrays& arrays = field.body->arrays();
    int corrected = 0;
    for (Index p = 0; p < arrays.size(); ++p) {
        if (arrays.correction[p].xx == 1 && arrays.correction[p].xy == 0) continue; // at corners: uncorrected
        ++corrected;
        // Round-off: the estimates of the reciprocals are the same in the sum and in its moment.
        EXPECT_LT(difference(arrays.gradient[p], LinearField::gradient), 1e-7) << "particle " << p;
    }
    EXPECT_GT(corrected, 0.8 * arrays.size()) << "only edges and corners may have too few neighbours";
}

TEST(SphTensor, GradientLanesEqualTheScalarReference)
{
    const LinearField field;
    const auto lanes = gradient_sums<Lanes>(*field.body), plain = gradient_sums<double>(*field.body);
    ASSERT_EQ(lanes.size(), field.world.state.size());
    for (std::size_t p = 0; p < plain.size(); ++p) {
        for (int k = 0; k < 9; ++k) EXPECT_NEAR(lanes[p].velocity[k], plain[p].velocity[k], 1e-7);
        for (int k = 0; k < 6; ++k) EXPECT_NEAR(lanes[p].moment[k], plain[p].moment[k], 1e-7);
    }
}

TEST(SphTensor, APressureTensorPushesLikeAPressure)
{
    const LinearField field;
    const ParticleArrays& arrays = field.body->arrays();
    std::vector<PushRecord> push = arrays.push;
    std::vector<TensionRecord> tension(push.size());
    for (std::size_t p = 0; p < push.size(); ++p) {
        push[p].push = 0.1 + 0.01 * static_cast<double>(p % 17);
        tension[p].component[0] = tension[p].component[4] = push[p].push;
    }
    for (const NeighbourRun& run : field.body->runs()) {
        std::vector<ForceSums> scalar(run.length()), tensor(run.length());
        PairForce<Lanes, CubicSpline, false> one({arrays.motion.data(), push.data(), nullptr}, run.begin, 3,
                                                 {1.5, 1}, scalar.data());
        PairForce<Lanes, CubicSpline, true> other({arrays.motion.data(), push.data(), tension.data()},
                                                  run.begin, 3, {1.5, 1}, tensor.data());
        walk_pairs<Lanes>(run, one);
        walk_pairs<Lanes>(run, other);
        for (Index i = 0; i < run.length(); ++i) {
            EXPECT_LT(norm(scalar[i].force - tensor[i].force), 1e-13);
            EXPECT_DOUBLE_EQ(scalar[i].heat, tensor[i].heat);
        }
    }
}

} // namespace plash

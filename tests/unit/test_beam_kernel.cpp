#include "elements/beam_kernel.h"
#include "materials/elastic.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/plastic_kinematic.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

BeamSettings settings_of(int formulation)
{
    BeamSettings settings;
    settings.section.formulation = formulation;
    settings.section.area = 2;
    settings.section.inertia_s = 0.4;
    settings.section.inertia_t = 0.3;
    settings.section.torsion = 0.7;
    settings.section.shear_area = 1.5;
    settings.section.points = {{-0.3, -0.4, 0.25}, {0.3, -0.4, 0.25}, {0.3, 0.4, 0.25}, {-0.3, 0.4, 0.25}};
    settings.density = 1;
    settings.young_modulus = 100;
    settings.shear_modulus = 40;
    settings.wave_speed = 10;
    return settings;
}

const Elastic elastic{1, 100, 0.25};

template <class Formulation>
std::vector<double> fresh_record(const BeamSettings& settings, const Vec3& e2)
{
    std::vector<double> record(Formulation::template record_size<Elastic>(settings.section));
    record[beam_record::second_axis] = e2.x;
    record[beam_record::second_axis + 1] = e2.y;
    record[beam_record::second_axis + 2] = e2.z;
    record[beam_record::mass_factor] = 1;
    return record;
}

Vec3 turned(const Vec3& v, const Vec3& axis, double angle)
{
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (1 - std::cos(angle)) * dot(axis, v) * axis;
}

/// A stressed beam turns once around in `steps`; returns the largest change of a resultant.
template <class Formulation>
double change_over_turn(const Vec3& axis, int steps)
{
    const BeamSettings settings = settings_of(1);
    const Vec3 side{3, 0, 0};
    std::vector<double> record = fresh_record<Formulation>(settings, {0, 1, 0});
    const BeamPrescription<double> none{};
    // Deform: a little of everything in one step.
    BeamEnds<double> ends{side, {0.01, 0.02, -0.01}, {0.005, 0.004, 0.003}, {0.002, -0.003, 0.004}};
    beam_step<Formulation>(settings, elastic, ends, none, 1.0, record.data());
    const BeamMode<double> start = load_mode(record.data() + beam_record::resultant);
    EXPECT_GT(std::abs(start.bend_s), 0);

    const double angle = 2 * std::numbers::pi / steps;
    for (int i = 1; i <= steps; ++i) {
        const Vec3 now = turned(side, axis, i * angle), before = turned(side, axis, (i - 1) * angle);
        // Central difference moves ends along chords; the spin is the turning itself.
        const BeamEnds<double> motion{now, now - before, angle * axis, {}};
        beam_step<Formulation>(settings, elastic, motion, none, 1.0, record.data());
    }
    const BeamMode<double> end = load_mode(record.data() + beam_record::resultant);
    return std::max({std::abs(end.stretch - start.stretch), std::abs(end.twist - start.twist),
                     std::abs(end.bend_s - start.bend_s), std::abs(end.bend_t - start.bend_t)});
}

} // namespace

TEST(BeamKernel, AFullTurnLeavesItsForces)
{
    // No stretch, twist or bending comes of a turn. Sway is left out: ends that move along chords while spins
    // follow the arc give some at third order of the step's angle, as in every explicit beam.
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, unit({1, 2, 3})}) {
        EXPECT_LT(change_over_turn<IntegratedBeam>(axis, 500), 1e-10);
        EXPECT_LT(change_over_turn<ResultantBeam>(axis, 500), 1e-10);
    }
}

TEST(BeamKernel, TheSectionFollowsATurnAboutTheAxis)
{
    BeamFrame<double> middle, end;
    Vec3 e2{0, 1, 0};
    const int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        follow_frame<double>({{1, 0, 0}, {}, {2 * std::numbers::pi / steps * 7, 0, 0}, {}}, e2, 1.0, middle,
                             end);
        e2 = end.e2;
    }
    // Seven turns in steps of 2.5 degrees.
    EXPECT_NEAR(e2.y, 1, 1e-12);
    EXPECT_NEAR(e2.z, 0, 1e-9);
}

TEST(BeamKernel, ForcesDoTheWorkOfTheirMode)
{
    const Vec3 side{1, 2, 2};
    const BeamFrame<double> frame = transported<double>({1, 0, 0}, {0, 1, 0}, side, 0.3);
    const BeamEnds<double> ends{side, {0.3, -0.2, 0.7}, {0.4, 0.1, -0.6}, {-0.3, 0.5, 0.2}};
    const BeamMode<double> mode{1.5, -0.7, 0.4, 0.9, -1.1, 0.6};
    const BeamForces<double> forces = beam_forces(frame, mode);
    const Vec3 spin1 = ends.mean_spin - 0.5 * ends.spin, spin2 = ends.mean_spin + 0.5 * ends.spin;
    const double power =
        dot(forces.force, ends.velocity) + dot(forces.moment1, spin1) + dot(forces.moment2, spin2);
    EXPECT_NEAR(-power, work_of(mode, beam_increment(frame, ends, 1.0)), 1e-14);
    // No resultant moment about node 1.
    const Vec3 moment = forces.moment1 + forces.moment2 + cross(side, forces.force);
    EXPECT_LT(norm(moment), 1e-14);
}

TEST(BeamKernel, LanesEqualTheScalarReference)
{
    const BeamSettings settings = settings_of(1);
    const int size = IntegratedBeam::record_size<Elastic>(settings.section);
    std::vector<Lanes> batch(size);
    std::vector<std::vector<double>> single;
    std::vector<BeamEnds<double>> motions;
    BeamEnds<Lanes> ends;
    for (int lane = 0; lane < lane_count; ++lane) {
        const double a = 0.1 * lane;
        motions.push_back(
            {{3 + a, a, -a}, {0.01 * a, 0.02, -0.03 * a}, {0.05, -0.04 * a, 0.03}, {0.02 * a, 0.01, -0.02}});
        single.push_back(fresh_record<IntegratedBeam>(settings, unit({-a, 3 + a, 0})));
        for (int i = 0; i < size; ++i) batch[i][lane] = single.back()[i];
        const auto put = [&](Vector3<Lanes>& to, const Vec3& from) {
            to.x[lane] = from.x;
            to.y[lane] = from.y;
            to.z[lane] = from.z;
        };
        put(ends.side, motions.back().side);
        put(ends.velocity, motions.back().velocity);
        put(ends.mean_spin, motions.back().mean_spin);
        put(ends.spin, motions.back().spin);
    }
    const auto lanes =
        beam_step<IntegratedBeam>(settings, elastic, ends, BeamPrescription<Lanes>{}, 0.7, batch.data());
    for (int lane = 0; lane < lane_count; ++lane) {
        const auto one = beam_step<IntegratedBeam>(settings, elastic, motions[lane],
                                                   BeamPrescription<double>{}, 0.7, single[lane].data());
        EXPECT_NEAR(lanes.forces.force.y[lane], one.forces.force.y, 1e-13);
        EXPECT_NEAR(lanes.forces.moment2.z[lane], one.forces.moment2.z, 1e-13);
        EXPECT_NEAR(lanes.internal_work[lane], one.internal_work, 1e-13);
    }
}

namespace {

/// Axial stress after a strain path of the three strains of a beam point.
template <class Law>
std::array<double, 3> driven(const Law& law, std::array<double, 3> strain, int steps, double duration = 1)
{
    double stress[3] = {};
    std::array<double, Law::history_size + 1> history{};
    const auto start = law.initial_history();
    for (std::size_t i = 0; i < start.size(); ++i) history[i] = start[i];
    for (int i = 0; i < steps; ++i) {
        law.update_beam(stress, strain[0] / steps, strain[1] / steps, strain[2] / steps,
                        HistoryView<double>{history.data()}, duration / steps);
    }
    return {stress[0], stress[1], stress[2]};
}

} // namespace

TEST(BeamLaws, FollowTheClosedFormsOfPullAndShear)
{
    const double e = 200, nu = 0.3, g = e / 2.6, yield = 0.3, tangent = 20;
    const double hardening = e * tangent / (e - tangent);
    const Record record =
        make_record("MAT_PLASTIC_KINEMATIC",
                    {{"RO", 1}, {"E", e}, {"PR", nu}, {"SIGY", yield}, {"ETAN", tangent}, {"BETA", 0.4}});
    const Model model;
    const auto mixed = PlasticKinematic<true>::from_record(record, model);
    const auto piecewise = PiecewiseLinearPlasticity::from_record(
        make_record("MAT_PIECEWISE_LINEAR_PLASTICITY",
                    {{"RO", 1}, {"E", e}, {"PR", nu}, {"SIGY", yield}, {"ETAN", tangent}}),
        model);
    const double strain = 0.01;
    const double pulled = yield + tangent * (strain - yield / e);
    EXPECT_NEAR(driven(mixed, {strain, 0, 0}, 10)[0], pulled, 1e-12);
    EXPECT_NEAR(driven(piecewise, {strain, 0, 0}, 10)[0], pulled, 1e-12);
    // Shear: sqrt(3) tau = yield + H p with gamma = tau / G + sqrt(3) p.
    const double tau =
        (yield + hardening * strain / std::sqrt(3)) / (std::sqrt(3) + hardening / (std::sqrt(3) * g));
    EXPECT_NEAR(driven(mixed, {0, strain, 0}, 10)[1], tau, 1e-12);
    EXPECT_NEAR(driven(piecewise, {0, 0, strain}, 10)[2], tau, 1e-12);
    // Reversal of mixed hardening: yields at the back stress (0.6 of the growth) less the new radius.
    const double growth = pulled - yield, back = 0.6 * growth, radius = yield + 0.4 * growth;
    const double elastic_way = 2 * radius / e;
    double stress[3] = {};
    std::array<double, 8> history{};
    mixed.update_beam(stress, strain, 0.0, 0.0, HistoryView<double>{history.data()}, 1);
    mixed.update_beam(stress, -elastic_way, 0.0, 0.0, HistoryView<double>{history.data()}, 1);
    EXPECT_NEAR(stress[0], back - radius, 1e-12);
    mixed.update_beam(stress, -0.002, 0.0, 0.0, HistoryView<double>{history.data()}, 1);
    EXPECT_NEAR(stress[0], back - radius - tangent * 0.002, 1e-12);
}

} // namespace plash

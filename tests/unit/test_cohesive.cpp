#include "elements/cohesive_solids.h"
#include "tests/support/records.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// mm, ms, kg, GPa: N/mm is kN/m; an epoxy between plies.
constexpr double en = 100, et = 40, gic = 0.3e-3, giic = 0.9e-3, peak_n = 0.03, peak_s = 0.05;

std::vector<std::pair<const char*, double>> cohesive_card(std::vector<std::pair<const char*, double>> more)
{
    more.insert(more.end(), {{"RO", 1e-6},
                             {"ROFLG", 1},
                             {"EN", en},
                             {"ET", et},
                             {"GIC", gic},
                             {"GIIC", giic},
                             {"XMU", 1.5},
                             {"T", peak_n},
                             {"S", peak_s},
                             {"INTFAIL", 1}});
    return more;
}

CohesiveMixedMode cohesive_law_of(std::vector<std::pair<const char*, double>> more = {})
{
    return CohesiveMixedMode::from_record(
        make_record("MAT_COHESIVE_MIXED_MODE", cohesive_card(std::move(more))));
}

/// Energy by area that is used up when the sides part along a direction.
double used_up(const CohesiveMixedMode& law, const Vec3& direction, double length)
{
    double damage = 0, energy = 0;
    const int steps = 100000;
    Vec3 before{};
    for (int i = 1; i <= steps; ++i) {
        const Vec3 now = law.traction((length * i / steps) * direction, damage);
        energy += 0.5 * dot(before + now, direction) * length / steps;
        before = now;
    }
    EXPECT_EQ(damage, 1);
    return energy;
}

/// One cohesive element of unit area without thickness between z = 0 and z = 0.
struct Glued {
    testing::SolidBlock block;
    State state;
    std::vector<std::unique_ptr<Term>> terms;
    Clock clock;

    explicit Glued(std::vector<std::pair<const char*, double>> more = {})
        : block({1, 1, 1}, {1, 1, 0}, make_record("MAT_COHESIVE_MIXED_MODE", cohesive_card(std::move(more))))
    {
        block.model.sections[0] = testing::record_of("SECTION_SOLID", 1, {{"ELFORM", 19}});
        state = block.state();
        terms = make_cohesive_solids(block.model, state);
        clock.last_step = 1;
    }

    /// Moves all nodes in steps: to(node, share).
    template <class To>
    void move(To&& to, int steps)
    {
        for (int i = 1; i <= steps; ++i) {
            for (std::size_t n = 0; n < state.size(); ++n) {
                const Vec3 next = to(n, static_cast<double>(i) / steps);
                state.velocity[n] = next - state.position[n];
                state.position[n] = next;
            }
            state.clear_forces();
            terms[0]->add_forces(clock, state);
        }
    }
    Vec3 start(std::size_t n) const { return block.model.nodes.position[n]; }
    double energy()
    {
        EnergyLedger ledger;
        ledger.open_cycle(1);
        terms[0]->report(ledger);
        ledger.close_cycle();
        return ledger.internal + ledger.eroded_internal;
    }
};

} // namespace

/// Pure modes: triangle under the energy of the mode, on the way back to the origin.
TEST(CohesiveMixedMode, HasTheTrianglesOfItsModes)
{
    const CohesiveMixedMode law = cohesive_law_of();
    double damage = 0;
    EXPECT_NEAR(law.traction(Vec3{0, 0, 2e-4}, damage).z, en * 2e-4, 1e-15);
    const double peak = peak_n / en, last = 2 * gic / peak_n, half = 0.5 * (peak + last);
    EXPECT_NEAR(law.traction(Vec3{0, 0, half}, damage).z, 0.5 * peak_n, 1e-14);
    EXPECT_NEAR(law.traction(Vec3{0, 0, 0.5 * half}, damage).z, 0.25 * peak_n, 1e-14);
    EXPECT_NEAR(law.traction(Vec3{0, 0, -1e-3}, damage).z, -en * 1e-3, 1e-14); // pressed: as if whole
    EXPECT_NEAR(used_up(law, {0, 0, 1}, 1.1 * last), gic, 1e-6 * gic);
    EXPECT_NEAR(used_up(law, {0.6, 0.8, 0}, 2.2 * giic / peak_s), giic, 1e-6 * giic);
}

/// At a fixed mode ratio the energies of both modes used up obey the criterion: (G1/GIC)^XMU + (G2/GIIC)^XMU
/// = 1, or GIC + (GIIC - GIC) (G2 / (G1 + G2))^|XMU|.
TEST(CohesiveMixedMode, UsesUpTheEnergyOfItsCriterion)
{
    for (const double ratio : {0.3, 1.0, 2.5}) {
        const double c = 1 / std::sqrt(1 + ratio * ratio), s = ratio * c;
        const double n = en * c * c, t = et * s * s; // shares of the energy
        const double total = used_up(cohesive_law_of(), {s, 0, c}, 0.2);
        const double g1 = total * n / (n + t), g2 = total * t / (n + t);
        EXPECT_NEAR(std::pow(g1 / gic, 1.5) + std::pow(g2 / giic, 1.5), 1, 1e-5) << ratio;
        const double other = used_up(cohesive_law_of({{"XMU", -2}}), {s, 0, c}, 0.2);
        EXPECT_NEAR(other, gic + (giic - gic) * std::pow(t / (n + t), 2), 1e-5 * other) << ratio;
    }
}

/// A peak that is left out follows from the ultimate separation.
TEST(CohesiveMixedMode, TakesItsPeakFromTheUltimateSeparation)
{
    const CohesiveMixedMode law = cohesive_law_of({{"T", 0}, {"UND", 0.02}});
    EXPECT_DOUBLE_EQ(law.normal_strength, 2 * gic / 0.02);
    EXPECT_THROW(cohesive_law_of({{"T", 0}}), DeckError);
    EXPECT_THROW(cohesive_law_of({{"T", -1}}), DeckError);
    EXPECT_THROW(cohesive_law_of({{"T", 1}}), DeckError); // beyond the energy
    EXPECT_THROW(cohesive_law_of({{"XMU", 0}}), DeckError);
}

/// Pulled apart: forces on the nodes, energy GIC times area, and the element goes.
TEST(CohesiveSolids, TakeTheEnergyOfTheirAreaAndGo)
{
    for (double failing : {1.0, 4.0, -1.0}) {
        Glued glued({{"INTFAIL", failing}});
        EXPECT_NEAR(glued.state.mass[0], 1e-6 / 8, 1e-20);
        const double peak = peak_n / en, last = 2 * gic / peak_n;
        const auto part = [&](double gap) {
            return [&glued, gap](std::size_t n, double share) {
                Vec3 x = glued.start(n);
                if (n >= 4) x.z += share * gap;
                return x;
            };
        };
        glued.move(part(peak), 10);
        for (int n = 0; n < 4; ++n) EXPECT_NEAR(glued.state.force[n].z, peak_n / 4, 1e-12);
        for (int n = 4; n < 8; ++n) EXPECT_NEAR(glued.state.force[n].z, -peak_n / 4, 1e-12);
        glued.move(part(1.01 * last), 4000);                     // back first, then apart
        EXPECT_NEAR(glued.energy(), gic, 2e-6 * gic) << failing; // trapezoids of a bent line
        EXPECT_EQ(glued.state.deleted_solids.size(), 1u);
        EXPECT_EQ(glued.state.deletions, 1);
        EXPECT_EQ(glued.state.force[0].z, 0);
    }
}

TEST(CohesiveSolids, StayWithoutIntfail)
{
    Glued glued({{"INTFAIL", 0}});
    glued.move(
        [&](std::size_t n, double share) {
            Vec3 x = glued.start(n);
            if (n >= 4) x.x += 0.1 * share;
            return x;
        },
        2000);
    EXPECT_NEAR(glued.energy(), giic, 1e-4 * giic);
    EXPECT_EQ(glued.state.deletions, 0);
    EXPECT_NEAR(glued.state.force[0].x, 0, 1e-15);
}

/// Opened, then turned as a whole: forces turn along, no work is done. (Sheared open it would be: the
/// tractions of the two sides then are a couple, as in all such elements; Vossen & others 2013, Int. J.
/// Fract. 179, 1.)
TEST(CohesiveSolids, TurnWithoutStrain)
{
    Glued glued;
    const Vec3 gap{0, 0, 2e-4};
    const auto opened = [&](std::size_t n) { return n < 4 ? glued.start(n) : glued.start(n) + gap; };
    glued.move([&](std::size_t n, double) { return opened(n); }, 1);
    const double energy = glued.energy();
    const Vec3 before = glued.state.force[0];
    glued.move(
        [&](std::size_t n, double share) {
            const double angle = 2.0943951023931953 * share, c = std::cos(angle), s = std::sin(angle);
            const Vec3 x = opened(n); // about x
            return Vec3{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
        },
        2000);
    const double c = -0.5, s = std::sqrt(0.75);
    const Vec3 turned{before.x, c * before.y - s * before.z, s * before.y + c * before.z};
    EXPECT_NEAR(norm(glued.state.force[0] - turned), 0, 1e-12);
    EXPECT_NEAR(glued.energy(), energy, 1e-5 * energy);
}

namespace {

/// Two shells' middle surfaces 2 apart, glued by ELFORM 20; nodes move and turn as told.
struct GluedShells {
    testing::SolidBlock block;
    State state;
    std::vector<std::unique_ptr<Term>> terms;
    Clock clock;

    explicit GluedShells(double offset = 0)
        : block({1, 1, 1}, {1, 1, 2}, make_record("MAT_COHESIVE_MIXED_MODE", cohesive_card({})))
    {
        block.model.sections[0] =
            testing::record_of("SECTION_SOLID", 1, {{"ELFORM", 20}, {"COHOFF", offset}});
        state = block.state();
        terms = make_cohesive_solids(block.model, state);
        clock.last_step = 1;
    }
    void step(const std::vector<Vec3>& place, const std::vector<Vec3>& spin)
    {
        for (std::size_t n = 0; n < 8; ++n) {
            state.velocity[n] = place[n] - state.position[n];
            state.position[n] = place[n];
            state.angular_velocity[n] = spin[n];
        }
        state.clear_forces();
        terms[0]->add_forces(clock, state);
    }
    double energy()
    {
        EnergyLedger ledger;
        ledger.open_cycle(1);
        terms[0]->report(ledger);
        ledger.close_cycle();
        return ledger.internal;
    }
};

} // namespace

/// The lower shell turns by a small angle where it stands: its side of the layer slides by the angle times
/// the arm, 1 + COHOFF times half the distance, and the tractions have a moment about its nodes.
TEST(CohesiveOffsets, TurnedShellsShearTheLayer)
{
    for (const double offset : {0.0, 0.5, -1.0}) {
        GluedShells glued(offset);
        const double angle = 1e-4, lower = 1 + offset, upper = 1 - offset;
        std::vector<Vec3> spin(8);
        for (int n = 0; n < 4; ++n) spin[n] = {0, angle / 10, 0};
        const std::vector<Vec3> place = glued.block.model.nodes.position;
        for (int i = 0; i < 10; ++i) glued.step(place, spin);
        const double force = et * angle * lower / 4;
        for (int n = 0; n < 4; ++n) {
            EXPECT_NEAR(glued.state.force[n].x, -force, 1e-7 * et * angle); // angle^2, and the layer's slope
            EXPECT_NEAR(glued.state.moment[n].y, -force * lower, 1e-3 * et * angle * lower + 1e-15);
            EXPECT_NEAR(glued.state.force[n + 4].x, force, 1e-7 * et * angle);
            EXPECT_NEAR(glued.state.moment[n + 4].y, -force * upper, 1e-3 * et * angle + 1e-15);
        }
        EXPECT_NEAR(glued.energy(), 0.5 * et * std::pow(angle * lower, 2), 1e-3 * et * angle * angle);
    }
}

/// Opened by 2e-4, then turned as a whole by a full turn: nothing changes.
TEST(CohesiveOffsets, AFullTurnDoesNoWork)
{
    GluedShells glued(0.3);
    std::vector<Vec3> place = glued.block.model.nodes.position, spin(8);
    for (int n = 4; n < 8; ++n) place[n].z += 2e-4;
    glued.step(place, spin);
    const double energy = glued.energy();
    const Vec3 before = glued.state.force[0];
    EXPECT_NEAR(before.z, en * 2e-4 / 4, 1e-12);
    const int steps = 3000;
    // The turn that Hughes & Winget's rotation gives for a spin is 2 atan(spin / 2).
    const double angle = 2 * std::acos(-1.0) / steps, rate = 2 * std::tan(angle / 2);
    std::fill(spin.begin(), spin.end(), Vec3{rate, 0, 0});
    for (int i = 1; i <= steps; ++i) {
        const double c = std::cos(i * angle), s = std::sin(i * angle);
        std::vector<Vec3> now;
        for (const Vec3& x : place) now.push_back({x.x, c * x.y - s * x.z, s * x.y + c * x.z});
        glued.step(now, spin);
    }
    // 3000 turns of arms of length 1.3 by 2e-16 of it, times EN / 4.
    EXPECT_NEAR(norm(glued.state.force[0] - before), 0, 2e-11);
    EXPECT_NEAR(glued.energy(), energy, 1e-5 * energy);
}

TEST(CohesiveSolids, RefuseOtherMaterials)
{
    testing::SolidBlock block({1, 1, 1}, {1, 1, 0},
                              testing::record_of("MAT_ELASTIC", 1, {{"RO", 1}, {"E", 1}, {"PR", 0}}));
    block.model.sections[0] = testing::record_of("SECTION_SOLID", 1, {{"ELFORM", 19}});
    State state = block.state();
    EXPECT_THROW(make_cohesive_solids(block.model, state), DeckError);
    EXPECT_TRUE(make_solid_groups(block.model, state).empty());
}

} // namespace plash

#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

/// Tip displacement along the load of the beam twisted by 90 degrees of MacNeal & Harder (1985), Finite
/// Elements in Analysis and Design 1, 3-20: length 12, width 1.1, thickness 0.32, E = 29e6, nu = 0.22,
/// clamped, unit force at the tip along z (`in_plane` of the tip's section) or y.
double tip_displacement(bool in_plane, int formulation, int along, int across)
{
    constexpr double length = 12, width = 1.1, thickness = 0.32, density = 1e-3;
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", density}, {"E", 29e6}, {"PR", 0.22}}),
                              {{"ELFORM", formulation}, {"NIP", 2}, {"SHRF", 5.0 / 6}, {"T1", thickness}});
    model.controls.elements.warping = 1;
    model.controls.elements.hourglass_type = 4;
    model.controls.elements.hourglass_coefficient = 0.03;
    add_grid(model, along, across, [&](int i, int j) {
        const double angle = std::numbers::pi / 2 * i / along,
                     r = width * (static_cast<double>(j) / across - 0.5);
        return Vec3{length * i / along, r * std::cos(angle), r * std::sin(angle)};
    });
    std::vector<Index> root, tip;
    for (Index j = 0; j <= across; ++j) {
        root.push_back(j * (along + 1));
        tip.push_back(j * (along + 1) + along);
    }
    hold(model, root, 63);
    // The tip's section lies along z. Consistent shares: half at the ends.
    const Vec3 direction = in_plane ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    for (std::size_t j = 0; j < tip.size(); ++j) {
        const double share = (j == 0 || j + 1 == tip.size() ? 0.5 : 1.0) / across;
        model.nodal_loads.push_back({{tip[j]}, direction, false, none, share, {}});
    }
    // First period, roughly that of the flat strip.
    const double period = 2 * std::numbers::pi / 3.516 * length * length *
                          std::sqrt(12 * density / (29e6 * thickness * thickness));
    model.controls.time.end_time = 3 * period;
    Scene scene = make_scene(model);
    scene.terms.push_back(std::make_unique<MassDamping>(2 * 2 * std::numbers::pi / period));
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    double mean = 0;
    for (std::size_t j = 0; j < tip.size(); ++j) {
        const double share = (j == 0 || j + 1 == tip.size() ? 0.5 : 1.0) / across;
        mean += share * dot(direction, scene.state.position[tip[j]] - model.nodes.position[tip[j]]);
    }
    return mean;
}

} // namespace

TEST(TwistedBeam, WarpingTermsGiveTheReferenceDisplacements)
{
    // MacNeal & Harder: 5.424e-3 in plane, 1.754e-3 out of plane.
    for (const int formulation : {2, 16}) {
        EXPECT_NEAR(tip_displacement(true, formulation, 24, 4), 5.424e-3, 0.02 * 5.424e-3) << formulation;
        EXPECT_NEAR(tip_displacement(false, formulation, 24, 4), 1.754e-3, 0.02 * 1.754e-3) << formulation;
    }
}

} // namespace plash

#include "output/bndout.h"
#include "output/recorders.h"
#include "output/spcforc.h"
#include "solver/explicit_loop.h"
#include "tests/support/shell_model.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A row of six hexahedra: one end held, a load in the middle, the other end driven; a second row is rigid
/// and driven.
Model loaded_rows()
{
    Model model;
    model.materials = {make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1e4}, {"PR", 0}}),
                       make_record("MAT_RIGID", {{"RO", 1}, {"E", 1e4}, {"PR", 0}})};
    model.sections = {make_record("SECTION_SOLID", {{"ELFORM", 1}})};
    for (Index part : {0, 1}) {
        model.parts.emplace_back();
        model.parts.back().id = 10 * (part + 1);
        model.parts.back().section = 0;
        model.parts.back().material = part;
        const Index first = static_cast<Index>(model.nodes.size());
        for (int i = 0; i <= 6; ++i) {
            for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 1, 1}, Vec3{0, 0, 1}}) {
                add_node(model, corner + Vec3{1.0 * i, 5.0 * part, 0});
            }
        }
        for (Index e = 0; e < 6; ++e) {
            const Index a = first + 4 * e, b = a + 4;
            model.solids.id.push_back(static_cast<Id>(model.solids.size()) + 1);
            model.solids.part.push_back(part);
            model.solids.nodes.push_back({a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2});
        }
    }
    hold(model, {0, 1, 2, 3}, 7);
    model.curves.resize(2);
    model.curves[0].curve = {{0, 1}, {0, 30}};
    model.curves[1].curve = {{0, 1}, {0, 2}};
    NodalLoad load;
    load.nodes = {12, 13};
    load.direction = {0, 0, 1};
    load.curve = 0;
    model.nodal_loads = {load};
    PrescribedMotion end;
    end.nodes = {24, 25, 26, 27};
    end.direction = {1, 0, 0};
    end.curve = 1;
    PrescribedMotion body = end;
    body.nodes.clear();
    body.rigid_part = 1;
    body.direction = {0, 1, 0};
    model.prescribed_motions = {end, body};
    model.controls.time.end_time = 0.3;
    model.controls.time.step_scale = 0.9;
    return model;
}

/// Looks at every cycle: change of momentum against the sum of the boundary's forces, energies against the
/// ledger.
class Accountant final : public Recorder {
public:
    double largest_force = 0, largest_error = 0, largest_energy_error = 0;
    int cycles = 0;

    double next_time() const override { return -1; }
    void write(const Snapshot& snapshot) override
    {
        ElementResults r;
        r.boundary_forces_wanted = true;
        r.part_motion.resize(snapshot.model.parts.size());
        snapshot.collect(r);
        Vec3 force{};
        double energy = 0;
        for (const auto* list : {&r.supports, &r.loads, &r.motions}) {
            for (const auto& entry : *list) {
                force += entry.force;
                energy += entry.energy;
            }
        }
        Vec3 momentum{}; // at n+1/2; the rigid row counts as one body
        for (std::size_t node = 0; node < snapshot.state.size(); ++node) {
            momentum += snapshot.state.mass[node] * snapshot.state.velocity[node];
        }
        const double* rigid = r.part_motion[1].momentum;
        momentum += Vec3{rigid[0], rigid[1], rigid[2]};
        if (cycles > 0) {
            const Vec3 change = (1 / snapshot.clock.velocity_step()) * (momentum - momentum_);
            largest_force = std::max(largest_force, norm(force));
            largest_error = std::max(largest_error, norm(change - force));
        }
        largest_energy_error =
            std::max(largest_energy_error, std::abs(energy - snapshot.ledger.external_work));
        momentum_ = momentum;
        ++cycles;
    }

private:
    Vec3 momentum_{};
};

} // namespace

TEST(BoundaryForces, AccountForEveryChangeOfMomentumAndForTheWork)
{
    const Model model = loaded_rows();
    Scene scene = make_scene(model);
    Recorders recorders;
    auto accountant = std::make_unique<Accountant>();
    const Accountant& seen = *accountant;
    recorders.push_back(std::move(accountant));
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
    EXPECT_GT(seen.cycles, 20);
    EXPECT_GT(seen.largest_force, 10);
    EXPECT_LT(seen.largest_error,
              1e-10 * seen.largest_force); // sums of a few dozen forces in double precision
    EXPECT_GT(scene.ledger.external_work, 0.1);
    EXPECT_LT(seen.largest_energy_error, 1e-12 * scene.ledger.external_work);
}

TEST(BoundaryForces, AreWrittenIntoTheirFiles)
{
    Model model = loaded_rows();
    for (const char* name : {"spcforc", "bndout", "rwforc"}) model.controls.output.ascii[name].interval = 0.1;
    testing::TemporaryFolder folder;
    Scene scene = make_scene(model);
    Recorders recorders = make_recorders(model, folder.path().string());
    ASSERT_EQ(recorders.size(), 3u); // no wall, no rwforc; history.h5
    run(scene, recorders);
    const std::string spcforc = testing::text_of(folder / "spcforc");
    EXPECT_NE(
        spcforc.find(
            "\n single point constraint forces\n\n output at time =   0.00000E+00\n node=       1 local "
            "x,y,z forces ="),
        std::string::npos);
    EXPECT_EQ(spcforc.find("moments"), std::string::npos); // only translations are held
    const std::string bndout = testing::text_of(folder / "bndout");
    EXPECT_NE(bndout.find("\n nd#      13  xforce="), std::string::npos);
    EXPECT_NE(bndout.find("\n nd#      28  xforce="), std::string::npos);
    EXPECT_NE(bndout.find("\nmat#      20  xforce="), std::string::npos);
}

// Layouts as LSTC's program l2a prints them from a binout.
TEST(BoundaryForces, HaveTheLayoutOfLsDyna)
{
    const SupportRow support{7, true, true, {1, -2, 3}, {0, 0, 4}};
    EXPECT_EQ(format_spcforc(0.5, std::vector{support, support}),
              R"( output at time =   5.00000E-01
 node=       7 local x,y,z forces =    1.0000E+00   -2.0000E+00    3.0000E+00  setid=       0
 node=       7 local x,y,z moments=    0.0000E+00    0.0000E+00    4.0000E+00  setid=       0
 node=       7 local x,y,z forces =    1.0000E+00   -2.0000E+00    3.0000E+00  setid=       0
 node=       7 local x,y,z moments=    0.0000E+00    0.0000E+00    4.0000E+00  setid=       0
             force resultants   =    2.0000E+00   -4.0000E+00    6.0000E+00
)");
    const BoundaryRow node{3, false, {1, 2, 3}, {}, 0.5}, part{4, true, {1, 0, 0}, {0, 5, 0}, 0.25};
    EXPECT_EQ(format_bndout(0.5, {}, std::vector{node, part}), R"(




 n o d a l   f o r c e/e n e r g y    o u t p u t   t=5.000E-01





 velocity boundary condition forces/rigid body moments 

 nd#       3  xforce=   1.0000E+00   yforce=   2.0000E+00  zforce=   3.0000E+00   energy=   5.0000E-01
mat#       4  xforce=   1.0000E+00   yforce=   0.0000E+00  zforce=   0.0000E+00   energy=   2.5000E-01
             xmoment=   0.0000E+00  ymoment=   5.0000E+00 zmoment=   0.0000E+00
              xtotal=   2.0000E+00   ytotal=   2.0000E+00  ztotal=   3.0000E+00   etotal=   7.5000E-01
)");
}

} // namespace plash

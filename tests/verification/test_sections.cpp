#include "output/secforc.h"
#include "tests/support/point_masses.h"
#include "tests/support/shell_model.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Keeps the section forces of the last snapshot.
class SectionWatcher final : public Recorder {
public:
    explicit SectionWatcher(std::vector<SectionRow>& rows) : rows_(rows) {}
    double next_time() const override { return forever; }
    void write(const Snapshot&) override {}
    void finish(const Snapshot& snapshot) override { rows_ = section_rows(snapshot); }

private:
    std::vector<SectionRow>& rows_;
};

/// A force that is shared out evenly to some nodes.
void load(Model& model, std::vector<Index> nodes, const Vec3& direction, double whole)
{
    NodalLoad force;
    force.scale = whole / static_cast<double>(nodes.size());
    force.nodes = std::move(nodes);
    force.direction = direction;
    force.curve = testing::add_constant(model, 1);
    model.nodal_loads.push_back(std::move(force));
}

} // namespace

TEST(CrossSections, ABarUnderTensionCarriesItsLoadThroughEverySection)
{
    testing::SolidBlock block({8, 2, 2}, {8, 1, 1},
                              testing::record_of("MAT_ELASTIC", 1, {{"RO", 1}, {"E", 1e4}, {"PR", 0}}));
    Model& model = block.model;
    std::vector<Index> left;
    for (int j = 0; j <= 2; ++j) {
        for (int k = 0; k <= 2; ++k) {
            left.push_back(block.node(0, j, k));
        }
    }
    hold(model, left, 7);
    // An even traction: a quarter of a face on each of its corners.
    for (int j = 0; j <= 2; ++j) {
        for (int k = 0; k <= 2; ++k) {
            const double share = (j == 1 ? 2 : 1) * (k == 1 ? 2 : 1) / 16.0;
            load(model, {block.node(8, j, k)}, {1, 0, 0}, 9.0 * share);
        }
    }
    NodeDamping damping; // near critical for the first mode, w = pi / 2 sqrt(E / rho) / L = 19.6
    damping.rate = 40;
    model.dampings.push_back(damping);
    for (int cut : {2, 5}) { // the elements right of a layer of nodes pull it to the right
        CrossSection section;
        for (int j = 0; j <= 2; ++j) {
            for (int k = 0; k <= 2; ++k) section.nodes.push_back(block.node(cut, j, k));
        }
        for (int j = 0; j < 2; ++j) {
            for (int k = 0; k < 2; ++k) section.solids.push_back((k * 2 + j) * 8 + cut);
        }
        model.cross_sections.push_back(section);
    }
    model.controls.time.end_time = 2;
    std::vector<SectionRow> rows;
    testing::run_to_end(model, std::make_unique<SectionWatcher>(rows));
    ASSERT_EQ(rows.size(), 2u);
    for (const SectionRow& row : rows) {
        EXPECT_NEAR(row.force.x, 9, 1e-5); // exp(-20 t) of the first swing is left
        EXPECT_NEAR(row.force.y, 0, 1e-5);
        EXPECT_NEAR(norm(row.moment), 0, 1e-5);
    }
    EXPECT_NEAR(rows[0].centroid.x, 2, 0.01);
}

TEST(CrossSections, ACantileverOfShellsCarriesMomentAndShear)
{
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1e5}, {"PR", 0}}),
                              {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.5}});
    add_grid(model, 10, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
    hold(model, {0, 11}, 63);
    load(model, {10, 21}, {0, 0, 1}, 0.01);
    NodeDamping damping; // w = 3.516 sqrt(E I / (rho A L^4)) = 1.6
    damping.rate = 3.2;
    model.dampings.push_back(damping);
    CrossSection section;
    section.nodes = {4, 15};
    section.shells = {4};
    model.cross_sections.push_back(section);
    model.controls.time.end_time = 12;
    std::vector<SectionRow> rows;
    testing::run_to_end(model, std::make_unique<SectionWatcher>(rows));
    EXPECT_NEAR(rows[0].force.z, 0.01, 2e-6);
    EXPECT_NEAR(rows[0].moment.y, -0.01 * 6,
                5e-4); // six from the tip; one-point shells carry the moment at mid-element
}

} // namespace plash

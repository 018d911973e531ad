#include "output/ale_files.h"
#include "output/dbfsi.h"
#include "output/history_reader.h"
#include "output/recorders.h"
#include "tests/support/ale_deck.h"
#include "tests/support/lsda_reader.h"

#include <gtest/gtest.h>

#include <sstream>

namespace plash {

namespace {

using testing::EulerianRun;

/// look(snapshot) at the end of a run.
struct AtTheEnd final : Recorder {
    std::function<void(const Snapshot&)> look;

    explicit AtTheEnd(std::function<void(const Snapshot&)> its_look) : look(std::move(its_look)) {}
    double next_time() const override { return 0; }
    void write(const Snapshot&) override {}
    void finish(const Snapshot& snapshot) override { look(snapshot); }
};

const Record& record_of(const Model& model, std::string_view keyword)
{
    for (const Record& record : model.others)
        if (record.keyword == keyword) return record;
    throw std::runtime_error("the deck has no such record");
}

std::vector<double> numbers_of_last_line(const std::string& text)
{
    std::istringstream lines(text.substr(text.rfind('\n', text.size() - 2) + 1));
    std::vector<double> numbers;
    for (double value; lines >> value;) numbers.push_back(value);
    return numbers;
}

/// Half a box of liquid of density 1000 that moves with (3, 4, 0) along walls that carry nothing (all in a
/// large mesh), the rest void.
std::string moving_liquid()
{
    return testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {10, 10, 10}) +
           testing::liquid_and_void(1000, 100) +
           "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1,3,4,0\n0.2,0.2,0.2,0.6,0.7,0.8\n"
           "*DEFINE_BOX\n7,0,0.4,-1,2,-1,2\n*DEFINE_BOX\n8,0.4,2,-1,2,-1,2\n";
}

} // namespace

// Sums of the groups: at the start the liquid's volume and the void's fill the mesh; mass, momentum and
// kinetic energy are rho V, m v and m v^2 / 2; boxes split them. As text, and as arrays.
TEST(AleFiles, GroupsHaveTheirSums)
{
    const testing::TemporaryFolder folder;
    EulerianRun run(moving_liquid() +
                    "*DATABASE_ALE_MAT\n0.001\n*DATABASE_ALE_MAT\n0.001,7,8\n*DATABASE_GLSTAT\n0.001,2\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.001\n*END\n");
    Recorders recorders;
    for (auto& recorder : make_recorders(run.model(), folder.path().string()))
        recorders.push_back(std::move(recorder));
    const FluidGroupSums whole(run.model(), record_of(run.model(), "DATABASE_ALE_MAT"));
    std::vector<FluidGroupSums::Row> rows;
    recorders.push_back(
        std::make_unique<AtTheEnd>([&](const Snapshot& snapshot) { rows = whole.rows(snapshot); }));
    ASSERT_EQ(plash::run(run.scene(), recorders).termination, Outcome::Termination::normal);
    recorders.clear();
    const double volume = 0.4 * 0.5 * 0.6, mass = 1000 * volume;
    ASSERT_EQ(rows.size(), 2);
    EXPECT_NEAR(rows[0].sum.mass, mass, 1e-12 * mass);
    EXPECT_NEAR(rows[0].sum.momentum[0], 3 * mass, 1e-9 * mass);
    EXPECT_NEAR(rows[0].sum.momentum[1], 4 * mass, 1e-9 * mass);
    EXPECT_NEAR(rows[0].sum.momentum[2], 0, 1e-9 * mass);
    EXPECT_NEAR(rows[0].sum.kinetic, 12.5 * mass, 1e-6 * mass);
    EXPECT_NEAR(rows[0].sum.volume + rows[1].sum.volume, 1, 1e-12);
    EXPECT_EQ(rows[1].sum.mass, 0);

    // The start, from history and binout: row 1 is box 7 with group 1, 3 box 8 with it.
    const auto arrays = testing::read_lsda(bytes_of(folder / "binout0000"));
    const auto masses = arrays.at("/alemat2/d000001/mass").reals();
    ASSERT_EQ(masses.size(), 4);
    EXPECT_NEAR(masses[0], mass / 2, 1e-9 * mass);
    EXPECT_NEAR(masses[2], mass / 2, 1e-9 * mass);
    EXPECT_EQ(arrays.at("/alemat2/metadata/boxes").wholes(), (std::vector<long>{7, 7, 8, 8}));
    EXPECT_EQ(arrays.at("/alemat2/metadata/ids").wholes(), (std::vector<long>{1, 2, 1, 2}));
    const std::vector<double> last = numbers_of_last_line(bytes_of(folder / "alemat"));
    ASSERT_EQ(last.size(), 11); // the void of the whole mesh
    EXPECT_EQ(last[1], 2);
    EXPECT_NEAR(last[2], 1 - volume, 1e-4);
}

// Cells of a set: six stresses by 1, , 6; density, mass and volume agree; IAVER = 1 gives the means.
TEST(AleFiles, CellsOfASetHaveTheirHistories)
{
    const testing::TemporaryFolder folder;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 12}, {2, 2, 24}) +
                    testing::liquid_and_void(1000, 1000) + testing::liquid_in_box({0, 0, 0}, {1, 1, 10}) +
                    "*NODE\n90000,0,0,10\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n"
                    "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n"
                    "*SET_SOLID\n3\n1,5,9\n*DATABASE_ALE\n0.001,3,1\n1,,6,11,12,13,14,8\n" +
                    testing::gravity(9.81) + testing::closed(0.001));
    Recorders recorders;
    for (auto& recorder : make_recorders(run.model(), folder.path().string()))
        recorders.push_back(std::move(recorder));
    const FluidCellHistories cells(run.model(), record_of(run.model(), "DATABASE_ALE"));
    std::vector<std::vector<double>> values;
    recorders.push_back(
        std::make_unique<AtTheEnd>([&](const Snapshot& snapshot) { values = cells.values(snapshot); }));
    ASSERT_EQ(plash::run(run.scene(), recorders).termination, Outcome::Termination::normal);
    recorders.clear();
    EXPECT_EQ((std::vector<int>(cells.variables().begin(), cells.variables().end())),
              (std::vector<int>{1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 8}));
    ASSERT_EQ(values.size(), 3);
    for (int row = 0; row < 3; ++row) {
        // Elements 1, 5 and 9 lie above one another, 0.5 m each: middles 9.75, 9.25, 8.75 m deep.
        const double pressure = 1e9 * std::expm1(1000 * 9.81 * (9.75 - 0.5 * row) / 1e9);
        EXPECT_NEAR(values[row][6], pressure, 1e-4 * pressure);
        for (int stress = 0; stress < 3; ++stress) EXPECT_NEAR(values[row][stress], -values[row][6], 1e-9);
        EXPECT_EQ(values[row][3], 0);
        EXPECT_NEAR(values[row][8], 0.125, 1e-14);
        EXPECT_NEAR(values[row][7], values[row][8] * values[row][9], 1e-12);
    }
    const std::string text = bytes_of(folder / "dbale");
    const std::string last = text.substr(text.rfind("average"));
    EXPECT_NEAR(std::stod(last.substr(7)), (values[0][0] + values[1][0] + values[2][0]) / 3, 1);
}

TEST(AleFiles, VariablesThatAreNotThereAreRefused)
{
    EulerianRun run(moving_liquid() + "*SET_SOLID\n3\n1,5,9\n*DATABASE_ALE\n0.001,3,1\n9\n"
                                      "*CONTROL_TERMINATION\n0.001\n*END\n");
    try {
        FluidCellHistories(run.model(), record_of(run.model(), "DATABASE_ALE"));
        ADD_FAILURE() << "no complaint";
    } catch (const DeckError& error) {
        EXPECT_NE(std::string(error.what()).find("field VAR: 9 is not supported"), std::string::npos)
            << error.what();
    }
}

// Columns of *DATABASE_FSI that dbfsi does not show are named.
TEST(AleFiles, ColumnsOfSurfacesThatAreNotShownAreNamed)
{
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "deck.k") << "*KEYWORD\n"
                                     << moving_liquid() << "*DATABASE_FSI\n0.001,2\n1,10,1,0,0,7\n*END\n";
    const ReadResult read = read_model(folder / "deck.k");
    bool named = false;
    for (const Message& warning : read.report.warnings) named = named || warning.field == "NDSETID";
    EXPECT_TRUE(named);
    EXPECT_EQ(fluid_surface_form(read.model), 2);
    EXPECT_TRUE(has_fluid_surfaces(read.model));
}

} // namespace plash

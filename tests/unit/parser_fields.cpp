// How a data line becomes fields: rules 3, 5 and 7 to 14 of the format.

#include "tests/unit/parser_support.h"

namespace plash {
namespace {

/// The curve of a deck that holds just one.
const Curve& only_curve(const ReadResult& result)
{
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.curves.size(), 1u);
    return result.model.curves.at(0).curve;
}

const Record& only_material(const ReadResult& result)
{
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.materials.size(), 1u);
    return result.model.materials.at(0);
}

} // namespace

TEST(Fields, FixedColumnsMayTouch)
{
    const ReadResult result = read_text("*KEYWORD\n*MAT_MOONEY-RIVLIN_RUBBER\n"
                                        "         19.20000E-7      0.495.40000E-44.75000E-5       0.0\n\n");
    const Record& material = only_material(result);
    EXPECT_EQ(material.id, 1);
    EXPECT_EQ(material.real("RO"), 9.2e-7);
    EXPECT_EQ(material.real("PR"), 0.49);
    EXPECT_EQ(material.real("A"), 5.4e-4);
    EXPECT_EQ(material.real("B"), 4.75e-5);
}

TEST(Fields, CommaLinesAreFreeAndMixWithFixedOnes)
{
    const ReadResult result = read_text("*MAT_PIECEWISE_LINEAR_PLASTICITY\n"
                                        "7,7.8e-6,210.,,0.5\n"
                                        "      40.0       5.0\n"
                                        "0,.1\n");
    const Record& material = only_material(result);
    EXPECT_EQ(material.id, 7);
    EXPECT_EQ(material.real("E"), 210);
    EXPECT_EQ(material.real("PR"), 0); // an empty item is the default
    EXPECT_EQ(material.real("SIGY"), 0.5);
    EXPECT_EQ(material.real("C"), 40);
    EXPECT_EQ(material.real("P"), 5);
    EXPECT_EQ(material.real("EPS2"), 0.1);
    EXPECT_EQ(material.real("ES8"), 0); // a line that is not there: defaults
}

TEST(Fields, ABlankLineIsACardOfDefaults)
{
    const ReadResult result = read_text("*CONTROL_BULK_VISCOSITY\n\n*CONTROL_SHELL\n\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.controls.elements.quadratic_viscosity, 1.5);
    EXPECT_EQ(result.model.controls.elements.linear_viscosity, 0.06);
    EXPECT_EQ(result.model.controls.elements.warping, 2);
}

TEST(Fields, ABlankLineInsideAMaterialIsItsSecondCard)
{
    const ReadResult result = read_text("*MAT_PIECEWISE_LINEAR_PLASTICITY\n"
                                        "         1       2.0\n"
                                        "\n"
                                        "       0.0       0.1\n"
                                        "       5.0       6.0\n");
    const Record& material = only_material(result);
    EXPECT_EQ(material.real("C"), 0);
    EXPECT_EQ(material.real("EPS2"), 0.1);
    EXPECT_EQ(material.real("ES1"), 5);
}

TEST(Fields, CommentsMayStandBetweenTheLinesOfACard)
{
    const ReadResult result =
        read_text("$ a deck\n*MAT_ELASTIC\n$#   mid        ro\n         1       2.0\n$ end\n");
    EXPECT_EQ(only_material(result).real("RO"), 2);
}

TEST(Fields, TextBehindTheLastFieldIsIgnored)
{
    const ReadResult result =
        read_text("*CONTROL_BULK_VISCOSITY\n"
                  "       1.2       0.1         1         0         0 some words, and a comma\n");
    EXPECT_EQ(result.model.controls.elements.quadratic_viscosity, 1.2);
}

TEST(Fields, LineEndsTabsAndForeignBytes)
{
    const ReadResult result = read_text("*MAT_ELASTIC_TITLE\r\nSt\xe4hl \xe6\xb0\xb4\r\n         1\t2.0\r\n");
    const Record& material = only_material(result);
    EXPECT_EQ(material.title, "St\xe4hl \xe6\xb0\xb4");
    EXPECT_EQ(material.real("RO"), 2); // the tab ends at column 16, inside the second field
}

TEST(Fields, NumbersOffTheirColumnsAreReadByBlanksWithAWarning)
{
    const ReadResult result =
        read_text("*DEFINE_CURVE\n         1\n       0.0       1.0\n       2.0       3.0\n");
    EXPECT_EQ(only_curve(result).ordinate, (std::vector<double>{1, 3}));
    EXPECT_FALSE(result.report.warnings.empty());
}

TEST(Fields, ALineShiftedByHandIsReadWithAWarning)
{
    const ReadResult result =
        read_text("*CONTROL_TERMINATION\n       10.0         0       0.0       0.01.000000E8         0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.controls.time.end_time, 10);
    EXPECT_EQ(result.model.controls.time.end_mass_change, 1e8);
    EXPECT_FALSE(result.report.warnings.empty());
}

TEST(Fields, WholeNumbersMayBeWrittenAsReals)
{
    const ReadResult result =
        read_text("*SECTION_SHELL\n       1.0        2.                  3.\n       1.0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.sections.at(0).id, 1);
    EXPECT_EQ(result.model.sections[0].integer("NIP"), 3);
}

TEST(Fields, LongFormatHasTwentyColumns)
{
    const ReadResult result = read_text("*KEYWORD LONG=Y\n*NODE\n"
                                        "                   1                 1.5                 2.5"
                                        "                 3.5                   7                   0\n"
                                        "*MAT_ELASTIC\n"
                                        "                   4                 2.0               210.0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.nodes.position.at(0).z, 3.5);
    EXPECT_EQ(result.model.fixed_nodes.at(0).freedoms, 7u);
    EXPECT_EQ(result.model.materials.at(0).real("E"), 210);
}

TEST(Fields, TenColumnIntegers)
{
    const ReadResult result =
        read_text("*KEYWORD I10=Y\n*NODE\n"
                  "         1             1.5             2.5             3.5         7\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.nodes.position.at(0).z, 3.5);
    EXPECT_EQ(result.model.fixed_nodes.at(0).freedoms, 7u);
}

TEST(Fields, ASuffixOverridesTheFormatForOneBlock)
{
    const ReadResult result = read_text("*KEYWORD\n*MAT_ELASTIC +\n"
                                        "                   4                 2.0               210.0\n"
                                        "*MAT_ELASTIC\n"
                                        "         5       3.0     211.0\n"
                                        "*NODE %\n"
                                        "         9             1.5             2.5             3.5\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.materials.at(0).real("E"), 210);
    EXPECT_EQ(result.model.materials.at(1).real("E"), 211);
    EXPECT_EQ(result.model.nodes.id.at(0), 9);
}

TEST(Fields, HeadingsKeepTheirCommas)
{
    const ReadResult result = read_text("*RIGIDWALL_PLANAR_ID\n"
                                        "         3Fix x,y,z target\n"
                                        "         0\n"
                                        "       0.0       0.0       0.0       0.0       0.0       1.0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.rigid_walls.at(0).id, 3);
    EXPECT_EQ(result.model.rigid_walls[0].title, "Fix x,y,z target");
}

TEST(Fields, NodesReadTheSameInEveryFormat)
{
    const ReadResult result =
        read_text("*NODE\n"
                  "       1             1.5             2.5            -3.5       4       6\n"
                  "2,1.5,2.5,-3.5,4,6\n"
                  "       3  1.50000000E+00          .25D+01          -3.5E0       4       6\n"
                  "       4             1.5             2.5            -3.5\n");
    EXPECT_EQ(errors_of(result), "");
    const Nodes& nodes = result.model.nodes;
    ASSERT_EQ(nodes.size(), 4u);
    for (const Vec3& position : nodes.position) {
        EXPECT_EQ(position.x, 1.5);
        EXPECT_EQ(position.y, 2.5);
        EXPECT_EQ(position.z, -3.5);
    }
    // TC 4: x and y; RC 6: about z and x.
    ASSERT_EQ(result.model.fixed_nodes.size(), 1u);
    EXPECT_EQ(result.model.fixed_nodes[0].freedoms, 3u | (4u | 1u) << 3);
    EXPECT_EQ(result.model.fixed_nodes[0].nodes, (std::vector<Index>{0, 1, 2}));
}

} // namespace plash

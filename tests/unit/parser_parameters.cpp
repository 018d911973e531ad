// *PARAMETER and its use in fields: rules 17 to 20 of the format.

#include "tests/unit/parser_support.h"

namespace plash {
namespace {

double end_time(const ReadResult& result)
{
    EXPECT_EQ(errors_of(result), "");
    return result.model.controls.time.end_time;
}

} // namespace

TEST(Parameters, ReplaceFieldsInFixedAndFreeFormat)
{
    EXPECT_EQ(
        end_time(read_text(
            "*PARAMETER\nR     tend       2.5I    count         3\n*CONTROL_TERMINATION\n     &tend\n")),
        2.5);
    EXPECT_EQ(end_time(read_text("*PARAMETER\nrtend,2.5\n*CONTROL_TERMINATION\n&tend,0\n")), 2.5);
}

TEST(Parameters, AMinusTurnsTheSign)
{
    const ReadResult result = read_text("*PARAMETER\nR       h       2.5\n*NODE\n"
                                        "       1              &h             -&h             0.0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.nodes.position.at(0).x, 2.5);
    EXPECT_EQ(result.model.nodes.position.at(0).y, -2.5);
}

TEST(Parameters, NamesMatchExactlyFirstThenWithoutCase)
{
    EXPECT_EQ(end_time(read_text("*PARAMETER\nRTend,1.,Rtend,2.\n*CONTROL_TERMINATION\n&tend\n")), 2);
    EXPECT_EQ(end_time(read_text("*PARAMETER\nRTend,1.\n*CONTROL_TERMINATION\n&TEND\n")), 1);
}

TEST(Parameters, ExpressionsMayGoOnOverLines)
{
    EXPECT_EQ(end_time(read_text("*PARAMETER\nR       a       2.0\n*PARAMETER_EXPRESSION\n"
                                 "R       b 3*&a+\n"
                                 "          sqrt(&a**4)\n"
                                 "*CONTROL_TERMINATION\n        &b\n")),
              10);
}

TEST(Parameters, ExpressionsKnowFortransFunctions)
{
    EXPECT_EQ(end_time(read_text("*PARAMETER_EXPRESSION\n"
                                 "Ra,int(2.7)+nint(2.7)+mod(7,4)+max(1,2)+min(1,2)+abs(-1)\n"
                                 "*CONTROL_TERMINATION\n&a\n")),
              2 + 3 + 3 + 2 + 1 + 1);
}

TEST(Parameters, ExpressionsStandInFieldsToo)
{
    EXPECT_EQ(end_time(read_text("*PARAMETER\nR       a       2.0\n*CONTROL_TERMINATION\n<&a*3-1>\n")), 5);
    EXPECT_EQ(end_time(read_text("*PARAMETER\nR       a       2.0\n*CONTROL_TERMINATION\n<max(a,3)>,0\n")),
              3);
}

TEST(Parameters, IntegersAreCutOff)
{
    EXPECT_EQ(end_time(read_text("*PARAMETER_EXPRESSION\nIn,7/2\n*CONTROL_TERMINATION\n&n\n")), 3);
}

TEST(Parameters, LocalOnesStayInTheirFile)
{
    const DeckFolder folder;
    folder.write("a.k", "*PARAMETER_LOCAL\nRx,1.\n*NODE\n1,&x,0.,0.\n");
    folder.write("b.k", "*NODE\n2,&x,0.,0.\n");
    const ReadResult result = read_model(folder.write("deck.k", "*INCLUDE\na.k\nb.k\n"));
    EXPECT_EQ(errors_of(result), "b.k:2: *NODE, field X: there is no parameter 'x'\n");
    EXPECT_EQ(result.model.nodes.position.at(0).x, 1);
}

TEST(Parameters, DuplicationFollowsItsFlag)
{
    const std::string twice = "*PARAMETER\nRt,1.\n*PARAMETER\nRt,2.\n*CONTROL_TERMINATION\n&t\n";
    const auto flag = [](int value) {
        return "*PARAMETER_DUPLICATION\n         " + std::to_string(value) + "\n";
    };
    EXPECT_EQ(end_time(read_text(twice)), 1);
    EXPECT_EQ(end_time(read_text(flag(1) + twice)), 1);
    EXPECT_EQ(end_time(read_text(flag(2) + twice)), 2);
    EXPECT_FALSE(read_text(flag(3) + twice).ok);
    EXPECT_EQ(end_time(read_text(flag(4) + twice)), 2);
    EXPECT_TRUE(read_text(flag(4) + twice).report.warnings.empty());
    EXPECT_EQ(end_time(read_text(flag(5) + twice)), 1);
}

TEST(Parameters, TheCommandLineWins)
{
    ReadOptions options;
    options.parameters = {{"tend", "7"}};
    EXPECT_EQ(
        end_time(read_text("*PARAMETER\nR    tend       2.5\n*CONTROL_TERMINATION\n     &tend\n", options)),
        7);
    options.parameters = {{"nowhere", "7"}};
    EXPECT_EQ(errors_of(read_text("*CONTROL_TERMINATION\n1.\n", options)),
              "--set nowhere: the deck defines no such parameter\n");
}

} // namespace plash

#include "output/recorders.h"
#include "tests/support/deck_run.h"

#include <bit>
#include <cstdint>
#include <fstream>

/// d3thdt of a run, read by the pages of LSTC, 'LS-DYNA Database' (2023) with none of the writer's code,
/// against d3plot of the same run, which VTK's reader checks (tests/readers).
namespace plash {

namespace {

using Words = std::vector<std::uint32_t>;

Words words_of(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Words words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), 4 * words.size());
    return words;
}

/// Names of control words by their disk addresses, alike in both databases.
enum Address {
    file_type = 11,
    node_count = 16,
    global_words = 18,
    solid_count = 23,
    solid_words = 27,
    beam_count = 28,
    beam_words = 30,
    shell_count = 31,
    shell_words = 33,
    extra_solid = 34,
    points_shown = 36,
    number_words = 39,
    thick_count = 40,
    thick_words = 42,
    node_blocks = 25,
    element_blocks = 26,
    solid_blocks = 60,
    beam_blocks = 61,
    shell_blocks = 62,
    thick_blocks = 63
};

/// The numbers from first to last of so many blocks.
std::vector<std::uint32_t> members(const Words& words, std::size_t& address, std::uint32_t blocks)
{
    std::vector<std::uint32_t> all;
    for (; blocks > 0; --blocks, address += 2)
        for (std::uint32_t n = words[address]; n <= words[address + 1]; ++n) all.push_back(n);
    return all;
}

/// Goes through a file word by word.
struct Cursor {
    const Words& words;
    std::size_t at = 0;

    std::uint32_t next() { return words[at++]; }
    float real() { return std::bit_cast<float>(next()); }
    void expect_same(Cursor& other, std::size_t count, const char* what)
    {
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(real(), other.real()) << what << ' ' << i;
    }
};

/// Islands of solids, thick shells, beams and shells with scattered numbers, struck at some nodes.
std::string islands()
{
    std::string nodes = "*NODE\n", strikes = "*INITIAL_VELOCITY_NODE\n", solids = "*ELEMENT_SOLID\n",
                thick = "*ELEMENT_TSHELL\n", shells = "*ELEMENT_SHELL\n", beams = "*ELEMENT_BEAM\n";
    const auto column = [&](int base, double height, int cells, std::string& elements, int part) {
        for (int k = 0; k <= cells; ++k) {
            for (int n = 0; n < 4; ++n) {
                nodes += fmt::format("{},{},{},{}\n", base + 4 * k + n, n == 1 || n == 2 ? 1.0 : 0.0,
                                     n > 1 ? 1.0 : 0.0, 10 * part + height * k);
            }
        }
        for (int k = 0; k < cells; ++k) {
            elements += fmt::format("{},{}", 900 - 7 * k - part, part);
            for (int n = 0; n < 8; ++n) elements += fmt::format(",{}", base + 4 * k + n);
            elements += '\n';
        }
        strikes += fmt::format("{},1.0,2.0,-20.0\n", base + 4 * cells + 1);
    };
    column(500, 1, 5, solids, 1);
    column(300, 0.3, 2, thick, 2);
    for (int i = 0; i <= 4; ++i) {
        for (int j = 0; j < 2; ++j) nodes += fmt::format("{},{},{},0\n", 100 - 2 * i - j, 1.0 * i, 1.0 * j);
        nodes += fmt::format("{},{},0.1,-5.0\n", 20 + i, 1.0 * i);
    }
    nodes += "30,0.0,9.0,-5.0\n";
    for (int i = 0; i < 4; ++i) {
        const int first = 100 - 2 * i;
        shells += fmt::format("{},3,{},{},{},{}\n", 40 + i, first, first - 2, first - 3, first - 1);
        beams += fmt::format("{},4,{},{},30\n", 60 - i, 20 + i, 21 + i);
    }
    strikes += "92,0.0,1.0,15.0\n22,1.0,0.0,15.0\n";
    return nodes + strikes + solids + thick + shells + beams;
}

std::string history_deck(const char* histories)
{
    return std::string("*KEYWORD\n*TITLE\nislands\n*CONTROL_TERMINATION\n2.0\n"
                       "*DATABASE_BINARY_D3PLOT\n0.5\n*DATABASE_BINARY_D3THDT\n0.5\n"
                       "*DATABASE_EXTENT_BINARY\n2,1,3,1\n0,0,4\n") +
           histories +
           "*PART\nblock\n1,1,1\n*PART\nthick\n2,2,1\n*PART\nsheet\n3,3,1\n*PART\nrod\n4,4,1\n"
           "*SECTION_SOLID\n1,1\n*SECTION_TSHELL\n2,1,0.833,3\n"
           "*SECTION_SHELL\n3,2,0.833,5\n0.1,0.1,0.1,0.1\n*SECTION_BEAM\n4,1,1.0,2\n0.2,0.2,0.2,0.2\n"
           "*MAT_PLASTIC_KINEMATIC\n1,1.0,1000.0,0.3,2.0,10.0,0.5\n" +
           islands() + "*END\n";
}

/// A deck run with its two databases.
struct Databases {
    testing::TemporaryFolder folder;
    Words control, states, plot_control, plot_states;

    explicit Databases(const std::string& deck)
    {
        testing::DeckRun run(deck);
        Recorders recorders = make_recorders(run.read->model, folder.path().string(), {});
        EXPECT_EQ(plash::run(*run.scene, recorders).termination, Outcome::Termination::normal);
        control = words_of(folder / "d3thdt");
        states = words_of(folder / "d3thdt01");
        plot_control = words_of(folder / "d3plot");
        plot_states = words_of(folder / "d3plot01");
    }
};

} // namespace

TEST(HistoryDatabase, HoldsTheChosenNodesAndElementsOfEachState)
{
    const Databases files(history_deck("*DATABASE_HISTORY_NODE\n504,21,503,96\n*DATABASE_HISTORY_SOLID\n"
                                       "878,899,885\n*DATABASE_HISTORY_TSHELL\n891\n"
                                       "*DATABASE_HISTORY_BEAM\n57,60,59\n*DATABASE_HISTORY_SHELL\n41,43\n"));
    const Words& c = files.control;
    const Words& p = files.plot_control;
    EXPECT_EQ(c[file_type], 3u);
    for (Address same : {node_count, global_words, solid_count, solid_words, beam_count, beam_words,
                         shell_count, shell_words, extra_solid, number_words, thick_count, thick_words})
        EXPECT_EQ(c[same], p[same]) << same;
    EXPECT_EQ(c[solid_count], 5u);
    EXPECT_EQ(c[beam_words], 6u + 5 * 4);
    EXPECT_EQ(c[points_shown], 3u);
    EXPECT_EQ(c[node_blocks], 3u); // nodes 21, 96, and 503 with 504
    EXPECT_EQ(c[element_blocks], 2u + 2 + 2 + 1);
    EXPECT_EQ(c[element_blocks], c[solid_blocks] + c[beam_blocks] + c[shell_blocks] + c[thick_blocks]);

    std::size_t address = 64;
    const auto nodes = members(c, address, c[node_blocks]), solids = members(c, address, c[solid_blocks]),
               beams = members(c, address, c[beam_blocks]), shells = members(c, address, c[shell_blocks]),
               thick = members(c, address, c[thick_blocks]);
    // Geometry and numbers are d3plot's, word for word.
    const std::size_t mesh =
        3 * c[node_count] + 9 * c[solid_count] + 9 * c[thick_count] + 6 * c[beam_count] + 5 * c[shell_count];
    for (std::size_t i = 0; i < mesh + c[number_words]; ++i) ASSERT_EQ(c[address + i], p[64 + i]) << i;
    EXPECT_EQ(std::bit_cast<float>(c[address + mesh + c[number_words]]), -999999.0f);
    const auto number = [&](std::size_t before, std::uint32_t place) {
        return c[address + mesh + 16 + before + place - 1];
    };
    const std::size_t before_beams = c[node_count] + c[solid_count],
                      before_shells = before_beams + c[beam_count];
    EXPECT_EQ(number(0, nodes[0]), 21u);
    EXPECT_EQ(number(0, nodes[2]), 503u);
    ASSERT_EQ(solids.size(), 3u);
    EXPECT_EQ(number(c[node_count], solids[0]), 878u);
    EXPECT_EQ(number(before_beams, beams[0]), 57u);
    EXPECT_EQ(number(before_shells, shells[1]), 43u);
    EXPECT_EQ(number(before_shells + c[shell_count], thick[0]), 891u);

    Cursor own{files.states}, plot{files.plot_states};
    const std::size_t solids_at = c[global_words] + 9 * c[node_count],
                      thick_at = solids_at + c[solid_words] * c[solid_count],
                      beams_at = thick_at + c[thick_words] * c[thick_count],
                      shells_at = beams_at + c[beam_words] * c[beam_count],
                      plot_length = shells_at + c[shell_words] * c[shell_count] + c[solid_count] +
                                    c[thick_count] + c[beam_count] + c[shell_count];
    int state_count = 0;
    for (; files.states[own.at] != std::bit_cast<std::uint32_t>(-999999.0f); ++state_count) {
        const float time = plot.real();
        const std::size_t start = plot.at;
        const auto plotted = [&](std::size_t place) { return Cursor{files.plot_states, start + place}; };
        const auto component = [&](int kind, std::uint32_t node) {
            return plotted(c[global_words] + 3 * (kind * c[node_count] + node - 1));
        };
        EXPECT_EQ(own.real(), time);
        own.expect_same(plot, c[global_words], "globals");
        EXPECT_EQ(own.real(), time);
        for (std::uint32_t node : nodes) {
            for (int kind = 0; kind < 3; ++kind) {
                Cursor wanted = component(kind, node);
                own.expect_same(wanted, 3, "node");
            }
        }
        const auto corners = [&](const std::vector<std::uint32_t>& elements, std::size_t table, int width,
                                 int count) {
            EXPECT_EQ(own.real(), time);
            for (std::uint32_t element : elements) {
                std::vector<std::uint32_t> their;
                for (int n = 0; n < count; ++n) {
                    their.push_back(own.next());
                    ASSERT_EQ(their.back(), c[address + table + width * (element - 1) + n]);
                }
                for (int kind = 0; kind < 2; ++kind) {
                    for (std::uint32_t node : their) {
                        Cursor wanted = component(kind, node);
                        own.expect_same(wanted, 3, "corner");
                    }
                }
            }
        };
        const std::size_t table = 3 * c[node_count];
        corners(solids, table, 9, 8);
        corners(thick, table + 9 * c[solid_count], 9, 8);
        corners(shells, table + 9 * (c[solid_count] + c[thick_count]) + 6 * c[beam_count], 5, 4);
        const auto values = [&](const std::vector<std::uint32_t>& elements, std::size_t place,
                                std::size_t length, const char* what) {
            EXPECT_EQ(own.real(), time);
            double largest = 0;
            for (std::uint32_t element : elements) {
                Cursor wanted = plotted(place + length * (element - 1));
                for (std::size_t i = 0; i < length; ++i) {
                    const float value = own.real();
                    ASSERT_EQ(value, wanted.real()) << what << ' ' << element << ", word " << i;
                    largest = std::max<double>(largest, std::abs(value));
                }
            }
            if (state_count > 0) {
                EXPECT_GT(largest, 0.01) << what;
            }
        };
        values(solids, solids_at, c[solid_words], "solid");
        values(thick, thick_at, c[thick_words], "thick shell");
        values(beams, beams_at, c[beam_words], "beam");
        values(shells, shells_at, c[shell_words], "shell");
        plot.at = start + plot_length;
    }
    EXPECT_EQ(state_count, 5);
}

TEST(HistoryDatabase, HoldsTheGlobalsWhereNothingIsChosen)
{
    const Databases files(history_deck(""));
    EXPECT_EQ(files.control[node_blocks], 0u);
    EXPECT_EQ(files.control[element_blocks], 0u);
    const std::size_t length = 1 + files.control[global_words];
    for (int state = 0; state < 5; ++state)
        EXPECT_NEAR(std::bit_cast<float>(files.states[state * length]), 0.5 * state, 0.06);
    EXPECT_EQ(std::bit_cast<float>(files.states[5 * length]), -999999.0f);
}

} // namespace plash

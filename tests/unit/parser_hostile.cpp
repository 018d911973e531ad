// Decks that no one should have written: a clear message, no fault, no endless loop, bounded memory.

#include "tests/unit/parser_support.h"

#include <algorithm>
#include <sys/stat.h>

namespace plash {
namespace {

/// The only error of a deck that cannot be read at all, without the folder in it.
std::string refusal(const DeckFolder& folder, const std::string& path)
{
    const ReadResult result = read_model(path);
    EXPECT_FALSE(result.ok);
    if (result.report.errors.size() != 1) return errors_of(result);
    std::string text = result.report.errors.front().text;
    if (const auto at = text.find(folder.path()); at != std::string::npos)
        text.erase(at, folder.path().size());
    return text;
}

std::string repeated(const std::string& text, int times)
{
    std::string result;
    result.reserve(text.size() * times);
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

constexpr int million = 1'000'000;

} // namespace

TEST(HostileFiles, MissingDirectoryEmptyBinary)
{
    const DeckFolder folder;
    EXPECT_EQ(refusal(folder, folder.path("none.k")), "there is no file 'none.k'");
    EXPECT_EQ(refusal(folder, folder.path("")), "'' is a directory, not a deck");
    EXPECT_EQ(refusal(folder, folder.write("empty.k", "")), "the file is empty");
    EXPECT_EQ(refusal(folder, folder.write("binary.k", std::string("\x7f"
                                                                   "ELF\0\1",
                                                                   6))),
              "'binary.k' is a binary file, not a keyword deck");
    EXPECT_EQ(refusal(folder, folder.write("prose.k", "Dear reader,\nthis is a letter.\n")),
              "no keyword (a line starting with *) found: this is not a keyword deck");
}

TEST(HostileFiles, Unreadable)
{
    const DeckFolder folder;
    const std::string path = folder.write("secret.k", "*KEYWORD\n");
    ::chmod(path.c_str(), 0);
    if (::access(path.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
    EXPECT_EQ(refusal(folder, path), "cannot open 'secret.k': Permission denied");
}

TEST(HostileFiles, ThreeGigabytesThatWereNeverWritten)
{
    const DeckFolder folder;
    const std::string path = folder.write("huge.k", repeated("*NODE\n1,0.,0.,0.\n", 1000));
    std::filesystem::resize_file(path, 3'000'000'000); // a hole: takes no room on the disk
    EXPECT_EQ(refusal(folder, path), "'huge.k' ends in zero bytes: it was not written to its end");
}

TEST(HostileFiles, ADeviceIsNoInclude)
{
    const ReadResult result = read_text("*INCLUDE\n/dev/zero\n*CONTROL_TERMINATION\n1.\n");
    EXPECT_EQ(errors_of(result), "deck.k:2: *INCLUDE, field FILENAME: '/dev/zero' is not a regular file\n");
}

TEST(HostileFiles, TruncatedInsideACard)
{
    const ReadResult result =
        read_text("*NODE\n1,0.,0.,0.\n*ELEMENT_SOLID\n       1       1\n       1       1   ");
    EXPECT_EQ(result.report.errors.size(), 1u);
    EXPECT_EQ(errors_of(result),
              "deck.k:4: *ELEMENT_SOLID, field PID: element 1 is of part 1, which is not defined\n");
}

TEST(HostileFiles, AnIncludeThatIncludesTheDeck)
{
    const DeckFolder folder;
    folder.write("a.k", "*INCLUDE\nb.k\n");
    folder.write("b.k", "*INCLUDE\na.k\n");
    EXPECT_EQ(errors_of(read_model(folder.path("a.k"))),
              "b.k:2: *INCLUDE, field FILENAME: 'a.k' includes itself\n");
}

TEST(HostileLines, AMillionCharactersInEveryPlace)
{
    const std::string digits(million, '1'), commas(million, ','), letters(million, 'X'), under(million, '_');
    for (const std::string& line : {digits, commas, letters, under, "*" + letters, "*" + under, "&" + letters,
                                    "<" + letters, std::string(million, '('), std::string(million, ' ')}) {
        for (const char* keyword :
             {"*NODE", "*TITLE", "*PARAMETER", "*PARAMETER_EXPRESSION", "*INCLUDE", "*ELEMENT_SHELL",
              "*DEFINE_CURVE", "*SET_NODE_LIST", "*MAT_ELASTIC", "*PART"}) {
            const ReadResult result =
                read_text(std::string(keyword) + "\n" + line + "\n*CONTROL_TERMINATION\n1.\n");
            for (const Message& message : result.report.errors) {
                EXPECT_LT(message.text.size(), 2000u) << keyword;
                EXPECT_LT(message.keyword.size(), 500u) << keyword;
            }
            EXPECT_EQ(result.model.controls.time.end_time, 1) << keyword; // the rest of the deck is read
        }
    }
}

TEST(HostileLines, VeryManyOfThem)
{
    constexpr int many = 100'000;
    // Work that grows with the square of these would not end in the time that a test has.
    const std::string blanks = repeated("\n", many), comments = repeated("$\n", many);
    for (const std::string& lines : {blanks, comments}) {
        for (const char* keyword :
             {"*NODE", "*DEFINE_CURVE", "*SET_NODE_LIST", "*CONTROL_TIMESTEP", "*MAT_ELASTIC",
              "*ELEMENT_SHELL_COMPOSITE", "*INITIAL_STRESS_SHELL", "*PARAMETER"}) {
            const ReadResult result = read_text(std::string(keyword) + "\n" + lines + "         1\n" + lines +
                                                "*CONTROL_TERMINATION\n1.\n");
            EXPECT_EQ(result.model.controls.time.end_time, 1) << keyword;
        }
    }
    const ReadResult keywords = read_text(repeated("*NODE\n", many) + "1,0.,0.,0.\n");
    EXPECT_EQ(keywords.model.nodes.size(), 1u);
}

TEST(HostileDecks, SetsDeepInsideOneAnother)
{
    std::string text = "*NODE\n1,0.,0.,0.\n";
    constexpr int sets = 100'000;
    for (int i = 1; i < sets; ++i)
        text += "*SET_NODE_ADD\n" + std::to_string(i) + "\n" + std::to_string(i + 1) + "\n";
    text += "*SET_NODE_LIST\n" + std::to_string(sets) + "\n1\n";
    const ReadResult result = read_text(text);
    ASSERT_FALSE(result.ok);
    EXPECT_EQ(result.report.errors.front().text, "set 1001 lies more than 1000 sets deep in other sets");
}

TEST(HostileDecks, MessagesShowControlCharactersAndStaySmall)
{
    const ReadResult result = read_text(std::string("*CONTROL_TERMINATION\n\x1b[31m.\n"));
    EXPECT_EQ(errors_of(result),
              "deck.k:2: *CONTROL_TERMINATION, field ENDTIM: '\\x1b[31m.' is not a number\n");
}

TEST(HostileDecks, NumbersThatNoWholeNumberHolds)
{
    const ReadResult result =
        read_text("*CONTROL_TERMINATION\n1.,1e300\n*SET_NODE_LIST\n1e99\n*NODE\n1e30,0.,0.,0.\n");
    EXPECT_EQ(errors_of(result),
              "deck.k:6: *NODE, field NID: '1e30' is too large for a whole number\n"
              "deck.k:4: *SET_NODE_LIST, field SID: '1e99' is too large for a whole number\n"
              "deck.k:4: *SET_NODE_LIST: the node set needs a number\n"
              "deck.k:2: *CONTROL_TERMINATION, field ENDCYC: '1e300' is too large for a whole number\n");
}

} // namespace plash

// Every wrong deck in tests/decks/bad gives exactly the messages that stand in the .txt file beside it.

#include "parser/read_model.h"
#include "tests/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace plash {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(PLASH_SOURCE_DIR) / "tests/decks/bad";

std::vector<std::string> bad_decks()
{
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".k") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string expected_messages(const std::string& name)
{
    std::ifstream file(folder / (name + ".txt"));
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// As `plash check` lists them, with the folder of the deck left out.
std::string messages(const std::string& name)
{
    const ReadResult result = read_model((folder / (name + ".k")).string());
    std::string text;
    const auto add = [&](const std::vector<Message>& list) {
        for (const Message& message : list) {
            std::string line = to_text(message, result.model);
            for (auto at = line.find(folder.string()); at != std::string::npos;
                 at = line.find(folder.string()))
                line.erase(at, folder.string().size() + 1);
            text += line + "\n";
        }
    };
    add(result.report.errors);
    add(unsupported_keywords(result.report));
    return text;
}

class BadDeck : public ::testing::TestWithParam<std::string> {};

} // namespace

TEST_P(BadDeck, GivesItsMessages)
{
    const std::string expected = expected_messages(GetParam());
    ASSERT_FALSE(expected.empty()) << "no " << GetParam() << ".txt beside the deck";
    EXPECT_EQ(messages(GetParam()), expected);
}

INSTANTIATE_TEST_SUITE_P(Deck, BadDeck, ::testing::ValuesIn(bad_decks()),
                         [](const ::testing::TestParamInfo<std::string>& info) { return info.param; });

} // namespace plash

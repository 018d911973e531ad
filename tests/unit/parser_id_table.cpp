#include "parser/id_table.h"

#include <gtest/gtest.h>

#include <map>

namespace plash {
namespace {

/// Against a map: the first of equal numbers counts, the others are told.
void expect_like_a_map(const std::vector<Id>& ids)
{
    IdTable table;
    std::map<Id, Index> wanted;
    std::vector<Index> repeated;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!wanted.emplace(ids[i], static_cast<Index>(i)).second) repeated.push_back(static_cast<Index>(i));
    EXPECT_EQ(table.build(ids), repeated);
    for (const auto& [id, index] : wanted) {
        EXPECT_EQ(table.find(id), index);
        for (const Id near : {id - 1, id + 1})
            if (!wanted.contains(near)) {
                EXPECT_EQ(table.find(near), none);
            }
    }
}

} // namespace

TEST(IdTable, NumbersCloseTogetherOrScattered)
{
    std::vector<Id> close, scattered;
    std::uint64_t random = 7;
    for (int i = 0; i < 20'000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        close.push_back(500 + static_cast<Id>(random >> 33) % 30'000);
        scattered.push_back(static_cast<Id>(random >> 20) % 9'000'000'000'000 - 4'000'000'000);
    }
    scattered.push_back(scattered.front());
    expect_like_a_map({});
    expect_like_a_map({5});
    expect_like_a_map(close);
    expect_like_a_map(scattered);
}

TEST(IdTable, GrowsOneByOneAndKnowsNumbersWithoutAPosition)
{
    IdTable table;
    for (Id id = 0; id < 1000; ++id) EXPECT_TRUE(table.add(id * id, static_cast<Index>(id)));
    EXPECT_FALSE(table.add(81, 5));
    EXPECT_EQ(table.find(81), 9);
    EXPECT_EQ(table.find(82), none);
    EXPECT_TRUE(table.add(82, none));
    EXPECT_EQ(table.find(82), none);
    EXPECT_TRUE(table.contains(82));
    EXPECT_FALSE(table.contains(83));
}

} // namespace plash

#include "tests/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

namespace plash {

namespace {

namespace fs = std::filesystem;

/// Height of each folder by the table in docs/architecture.md; higher floors have larger numbers.
std::map<std::string, int> read_floors()
{
    std::ifstream page(fs::path(PLASH_SOURCE_DIR) / "docs/architecture.md");
    std::map<std::string, int> height;
    std::string line;
    bool inside = false;
    int row = 0;
    while (std::getline(page, line)) {
        if (line.starts_with("<!-- end of floors")) break;
        if (line.starts_with("<!-- floors")) inside = true;
        if (!inside || !line.starts_with("| ") || line.starts_with("| floor")) continue;
        std::istringstream names(line.substr(2, line.find('|', 2) - 2));
        std::string name;
        --row;
        while (names >> name) height[name.substr(0, name.find(','))] = row;
    }
    return height;
}

struct Include {
    std::string from, to;
    int line;
};

std::vector<Include> read_includes(const std::map<std::string, int>& floors)
{
    std::vector<Include> includes;
    const std::regex quoted("^\\s*#\\s*include\\s*\"([^\"]+)\"");
    for (const auto& [folder, height] : floors) {
        const fs::path root = fs::path(PLASH_SOURCE_DIR) / folder;
        if (!fs::exists(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const auto extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream file(entry.path());
            std::string text;
            std::smatch match;
            for (int line = 1; std::getline(file, text); ++line) {
                if (!std::regex_search(text, match, quoted)) continue;
                includes.push_back({fs::relative(entry.path(), PLASH_SOURCE_DIR).string(), match[1], line});
            }
        }
    }
    return includes;
}

std::string folder_of(const std::string& path)
{
    return path.substr(0, path.find('/'));
}

} // namespace

TEST(Floors, NoIncludeRunsUpOrSideways)
{
    const auto floors = read_floors();
    ASSERT_GE(floors.size(), 10u) << "docs/architecture.md has lost its table of floors";
    const auto includes = read_includes(floors);
    ASSERT_GT(includes.size(), 50u);
    for (const Include& include : includes) {
        const std::string from = folder_of(include.from), to = folder_of(include.to);
        ASSERT_TRUE(floors.contains(to))
            << include.from << ":" << include.line << " includes \"" << include.to
            << "\", which is not written from the root of the tree, or is on no floor";
        EXPECT_TRUE(from == to || floors.at(to) < floors.at(from))
            << include.from << ":" << include.line << " includes \"" << include.to << "\": " << from
            << " may only include floors below its own";
    }
}

TEST(Floors, NoCircleOfIncludes)
{
    std::map<std::string, std::vector<std::string>> arrows;
    for (const Include& include : read_includes(read_floors())) arrows[include.from].push_back(include.to);
    std::map<std::string, int> visited; // 1: on the way, 2: done
    std::vector<std::string> path;
    const auto walk = [&](auto&& self, const std::string& file) -> void {
        visited[file] = 1;
        path.push_back(file);
        for (const std::string& next : arrows[file]) {
            if (visited[next] == 1) {
                std::string circle;
                for (const std::string& step : path) circle += step + " -> ";
                FAIL() << "circle of includes: " << circle << next;
            }
            if (visited[next] == 0) self(self, next);
        }
        path.pop_back();
        visited[file] = 2;
    };
    std::vector<std::string> files;
    for (const auto& [file, to] : arrows) files.push_back(file);
    for (const std::string& file : files) {
        if (visited[file] == 0) walk(walk, file);
    }
}

TEST(Floors, NoFileIsTooLong)
{
    for (const auto& [folder, height] : read_floors()) {
        const fs::path root = fs::path(PLASH_SOURCE_DIR) / folder;
        if (!fs::exists(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const auto extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream file(entry.path());
            const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
            EXPECT_LE(lines, 600) << entry.path() << " wants a wall";
        }
    }
}

} // namespace plash

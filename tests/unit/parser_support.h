#pragma once

#include "parser/read_model.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace plash {

/// A folder of its own for the files of one test, gone at its end.
class DeckFolder {
public:
    /// Writes a file, with folders in its name as needed; returns its path.
    std::string write(const std::string& name, const std::string& text) const
    {
        const std::filesystem::path file = folder_.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file.string();
    }

    std::string path(const std::string& name = "") const { return folder_ / name; }

private:
    testing::TemporaryFolder folder_;
};

/// Reads a deck given as text.
inline ReadResult read_text(const std::string& text, const ReadOptions& options = {})
{
    const DeckFolder folder;
    return read_model(folder.write("deck.k", text), options);
}

/// All errors as lines without the folder of the deck.
inline std::string errors_of(const ReadResult& result)
{
    std::string text;
    for (const Message& message : result.report.errors) {
        std::string line = to_text(message, result.model);
        if (message.where.file != none) {
            const std::string& file = result.model.files[message.where.file];
            line = std::filesystem::path(file).filename().string() + line.substr(file.size());
        }
        text += line + "\n";
    }
    return text;
}

/// Numbers of nodes as the deck gives them.
inline std::vector<Id> ids(const Model& model, const std::vector<Index>& nodes)
{
    std::vector<Id> result;
    for (Index node : nodes) result.push_back(model.nodes.id[node]);
    return result;
}

} // namespace plash

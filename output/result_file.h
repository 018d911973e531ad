#pragma once

#include "core/archive.h"

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace plash {

/// Where a result goes, and whether files that are there go on (restart) or begin anew.
struct ResultPath {
    std::string path;
    bool resume = false;

    ResultPath(std::string text, bool its_resume = false) : path(std::move(text)), resume(its_resume) {}
    ResultPath(const char* text) : path(text) {}
};

/// A result file that grows state by state. Every fault (no such directory, disk full) throws a RunError that
/// names the file.
class ResultFile {
public:
    /// Creates the file or empties the one that is there. With `resume` a file that is there is left alone,
    /// and what is written is dropped, until `serialise` has loaded where it goes on.
    explicit ResultFile(const ResultPath& path);

    void write(std::string_view bytes);
    /// Hands everything to the system, so that what was written survives the end of the process.
    void flush();

    /// Replaces bytes within what is there; handed to the system at once.
    void overwrite(std::uint64_t offset, std::string_view bytes);
    /// What has been written so far [byte].
    std::uint64_t length();

    /// Saves the length of the file, or cuts the file to the loaded length and goes on there; a file that has
    /// gone begins anew.
    void serialise(Archive& archive);

    const std::string& path() const { return path_; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_; ///< null while it waits to be resumed

    [[noreturn]] void fail(std::string_view what) const;
};

/// Replaces the file at `path` in one move by what `fill` writes, so that a reader finds the old or the new
/// content and never a part. Throws RunError.
void replace_file(const std::string& path, const std::function<void(ResultFile&)>& fill);
void replace_file(const std::string& path, std::string_view content);

} // namespace plash

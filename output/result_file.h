#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace plash {

/// A result file that grows state by state. Every fault (no such directory, disk full) throws a RunError that
/// names the file.
class ResultFile {
public:
    /// Creates the file or empties the one that is there.
    explicit ResultFile(std::string path);

    void write(std::string_view bytes);
    /// Hands everything to the system, so that what was written survives the end of the process.
    void flush();

    const std::string& path() const { return path_; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;

    [[noreturn]] void fail(std::string_view what) const;
};

/// Replaces the file at `path` in one move by what `fill` writes, so that a reader finds the old or the new
/// content and never a part. Throws RunError.
void replace_file(const std::string& path, const std::function<void(ResultFile&)>& fill);
void replace_file(const std::string& path, std::string_view content);

} // namespace plash

#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace plash {

/// What a run says to people: on the terminal and, from when the results' directory is known, in its file
/// messag (earlier lines too). A run that goes on from a restart file adds to the file that is there.
class RunLog {
public:
    /// A line for the terminal's output, or for its errors.
    void say(const std::string& line);
    void warn(const std::string& line);

    void open(const std::string& directory, bool resume);

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string kept_; ///< lines before there is a file
    std::unique_ptr<std::FILE, Close> file_;

    void keep(const std::string& line);
};

} // namespace plash

#include "app/run_log.h"

#include "core/run_error.h"

#include <fmt/format.h>

namespace plash {

void RunLog::say(const std::string& line)
{
    fmt::print("{}\n", line);
    keep(line);
}

void RunLog::warn(const std::string& line)
{
    fmt::print(stderr, "{}\n", line);
    keep(line);
}

void RunLog::keep(const std::string& line)
{
    if (!file_) {
        kept_ += line + "\n";
        return;
    }
    std::fputs((line + "\n").c_str(), file_.get());
    std::fflush(file_.get());
}

void RunLog::open(const std::string& directory, bool resume)
{
    const std::string path = directory + "/messag";
    file_.reset(std::fopen(path.c_str(), resume ? "ab" : "wb"));
    if (!file_) throw RunError(fmt::format("result file {} cannot be created", path));
    std::fputs(kept_.c_str(), file_.get());
    std::fflush(file_.get());
    kept_.clear();
}

} // namespace plash

#include "output/result_file.h"

#include "core/run_error.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace plash {

ResultFile::ResultFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb"))
{
    if (!file_) fail("cannot be created");
}

void ResultFile::write(std::string_view bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail("cannot be written");
}

void ResultFile::flush()
{
    if (std::fflush(file_.get()) != 0) fail("cannot be written");
}

void ResultFile::fail(std::string_view what) const
{
    throw RunError(fmt::format("result file {} {}: {}", path_, what, std::strerror(errno)));
}

void replace_file(const std::string& path, std::string_view content)
{
    replace_file(path, [&](ResultFile& file) { file.write(content); });
}

void replace_file(const std::string& path, const std::function<void(ResultFile&)>& fill)
{
    const std::string next = path + ".new";
    {
        ResultFile file(next);
        fill(file);
        file.flush();
    }
    if (std::rename(next.c_str(), path.c_str()) != 0) {
        throw RunError(fmt::format("result file {} cannot be replaced: {}", path, std::strerror(errno)));
    }
}

} // namespace plash

#include "output/result_file.h"

#include "core/run_error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace plash {

ResultFile::ResultFile(const ResultPath& path) : path_(path.path)
{
    if (path.resume && std::filesystem::exists(path_)) return;
    file_.reset(std::fopen(path_.c_str(), "wb"));
    if (!file_) fail("cannot be created");
}

void ResultFile::write(std::string_view bytes)
{
    if (!file_) return;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail("cannot be written");
}

void ResultFile::flush()
{
    if (!file_) return;
    if (std::fflush(file_.get()) != 0) fail("cannot be written");
}

void ResultFile::overwrite(std::uint64_t offset, std::string_view bytes)
{
    if (!file_) return;
    if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0) fail("cannot be written");
    write(bytes);
    flush();
    if (fseeko(file_.get(), 0, SEEK_END) != 0) fail("cannot be written");
}

std::uint64_t ResultFile::length()
{
    return file_ ? static_cast<std::uint64_t>(ftello(file_.get())) : 0;
}

void ResultFile::serialise(Archive& archive)
{
    flush();
    std::uint64_t length = file_ ? static_cast<std::uint64_t>(ftello(file_.get())) : 0;
    archive(length);
    if (!archive.loading() || file_) return;
    file_.reset(std::fopen(path_.c_str(), "r+b"));
    if (!file_) fail("cannot be continued");
    if (std::filesystem::file_size(path_) < length) {
        throw RunError(
            fmt::format("result file {} is shorter than when the restart file was written", path_));
    }
    std::filesystem::resize_file(path_, length);
    if (fseeko(file_.get(), 0, SEEK_END) != 0) fail("cannot be continued");
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
        ResultFile file{ResultPath(next)};
        fill(file);
        file.flush();
    }
    if (std::rename(next.c_str(), path.c_str()) != 0) {
        throw RunError(fmt::format("result file {} cannot be replaced: {}", path, std::strerror(errno)));
    }
}

} // namespace plash

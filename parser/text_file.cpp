#include "parser/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace plash {
namespace {

/// Closes the descriptor when the constructor leaves, also by an exception.
struct Descriptor {
    int number;
    ~Descriptor() { ::close(number); }
};

/// Pipes and devices are read to their end, but not without bound.
constexpr std::size_t largest_stream = std::size_t{4} << 30;

std::string read_stream(int descriptor, const std::string& path)
{
    std::string text;
    char buffer[1 << 16];
    for (;;) {
        const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
        if (count < 0) throw FileError(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
        if (count == 0) return text;
        if (text.size() > largest_stream) throw FileError(fmt::format("'{}' does not end", path));
        text.append(buffer, count);
    }
}

} // namespace

TextFile::TextFile(const std::string& path)
{
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) {
        if (errno == ENOENT) throw FileError(fmt::format("there is no file '{}'", path));
        throw FileError(fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
    }
    struct stat status {};
    if (::fstat(file.number, &status) != 0)
        throw FileError(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
    if (S_ISDIR(status.st_mode)) throw FileError(fmt::format("'{}' is a directory, not a deck", path));
    if (!S_ISREG(status.st_mode)) {
        copy_ = read_stream(file.number, path);
        text_ = copy_;
    } else if (status.st_size > 0) {
        void* address = ::mmap(nullptr, status.st_size, PROT_READ, MAP_PRIVATE, file.number, 0);
        if (address == MAP_FAILED)
            throw FileError(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
        ::madvise(address, status.st_size, MADV_SEQUENTIAL);
        mapping_ = address;
        text_ = std::string_view(static_cast<const char*>(address), status.st_size);
    }
    // Text never holds a zero byte; every binary result file of this field holds one at its start.
    const std::string_view start = text_.substr(0, 4096);
    if (start.find('\0') != std::string_view::npos) {
        if (mapping_) ::munmap(mapping_, text_.size());
        throw FileError(fmt::format("'{}' is a binary file, not a keyword deck", path));
    }
}

void TextFile::release(std::string_view part) const
{
    constexpr std::uintptr_t page = 4096, worth_it = 1 << 20;
    if (!mapping_ || part.size() < worth_it) return;
    const auto begin = (reinterpret_cast<std::uintptr_t>(part.data()) + page - 1) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(part.data() + part.size()) / page * page;
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

TextFile::~TextFile()
{
    if (mapping_) ::munmap(mapping_, text_.size());
}

} // namespace plash

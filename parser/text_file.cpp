#include "parser/text_file.h"

#include <fmt/format.h>

#include <algorithm>
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

/// Text never holds a zero byte; every binary result file of this field holds one at its start.
void refuse_binary(std::string_view text, const std::string& path)
{
    if (text.substr(0, 4096).find('\0') != std::string_view::npos)
        throw FileError(fmt::format("'{}' is a binary file, not a keyword deck", path));
    // A disk that ran full leaves a file of the right length.
    if (text.size() > 4096 && text.substr(text.size() - 4096).find('\0') != std::string_view::npos)
        throw FileError(fmt::format("'{}' ends in zero bytes: it was not written to its end", path));
}

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
        refuse_binary(text, path); // at once: a device may never end
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
    try {
        refuse_binary(text_, path);
    } catch (const FileError&) {
        if (mapping_) ::munmap(mapping_, text_.size());
        throw;
    }
}

TextFile::TextFile(const std::string& path, std::string_view text) : text_(text)
{
    refuse_binary(text, path);
}

long count_lines(std::string_view text)
{
    // In bytes, as many lanes as fit: one byte cannot overflow within 255 rounds.
    constexpr std::size_t lanes = 64, rounds = 255;
    long count = 0;
    const char* at = text.data();
    std::size_t left = text.size();
    while (left >= lanes) {
        std::uint8_t found[lanes]{};
        const std::size_t steps = std::min(left / lanes, rounds);
        for (std::size_t step = 0; step < steps; ++step, at += lanes)
            for (std::size_t lane = 0; lane < lanes; ++lane) found[lane] += at[lane] == '\n';
        for (const std::uint8_t lane : found) count += lane;
        left -= steps * lanes;
    }
    return count + std::count(at, at + left, '\n');
}

const char* find_line(std::string_view part, std::string_view start, const char* begin)
{
    for (std::size_t from = 0; from < part.size();) {
        const void* found = ::memmem(part.data() + from, part.size() - from, start.data(), start.size());
        if (!found) return nullptr;
        const char* at = static_cast<const char*>(found);
        if (at == begin || at[-1] == '\n') return at;
        from = at - part.data() + 1;
    }
    return nullptr;
}

const char* end_of_data(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t begin = text.find_last_of('\n', text.size() - 1);
        const std::size_t first = begin == std::string_view::npos ? 0 : begin + 1;
        const std::string_view line = text.substr(first);
        if (!line.empty() && line.front() != '$' && line.find_first_not_of(" \t\r") != std::string_view::npos)
            return line.data() + line.size();
        if (begin == std::string_view::npos) break;
        text = text.substr(0, begin);
    }
    return text.data();
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

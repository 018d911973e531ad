#include "core/archive.h"

#include "core/run_error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace plash {

namespace {

/// First bytes of every restart file; the version of the program stands in it, because the arrays of one
/// version mean nothing to another.
std::string signature()
{
    return fmt::format("Plash restart file, version {}, words of {} bytes\n", PLASH_VERSION, sizeof(void*));
}

/// Mixes eight bytes at a time into a checksum (the steps of a 64-bit multiply-and-fold hash): every bit
/// changes about half of the sum, which is all that finding damage needs.
std::uint64_t mixed(std::uint64_t sum, const unsigned char* data, std::size_t count)
{
    constexpr std::uint64_t factor = 0x9E3779B97F4A7C15ULL;
    while (count > 0) {
        std::uint64_t word = 0;
        const std::size_t length = std::min(count, sizeof word);
        std::memcpy(&word, data, length);
        sum = (sum ^ word) * factor;
        sum ^= sum >> 29;
        data += length;
        count -= length;
    }
    return sum;
}

} // namespace

Archive::Archive(std::string path, Mode mode) : mode_(mode), path_(std::move(path))
{
    const std::string expected = signature();
    if (mode_ == Mode::save) {
        file_.reset(std::fopen((path_ + ".new").c_str(), "wb"));
        if (!file_) fail(std::strerror(errno));
        std::string text = expected;
        bytes(text.data(), text.size());
        return;
    }
    file_.reset(std::fopen(path_.c_str(), "rb"));
    if (!file_) fail(std::strerror(errno));
    left_ = std::filesystem::file_size(path_);
    if (left_ < expected.size() + sizeof checksum_) fail("it is no restart file");
    left_ -= sizeof checksum_;
    std::string found(expected.size(), ' ');
    bytes(found.data(), found.size());
    if (found == expected) return;
    const bool other_version = found.starts_with("Plash restart file");
    fail(other_version
             ? fmt::format("it begins with '{}' and not with '{}'", found.substr(0, found.find('\n')),
                           expected.substr(0, expected.size() - 1))
             : "it is no restart file");
}

void Archive::bytes(void* data, std::size_t count)
{
    if (count == 0) return;
    if (mode_ == Mode::save) {
        if (std::fwrite(data, 1, count, file_.get()) != count) fail(std::strerror(errno));
    } else {
        if (count > left_) fail("it ends too early");
        if (std::fread(data, 1, count, file_.get()) != count) fail("it cannot be read");
        left_ -= count;
    }
    checksum_ = mixed(checksum_, static_cast<const unsigned char*>(data), count);
}

std::size_t Archive::count_of(std::size_t count, std::size_t entry_bytes)
{
    std::uint64_t number = count;
    bytes(&number, sizeof number);
    if (loading() && number > left_ / entry_bytes) fail("it is damaged: a list is longer than the file");
    return number;
}

void Archive::item(std::vector<bool>& values)
{
    const std::size_t count = count_of(values.size(), 1);
    std::vector<char> copy(values.begin(), values.end());
    copy.resize(count);
    bytes(copy.data(), count);
    values.assign(copy.begin(), copy.end());
}

void Archive::item(std::string& text)
{
    const std::size_t count = count_of(text.size(), 1);
    text.resize(count);
    bytes(text.data(), count);
}

void Archive::section(std::string_view name)
{
    std::string found(name);
    item(found);
    if (found == name) return;
    fail(fmt::format("it goes on with '{}' where this deck has '{}'; the deck is another one, or has changed "
                     "in more than times and curves",
                     found.size() < 100 ? found : "?", name));
}

void Archive::checkpoint()
{
    const std::uint64_t sum = checksum_;
    std::uint64_t stored = sum;
    bytes(&stored, sizeof stored);
    if (stored != sum) fail("it is damaged: a checksum is wrong");
}

void Archive::close()
{
    std::uint64_t sum = checksum_;
    if (mode_ == Mode::load) {
        if (left_ != 0) fail(fmt::format("{} bytes of it belong to nothing in this deck", left_));
        if (std::fread(&sum, sizeof sum, 1, file_.get()) != 1) fail("it cannot be read");
        if (sum != checksum_) fail("it is damaged: its checksum is wrong");
        file_.reset();
        return;
    }
    std::FILE* file = file_.get();
    const bool written = std::fwrite(&sum, sizeof sum, 1, file) == 1 && std::fflush(file) == 0;
    if (!written || fsync(fileno(file)) != 0) fail(std::strerror(errno));
    file_.reset();
    if (std::rename((path_ + ".new").c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
}

void Archive::fail(std::string_view what) const
{
    throw RunError(fmt::format("restart file {} cannot be {}: {}", path_,
                               mode_ == Mode::save ? "written" : "used", what));
}

} // namespace plash

#include "output/d3plot_family.h"

#include "core/run_error.h"

#include <cassert>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr float end_marker = -999999.0f;
constexpr std::size_t block_words = 512;

} // namespace

D3plotFamily::D3plotFamily(const ResultPath& path, std::size_t words_per_file, bool one_state_per_file)
    : path_(path.path),
      words_per_file_(words_per_file),
      one_state_per_file_(one_state_per_file),
      resumed_(path.resume && std::filesystem::exists(path.path))
{
    if (resumed_) return;
    remove_after(0);
    open(0);
    write_end(0);
    flush();
}

std::string D3plotFamily::path_of(int number) const
{
    return number == 0 ? path_ : fmt::format("{}{:02}", path_, number);
}

void D3plotFamily::remove_after(int number) const
{
    do {
        ++number;
    } while (std::remove(path_of(number).c_str()) == 0);
}

void D3plotFamily::serialise(Archive& archive)
{
    int number = file_number_;
    std::size_t end = end_;
    archive(number, end);
    if (!archive.loading() || !resumed_) return;
    remove_after(number);
    file_number_ = number;
    end_ = end;
    if (number == 0) return; // its geometry stands, and no state yet
    file_path_ = path_of(number);
    file_.reset(std::fopen(file_path_.c_str(), "r+b"));
    if (!file_) fail("cannot be continued");
    if (std::filesystem::file_size(file_path_) < 4 * end) {
        throw RunError(
            fmt::format("result file {} is shorter than when the restart file was written", file_path_));
    }
    seek(end);
    write_end(end);
    flush();
    std::filesystem::resize_file(file_path_, 4 * (end / block_words + 1) * block_words);
}

void D3plotFamily::write_geometry(std::span<const std::uint32_t> words)
{
    if (resumed_) return;
    seek(0);
    write(words.data(), words.size());
    write_end(words.size());
    flush();
    file_.reset();
}

void D3plotFamily::begin_state(double time, std::size_t word_count)
{
    const std::size_t length = end_ + 1 + word_count;
    const bool room = !one_state_per_file_ && length + 1 <= words_per_file_;
    if (!file_ || !room) {
        open(file_number_ + 1);
        write_end(0);
        flush();
    }
    seek(end_ + 1);
    state_time_ = static_cast<float>(time);
    state_words_ = word_count;
    words_put_ = 0;
}

void D3plotFamily::end_state()
{
    drain();
    assert(words_put_ == state_words_);
    const std::size_t begin = end_;
    write_end(begin + 1 + state_words_);
    flush();
    seek(begin);
    write(&state_time_, 1);
    flush();
}

void D3plotFamily::open(int number)
{
    file_number_ = number;
    file_path_ = path_of(number);
    file_.reset(std::fopen(file_path_.c_str(), "wb"));
    if (!file_) fail("cannot be created");
}

void D3plotFamily::seek(std::size_t word)
{
    if (fseeko(file_.get(), static_cast<off_t>(word) * 4, SEEK_SET) != 0) fail("cannot be written");
}

void D3plotFamily::write(const void* words, std::size_t count)
{
    if (std::fwrite(words, 4, count, file_.get()) != count) fail("cannot be written");
}

void D3plotFamily::drain()
{
    write(buffer_.data(), buffer_.size());
    words_put_ += buffer_.size();
    buffer_.clear();
}

void D3plotFamily::write_end(std::size_t words_before)
{
    end_ = words_before;
    std::vector<float> block(block_words - words_before % block_words, 0.0f);
    block[0] = end_marker;
    write(block.data(), block.size());
}

void D3plotFamily::flush()
{
    if (std::fflush(file_.get()) != 0) fail("cannot be written");
}

void D3plotFamily::fail(const char* what) const
{
    throw RunError(fmt::format("result file {} {}: {}", file_path_, what, std::strerror(errno)));
}

} // namespace plash

#pragma once

#include "output/result_file.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plash {

/// The files of one d3plot database, d3plot, d3plot01, d3plot02 ...: the first holds the geometry, the others
/// whole states one after another. Words have four bytes. Files end with the marker -999999.0 and are padded
/// with zeros to multiples of 512 words, as LS-DYNA's are.
///
/// Whatever is on disk is readable at any moment: a state is written behind the marker that ends the file,
/// with its own marker after it, and only then does its time replace the old marker.
class D3plotFamily {
public:
    /// Largest file before the next one begins: 256 MiB in words.
    static constexpr std::size_t usual_words_per_file = std::size_t{64} << 20;

    /// `path` names the first file. With `resume` nothing is touched until `serialise` has loaded where the
    /// family goes on, unless its first file has gone. A file takes another state only while it stays within
    /// `words_per_file`, or when it is the first; `one_state_per_file` never puts two into one. Files that an
    /// earlier run left in the family are removed, because readers would take them for later states.
    D3plotFamily(const ResultPath& path, std::size_t words_per_file, bool one_state_per_file);

    /// Writes the first file: control words, geometry, numbers, titles.
    void write_geometry(std::span<const std::uint32_t> words);

    /// Starts a state of `word_count` words after its time; exactly as many must be `put`.
    void begin_state(double time, std::size_t word_count);
    void put(double value) { put_word(static_cast<float>(value)); }
    void put_integer(std::uint32_t value) { put_word(std::bit_cast<float>(value)); }
    void end_state();

    /// Saves how far the family has come, or cuts it to that: later states and files go.
    void serialise(Archive& archive);

private:
    static constexpr std::size_t buffer_length = 65536;

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::size_t words_per_file_;
    bool one_state_per_file_;
    bool resumed_ = false; ///< the first file of an earlier run stays
    int file_number_ = 0;
    std::string file_path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::size_t end_ = 0;         ///< word of the marker that ends the current file
    std::size_t state_words_ = 0; ///< of the state being written
    std::size_t words_put_ = 0;
    float state_time_ = 0;
    std::vector<float> buffer_;

    std::string path_of(int number) const;
    void put_word(float word)
    {
        buffer_.push_back(word);
        if (buffer_.size() == buffer_length) drain();
    }
    void open(int number);
    void remove_after(int number) const;
    void seek(std::size_t word);
    void write(const void* words, std::size_t count);
    void drain();
    /// The marker that ends the file at the present place, and zeros up to a whole block.
    void write_end(std::size_t words_before);
    void flush();
    [[noreturn]] void fail(const char* what) const;
};

} // namespace plash

#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace plash {

/// Why a file could not be read, as a sentence for people.
class FileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The text of a whole file, read-only for the life of this object. Regular files are mapped, so that a large
/// deck costs no memory of its own.
class TextFile {
public:
    /// Throws FileError when there is no such file, it is a directory, unreadable or not text.
    explicit TextFile(const std::string& path);
    /// Text that stands in memory already and outlives this object; `path` is for messages.
    TextFile(const std::string& path, std::string_view text);
    ~TextFile();
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;

    std::string_view text() const { return text_; }

    /// Tells the system that a part of the text will not be needed soon: its memory may go; reading it again
    /// costs a little time.
    void release(std::string_view part) const;

private:
    std::string_view text_;
    std::string copy_; ///< what was read, when the file could not be mapped (pipes)
    void* mapping_ = nullptr;
};

/// Number of line ends.
long count_lines(std::string_view text);

/// The first line that starts with a word in a part of some text; nullptr when there is none. The byte before
/// the part tells whether it starts with a line; `begin` is where the whole text begins.
const char* find_line(std::string_view part, std::string_view start, const char* begin);

/// Where the last line ends that is neither blank nor a `$` comment; the text's begin when there is none.
const char* end_of_data(std::string_view text);

/// Gives the memory of a text back while somebody reads through it from front to back.
class TextRelease {
public:
    TextRelease(const TextFile& file, std::string_view text) : file_(file), from_(text.data()) {}

    /// Everything before `at` is done with.
    void up_to(const char* at)
    {
        constexpr std::ptrdiff_t worth_it = 16 << 20;
        if (at - from_ < worth_it) return;
        file_.release({from_, static_cast<std::size_t>(at - from_)});
        from_ = at;
    }

private:
    const TextFile& file_;
    const char* from_;
};

/// Walks through text line by line: no copy, line ends LF or CRLF.
class LineCursor {
public:
    LineCursor(std::string_view text, int first_line)
        : at_(text.data()), end_(text.data() + text.size()), line_(first_line - 1)
    {}

    /// The next line, without its end; false after the last one.
    bool next(std::string_view& line)
    {
        if (at_ == end_) return false;
        const void* found = __builtin_memchr(at_, '\n', end_ - at_);
        const char* stop = found ? static_cast<const char*>(found) : end_;
        const char* last = stop > at_ && stop[-1] == '\r' ? stop - 1 : stop;
        line = std::string_view(at_, last - at_);
        at_ = found ? stop + 1 : end_;
        ++line_;
        return true;
    }

    /// The next line that is not a `$` comment.
    bool next_data(std::string_view& line)
    {
        while (next(line))
            if (line.empty() || line.front() != '$') return true;
        return false;
    }

    int line() const { return line_; }           ///< number of the line that next() gave last
    const char* position() const { return at_; } ///< start of the line that next() gives next

private:
    const char* at_;
    const char* end_;
    int line_;
};

} // namespace plash

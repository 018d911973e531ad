#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace plash {

/// Types whose bytes are their value. Whoever holds addresses (views, pointers) is none; a struct with a
/// pointer inside passes unnoticed and must write its own `serialise`.
template <class T>
inline constexpr bool is_plain =
    std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, std::string_view>;

/// A restart file that is being written or read: plain values and arrays, both ways by one function,
///
///     void serialise(Archive& archive) { archive(energy_, history_, touches_); }
///
/// A class puts in what it needs to go on with the same bits and cannot make anew from the Model and the
/// State. Files are for the machine and the program that wrote them. They are written beside their final name
/// and moved there whole, so that a file that is there is complete; a checksum at its end tells damage.
class Archive {
public:
    enum class Mode { save, load };

    /// RunError when the file cannot be created or is no restart file of this version.
    Archive(std::string path, Mode mode);

    bool loading() const { return mode_ == Mode::load; }

    /// Saves or loads each of `values`.
    template <class... T>
    void operator()(T&... values)
    {
        (item(values), ...);
    }

    /// Names what follows; loading checks that the same was written there.
    void section(std::string_view name);
    /// Checks that all so far is as it was written.
    void checkpoint();
    /// Ends the file: moves it to its place, or checks that all of it was read. RunError.
    void close();

    /// The file does not fit what is loaded from it.
    [[noreturn]] void fail(std::string_view what) const;

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    Mode mode_;
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t checksum_ = 0;
    std::uint64_t left_ = 0; ///< bytes of the file not yet read

    void bytes(void* data, std::size_t count);
    /// Number of entries of a list; when loading bounded by what the file can hold.
    std::size_t count_of(std::size_t count, std::size_t entry_bytes);

    template <class T>
    void item(T& value)
    {
        if constexpr (requires { value.serialise(*this); }) {
            value.serialise(*this);
        } else {
            static_assert(is_plain<T>, "give the type a serialise(Archive&)");
            bytes(&value, sizeof value);
        }
    }
    template <class T, class Allocator>
    void item(std::vector<T, Allocator>& values)
    {
        const std::size_t count = count_of(values.size(), is_plain<T> ? sizeof(T) : 1);
        if (loading()) values.resize(count);
        if constexpr (is_plain<T> && !requires(T & value) { value.serialise(*this); }) {
            bytes(values.data(), count * sizeof(T));
        } else {
            for (T& value : values) item(value);
        }
    }
    void item(std::vector<bool>& values);
    void item(std::string& text);
    template <class T, std::size_t size>
    void item(std::array<T, size>& values)
    {
        for (T& value : values) item(value);
    }
    template <class First, class Second>
    void item(std::pair<First, Second>& pair)
    {
        item(pair.first);
        item(pair.second);
    }
};

} // namespace plash

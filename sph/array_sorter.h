#pragma once

#include "core/parallel.h"
#include "core/release.h"
#include "model/record.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace plash {

/// Brings arrays into a new order: values[new place] = values[old place], with room for images behind, which
/// start from nothing. Arrays stay where they are in memory, for new ones would leave gaps between them.
class ArraySorter {
public:
    explicit ArraySorter(std::vector<Index> old_place) : old_place_(std::move(old_place)) {}

    /// width  values of a particle
    template <class Value>
    void operator()(std::vector<Value>& values, std::size_t images = 0, std::size_t width = 1)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        const std::size_t count = old_place_.size(), bytes = width * sizeof(Value);
        if (room_.size() < count * bytes) room_ = Bytes(count * bytes);
        const auto* from = reinterpret_cast<const std::byte*>(values.data());
        for_chunks(count, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) {
                std::memcpy(&room_[p * bytes], from + static_cast<std::size_t>(old_place_[p]) * bytes, bytes);
            }
        });
        const std::size_t size = (count + images) * width;
        if (values.capacity() < size) {
            release(values);
            values.reserve(size + images / 16); // images come and go
        }
        values.resize(size);
        for_chunks(count, [&](std::size_t begin, std::size_t end) {
            std::memcpy(values.data() + begin * width, &room_[begin * bytes], (end - begin) * bytes);
        });
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(count * width), values.end(), Value{});
    }

private:
    /// Memory that nobody has written to.
    class Bytes {
    public:
        Bytes() = default;
        explicit Bytes(std::size_t size) : bytes_(new std::byte[size]), size_(size) {}
        std::size_t size() const { return size_; }
        std::byte& operator[](std::size_t i) { return bytes_[i]; }

    private:
        std::unique_ptr<std::byte[]> bytes_;
        std::size_t size_ = 0;
    };

    std::vector<Index> old_place_;
    Bytes room_;
};

} // namespace plash

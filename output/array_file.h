#pragma once

#include "core/archive.h"
#include "model/record.h"

#include <span>
#include <string>
#include <string_view>

namespace plash {

/// A file of named arrays in folders, one folder a state: binout, or the HDF5 history.
class ArrayFile {
public:
    virtual ~ArrayFile() = default;

    /// Folder of what is put next, "/nodout/metadata" or "/nodout/d000001".
    virtual void folder(const std::string& path) = 0;
    virtual void put(std::string_view name, std::span<const double> values) = 0;
    virtual void put(std::string_view name, std::span<const Id> values) = 0;
    virtual void put(std::string_view name, std::string_view text) = 0;
    /// Makes what was put part of the file.
    virtual void commit() = 0;
    /// After the last state.
    virtual void close() {}
    virtual void serialise(Archive&) = 0;

    void put_number(std::string_view name, double value) { put(name, std::span(&value, 1)); }
    void put_whole(std::string_view name, Id value) { put(name, std::span(&value, 1)); }
};

} // namespace plash

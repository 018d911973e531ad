#pragma once

#include "output/cell_shape.h"

#include <cstring>
#include <string>
#include <vector>

namespace plash {

/// One unstructured grid in VTK's XML format (.vtu), arrays as raw bytes behind the XML.
class VtuFile {
public:
    std::vector<float> points; ///< three a point

    void add_cell(const Cell&);
    std::size_t cell_count() const { return types_.size(); }

    /// An array with a value of `components` entries a point or a cell. T: float, std::int32_t, std::int64_t,
    /// std::uint8_t.
    template <class T>
    void add_point_array(std::string name, int components, const std::vector<T>& values)
    {
        point_arrays_.push_back(make_array(std::move(name), components, values));
    }
    template <class T>
    void add_cell_array(std::string name, int components, const std::vector<T>& values)
    {
        cell_arrays_.push_back(make_array(std::move(name), components, values));
    }

    /// Writes the file in one move; a reader finds all of it or nothing. Throws RunError.
    void write(const std::string& path, double time) const;

private:
    struct Array {
        std::string name, type;
        int components;
        std::string bytes;
    };
    std::vector<std::int32_t> connectivity_, offsets_;
    std::vector<std::uint8_t> types_;
    std::vector<Array> point_arrays_, cell_arrays_;

    static std::string type_name(float) { return "Float32"; }
    static std::string type_name(std::int32_t) { return "Int32"; }
    static std::string type_name(std::int64_t) { return "Int64"; }
    static std::string type_name(std::uint8_t) { return "UInt8"; }

    template <class T>
    static Array make_array(std::string name, int components, const std::vector<T>& values)
    {
        std::string bytes(values.size() * sizeof(T), '\0');
        if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
        return {std::move(name), type_name(T{}), components, std::move(bytes)};
    }
};

} // namespace plash

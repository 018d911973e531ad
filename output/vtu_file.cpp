#include "output/vtu_file.h"

#include "output/result_file.h"

#include <fmt/format.h>

namespace plash {

void VtuFile::add_cell(const Cell& cell)
{
    for (Index corner : cell.used()) connectivity_.push_back(corner);
    offsets_.push_back(static_cast<std::int32_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(cell.shape));
}

void VtuFile::write(const std::string& path, double time) const
{
    const std::vector<Array> point_block = {make_array("Points", 3, points)};
    const std::vector<Array> cell_block = {make_array("connectivity", 1, connectivity_),
                                           make_array("offsets", 1, offsets_),
                                           make_array("types", 1, types_)};
    std::vector<const Array*> appended;
    std::uint64_t offset = 0;
    std::string xml =
        fmt::format("<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
                    "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
                    "format=\"ascii\">{}</DataArray>\n</FieldData>\n"
                    "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                    time, points.size() / 3, types_.size());
    const auto block = [&](std::string_view name, const std::vector<Array>& arrays) {
        fmt::format_to(std::back_inserter(xml), "<{}>\n", name);
        for (const Array& array : arrays) {
            fmt::format_to(std::back_inserter(xml),
                           "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
                           "offset=\"{}\"/>\n",
                           array.type, array.name, array.components, offset);
            offset += sizeof(std::uint64_t) + array.bytes.size();
            appended.push_back(&array);
        }
        fmt::format_to(std::back_inserter(xml), "</{}>\n", name);
    };
    block("PointData", point_arrays_);
    block("CellData", cell_arrays_);
    block("Points", point_block);
    block("Cells", cell_block);
    xml += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

    replace_file(path, [&](ResultFile& file) {
        file.write(xml);
        for (const Array* array : appended) {
            const std::uint64_t length = array->bytes.size();
            file.write({reinterpret_cast<const char*>(&length), sizeof length});
            file.write(array->bytes);
        }
        file.write("\n</AppendedData>\n</VTKFile>\n");
    });
}

} // namespace plash

// *ALE_STRUCTURED_MESH: the reader makes its nodes and elements, so that sets, conditions and results see a
// mesh like any other.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plash {
namespace {

/// Control points stay a record among Model::others; this finds it by its number.
const Record* control_points(const Model& model, Id id)
{
    for (const Record& record : model.others)
        if (record.keyword == "ALE_STRUCTURED_MESH_CONTROL_POINTS" && record.integer("CPID") == id)
            return &record;
    return nullptr;
}

/// Planes from one control point up to the next, whose cells grow by the factor 1 + ratio from each to the
/// next one (ratio > 0), or shrink by 1 - ratio (ratio < 0).
void add_interval(std::vector<double>& planes, double begin, double end, Id cells, double ratio)
{
    const double factor = ratio >= 0 ? 1 + ratio : 1 / (1 - ratio);
    const double sum = factor == 1 ? static_cast<double>(cells)
                                   : (std::pow(factor, static_cast<double>(cells)) - 1) / (factor - 1);
    const double first = (end - begin) / sum;
    for (Id cell = 1; cell <= cells; ++cell) {
        const double n = static_cast<double>(cell);
        const double widths = factor == 1 ? n : (std::pow(factor, n) - 1) / (factor - 1);
        planes.push_back(cell == cells ? end : begin + first * widths);
    }
}

/// Local coordinates of the planes along one axis; empty after an error.
std::vector<double> planes_of(const Record& mesh, std::string_view field, Reading& reading)
{
    const Id id = mesh.integer(field);
    const Record* record = control_points(reading.model, id);
    if (!record) {
        reading.error(mesh, field, fmt::format("there are no control points {}", id));
        return {};
    }
    if (record->integer("ICASE") != 0) {
        reading.error(*record, "ICASE",
                      "only control points by node number and coordinate (ICASE = 0) are "
                      "supported");
        return {};
    }
    const Table* table = record->table("N");
    if (!table || table->rows() < 2) {
        reading.error(*record, "N", "a direction needs at least two control points");
        return {};
    }
    const double scale = record->real("SFO"), offset = record->real("OFFO");
    const auto coordinate = [&](std::size_t row) { return scale * (table->at(row, 1) + offset); };
    std::vector<double> planes{coordinate(0)};
    for (std::size_t row = 1; row < table->rows(); ++row) {
        const Id cells = std::llround(table->at(row, 0) - table->at(row - 1, 0));
        const double begin = coordinate(row - 1), end = coordinate(row);
        if (cells < 1 || !(end > begin)) {
            reading.report.error({record->where.file, table->lines[row]}, record->keyword, "N",
                                 "node numbers and coordinates of control points must rise");
            return {};
        }
        add_interval(planes, begin, end, cells, table->at(row - 1, 2));
    }
    return planes;
}

/// *ALE_STRUCTURED_MESH_REFINE: cuts the cells of a mesh along an axis into equal pieces.
void refine(std::vector<double>& planes, const Record& mesh, std::string_view field, Reading& reading)
{
    for (const Record& record : reading.model.others) {
        if (record.keyword != "ALE_STRUCTURED_MESH_REFINE" ||
            record.integer("MSHID") != mesh.integer("MSHID"))
            continue;
        const Id pieces = record.integer(field);
        if (pieces < 1) {
            reading.error(record, field, "a cell is cut into at least one piece");
            return;
        }
        std::vector<double> finer;
        for (std::size_t i = 0; i + 1 < planes.size(); ++i)
            for (Id piece = 0; piece < pieces; ++piece)
                finer.push_back(planes[i] + (planes[i + 1] - planes[i]) * static_cast<double>(piece) /
                                                static_cast<double>(pieces));
        finer.push_back(planes.back());
        planes = std::move(finer);
    }
}

/// The mesh part: as the deck has it, else made here. Without a section it gets that of a multi-material
/// mesh.
Index mesh_part(const Record& mesh, Reading& reading)
{
    Model& model = reading.model;
    Id id = mesh.integer("DPID");
    if (id == 0)
        for (const Part& part : model.parts) id = std::max(id, part.id + 1);
    Index part = reading.table(Kind::part).find(id);
    if (part == none) {
        part = static_cast<Index>(model.parts.size());
        Part made;
        made.id = id;
        made.title = fmt::format("structured mesh {}", mesh.integer("MSHID"));
        made.where = mesh.where;
        model.parts.push_back(std::move(made));
        reading.table(Kind::part).add(id, part);
    }
    std::erase(reading.parts_without_material, part);
    if (model.parts[part].section == none) {
        std::erase(reading.parts_without_section, part);
        Record section;
        section.keyword = "SECTION_SOLID";
        section.where = mesh.where;
        section.fields.push_back({"ELFORM", 11, {}, false, true, mesh.where});
        model.parts[part].section = static_cast<Index>(model.sections.size());
        model.sections.push_back(std::move(section));
    }
    return part;
}

/// Origin and axes of the mesh's own coordinates.
CoordinateSystem mesh_system(const Record& mesh, Reading& reading)
{
    CoordinateSystem system;
    if (const Index index = reading.find(mesh, "LCSID", Kind::coordinate); index != none)
        system = reading.model.coordinate_systems[index];
    if (const Index node = reading.find(mesh, "NID0", Kind::node); node != none)
        system.origin = reading.model.nodes.position[node];
    return system;
}

Id first_free(Id wanted, const std::vector<Id>& ids)
{
    if (wanted > 0) return wanted;
    return ids.empty() ? 1 : *std::max_element(ids.begin(), ids.end()) + 1;
}

void read_structured_mesh(const Record& mesh, const Block&, Reading& reading)
{
    std::array<std::vector<double>, 3> planes{planes_of(mesh, "CPIDX", reading),
                                              planes_of(mesh, "CPIDY", reading),
                                              planes_of(mesh, "CPIDZ", reading)};
    for (const auto& axis : planes)
        if (axis.empty()) return;
    constexpr const char* pieces[] = {"IFX", "IFY", "IFZ"};
    for (int axis = 0; axis < 3; ++axis) refine(planes[axis], mesh, pieces[axis], reading);
    Model& model = reading.model;
    const CoordinateSystem system = mesh_system(mesh, reading);
    const Index part = mesh_part(mesh, reading);
    const Index first = static_cast<Index>(model.nodes.size());
    Id node_id = first_free(mesh.integer("NBID"), model.nodes.id);
    for (double z : planes[2]) {
        for (double y : planes[1]) {
            for (double x : planes[0]) {
                model.nodes.id.push_back(node_id++);
                model.nodes.position.push_back(system.origin + x * system.axes[0] + y * system.axes[1] +
                                               z * system.axes[2]);
            }
        }
    }
    for (Index repeated : reading.table(Kind::node).build(model.nodes.id)) {
        reading.error(
            mesh, "NBID",
            fmt::format("node {} of the structured mesh is there already", model.nodes.id[repeated]));
        return;
    }
    const Index row = static_cast<Index>(planes[0].size()),
                sheet = row * static_cast<Index>(planes[1].size());
    Id element_id = first_free(mesh.integer("EBID"), model.solids.id);
    for (std::size_t k = 0; k + 1 < planes[2].size(); ++k) {
        for (std::size_t j = 0; j + 1 < planes[1].size(); ++j) {
            for (std::size_t i = 0; i + 1 < planes[0].size(); ++i) {
                const Index n = first + static_cast<Index>(i) + static_cast<Index>(j) * row +
                                static_cast<Index>(k) * sheet;
                model.solids.id.push_back(element_id++);
                model.solids.part.push_back(part);
                model.solids.nodes.push_back({n, n + 1, n + 1 + row, n + row, n + sheet, n + 1 + sheet,
                                              n + 1 + row + sheet, n + row + sheet});
                ++reading.report.elements.solid;
            }
        }
    }
    if (!model.solids.axes.empty()) model.solids.axes.resize(model.solids.size());
    // What speaks of the mesh by its number finds its part here.
    Record kept = mesh;
    for (Record::Field& field : kept.fields)
        if (field.name == "DPID") field.value = static_cast<double>(model.parts[part].id);
    model.others.push_back(std::move(kept));
}

constexpr Translator ale_table[] = {
    {"ALE_STRUCTURED_MESH_CONTROL_POINTS", Phase::properties},
    {"ALE_STRUCTURED_MESH_REFINE", Phase::properties},
    {"ALE_STRUCTURED_MESH", Phase::elements, read_structured_mesh},
};

} // namespace

std::span<const Translator> ale_keywords()
{
    return ale_table;
}

} // namespace plash

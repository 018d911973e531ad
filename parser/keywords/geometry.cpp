// *DEFINE_COORDINATE, _VECTOR and _BOX.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plash {
namespace {

/// Axes from a point on x and one in the xy plane, both as vectors from the origin.
void keep_system(const Record& record, Vec3 origin, Vec3 along_x, Vec3 in_plane, Reading& reading)
{
    CoordinateSystem system;
    system.id = record.id;
    system.where = record.where;
    system.origin = origin;
    const Vec3 x = unit(along_x), z = unit(cross(x, in_plane));
    if (norm(z) < 0.5)
        reading.error(record, "CID",
                      fmt::format("coordinate system {}: its three points lie on one line", record.id));
    system.axes = {x, cross(z, x), z};
    reading.model.coordinate_systems.push_back(system);
}

void read_system(const Record& record, const Block& block, Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    const Vec3 origin = motion.point(vector_of(record, "XO", "YO", "ZO"));
    keep_system(record, origin, motion.point(vector_of(record, "XL", "YL", "ZL")) - origin,
                motion.point(vector_of(record, "XP", "YP", "ZP")) - origin, reading);
}

void read_system_of_vectors(const Record& record, const Block& block, Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    keep_system(record, {}, motion.direction(vector_of(record, "XX", "YX", "ZX")),
                motion.direction(vector_of(record, "XV", "YV", "ZV")), reading);
}

/// Position of the node that a field names; the report tells when there is none.
Vec3 node_position(const Record& record, std::string_view field, Reading& reading)
{
    const Index node = reading.find(record, field, Kind::node);
    return node == none ? Vec3{} : reading.model.nodes.position[node];
}

void read_system_of_nodes(const Record& record, const Block&, Reading& reading)
{
    const Vec3 origin = node_position(record, "N1", reading);
    keep_system(record, origin, node_position(record, "N2", reading) - origin,
                node_position(record, "N3", reading) - origin, reading);
    if (record.integer("FLAG") != 1) return;
    reading.model.coordinate_systems.back().nodes = {reading.find(record, "N1", Kind::node),
                                                     reading.find(record, "N2", Kind::node),
                                                     reading.find(record, "N3", Kind::node)};
}

void read_vector(const Record& record, const Block& block, Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    reading.model.vectors.push_back({record.id, motion.point(vector_of(record, "XT", "YT", "ZT")),
                                     motion.point(vector_of(record, "XH", "YH", "ZH")), record.where});
}

/// Moved, stretched, mirrored or turned by right angles: what lies along an axis still does.
bool keeps_axes(const Affine& motion)
{
    constexpr double round_off = 1e-9; // of the sines of right angles, relative to the stretch
    return std::all_of(motion.columns.begin(), motion.columns.end(), [](const Vec3& column) {
        const double largest = std::max({std::abs(column.x), std::abs(column.y), std::abs(column.z)});
        return std::abs(column.x) + std::abs(column.y) + std::abs(column.z) - largest <= round_off * largest;
    });
}

void read_box(const Record& record, const Block& block, Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    if (!keeps_axes(motion))
        reading.error(record, "BOXID", "the include is turned, and a box has its sides along the axes");
    const Vec3 one = motion.point(vector_of(record, "XMN", "YMN", "ZMN"));
    const Vec3 other = motion.point(vector_of(record, "XMX", "YMX", "ZMX"));
    const Box box{{std::min(one.x, other.x), std::min(one.y, other.y), std::min(one.z, other.z)},
                  {std::max(one.x, other.x), std::max(one.y, other.y), std::max(one.z, other.z)}};
    reading.model.boxes.push_back({record.id, box, record.where});
}

constexpr Translator geometry_table[] = {
    {"DEFINE_COORDINATE_SYSTEM", Phase::properties, read_system},
    {"DEFINE_COORDINATE_VECTOR", Phase::properties, read_system_of_vectors},
    {"DEFINE_COORDINATE_NODES", Phase::properties, read_system_of_nodes},
    {"DEFINE_VECTOR", Phase::properties, read_vector},
    {"DEFINE_BOX", Phase::properties, read_box},
};

} // namespace

std::span<const Translator> geometry_keywords()
{
    return geometry_table;
}

} // namespace plash

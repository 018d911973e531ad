#include "sph/active_region.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Whether a point lies inside of a box, edges not counted.
bool strictly_inside(const Box& box, const Vec3& x)
{
    return x.x > box.low.x && x.x < box.high.x && x.y > box.low.y && x.y < box.high.y && x.z > box.low.z &&
           x.z < box.high.z;
}

std::vector<Index> parts_of(const Model& model, const Record& record)
{
    const Id id = record.integer("ID");
    if (record.integer("TYPE") == 1) {
        for (std::size_t i = 0; i < model.parts.size(); ++i)
            if (model.parts[i].id == id) return {static_cast<Index>(i)};
        reject_field(record, "ID", fmt::format("there is no part {}", id));
    }
    for (const PartSet& set : model.part_sets)
        if (set.id == id) return set.parts;
    reject_field(record, "ID", fmt::format("there is no part set {}", id));
}

Index node_of(const Model& model, const Record& record)
{
    const Id id = record.integer("NID");
    if (id == 0) return none;
    const auto found = std::find(model.nodes.id.begin(), model.nodes.id.end(), id);
    if (found == model.nodes.id.end()) reject_field(record, "NID", fmt::format("there is no node {}", id));
    return static_cast<Index>(found - model.nodes.id.begin());
}

ActiveRegion region_of(const Model& model, const Record& record)
{
    ActiveRegion region;
    region.parts = parts_of(model, record);
    region.node = node_of(model, record);
    if (record.integer("ICID") != 0) {
        reject_field(record, "ICID", "regions stand along the global axes (ICID = 0) alone");
    }
    const auto corner = [&](const char* x, const char* y, const char* z) {
        return Vec3{record.real(x), record.real(y), record.real(z)};
    };
    const Id shape = record.integer("STYPE");
    switch (shape) {
    case 0:
        region.inner = {corner("XIMIN", "YIMIN", "ZIMIN"), corner("XIMAX", "YIMAX", "ZIMAX")};
        region.outer = {corner("XOMIN", "YOMIN", "ZOMIN"), corner("XOMAX", "YOMAX", "ZOMAX")};
        return region;
    case 1: {
        region.shape = ActiveRegion::Shape::cylinder;
        region.centre = corner("X0", "Y0", "Z0");
        const Vec3 along = corner("XH", "YH", "ZH") - region.centre;
        if (norm(along) == 0) reject_field(record, "XH", "head and foot of the axis are the same point");
        region.axis = unit(along);
        region.least_height = record.real("ZMIN");
        region.largest_height = record.real("ZMAX");
        break;
    }
    case 2:
        region.shape = ActiveRegion::Shape::sphere;
        region.centre = corner("X0", "Y0", "Z0");
        break;
    default:
        reject_field(
            record, "STYPE",
            fmt::format("there is no shape {}; there are 0 (box), 1 (cylinder) and 2 (sphere)", shape));
    }
    region.least_radius = record.real("RMIN");
    region.largest_radius = record.real("RMAX");
    return region;
}

} // namespace

bool ActiveRegion::holds(const Vec3& position, const Vec3& travelled) const
{
    const Vec3 x = position - travelled;
    if (shape == Shape::box) return outer.holds(x) && !strictly_inside(inner, x);
    const Vec3 apart = x - centre;
    if (shape == Shape::sphere) return norm(apart) >= least_radius && norm(apart) <= largest_radius;
    const double height = dot(apart, axis), radius = norm(apart - height * axis);
    const bool in_hole = radius < least_radius && height > 0 && height < least_height;
    return radius <= largest_radius && height >= 0 && height <= largest_height && !in_hole;
}

std::vector<ActiveRegion> active_regions_of(const Model& model)
{
    std::vector<ActiveRegion> regions;
    for (const Record& record : model.others) {
        if (record.keyword == "DEFINE_SPH_ACTIVE_REGION") regions.push_back(region_of(model, record));
    }
    return regions;
}

} // namespace plash

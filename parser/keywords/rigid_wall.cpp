// *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>

namespace plash {
namespace {

bool has_option(const Record& record, std::string_view option)
{
    return record.keyword.find(option) != std::string::npos;
}

/// The nodes that a wall stops: NSID, NSIDEX, BOXID.
void read_nodes(const Record& record, RigidWall& wall, Reading& reading)
{
    Model& model = reading.model;
    wall.all_nodes = record.integer("NSID") == 0;
    if (!wall.all_nodes) {
        const Index set = reading.find(record, "NSID", Kind::node_set);
        if (set != none) wall.nodes = model.node_sets[set].nodes;
    }
    if (const Index set = reading.find(record, "NSIDEX", Kind::node_set); set != none)
        wall.excluded = model.node_sets[set].nodes;
    if (const Index box = reading.find(record, "BOXID", Kind::box); box != none) {
        if (wall.all_nodes) wall.nodes = all_nodes(model);
        wall.all_nodes = false;
        std::erase_if(wall.nodes,
                      [&](Index node) { return !model.boxes[box].box.holds(model.nodes.position[node]); });
    }
}

/// What all walls have: number, nodes, times, tail and normal, friction.
RigidWall common_of(const Record& record, const Block& block, Reading& reading)
{
    RigidWall wall;
    wall.id = record.integer("ID");
    wall.title = record.title;
    wall.where = record.where;
    read_nodes(record, wall, reading);
    const Affine motion = reading.motion_of(block);
    wall.tail = motion.point({record.real("XT"), record.real("YT"), record.real("ZT")});
    const Vec3 head = motion.point({record.real("XH"), record.real("YH"), record.real("ZH")});
    wall.normal = unit(head - wall.tail);
    wall.friction = record.real("FRIC");
    wall.birth = record.real("BIRTH");
    const double death = record.real("DEATH", forever);
    wall.death = death == 0 || death >= 1e20 ? forever : death;
    return wall;
}

void check_normal(const Record& record, const RigidWall& wall, Reading& reading)
{
    if (norm(wall.normal) > 0.5) return;
    reading.error(record, "XH", "the head (XH, YH, ZH) and tail (XT, YT, ZT) of the normal are one point");
}

/// Edges of finite planes and prisms: along l = from the tail to (XHEV, YHEV, ZHEV), made normal to the
/// normal, and m = normal x l.
void read_edges(const Record& record, const Block& block, RigidWall& wall, Reading& reading)
{
    const Vec3 head =
        reading.motion_of(block).point({record.real("XHEV"), record.real("YHEV"), record.real("ZHEV")});
    const Vec3 edge = head - wall.tail;
    wall.edge = unit(edge - dot(edge, wall.normal) * wall.normal);
    if (norm(wall.edge) < 0.5)
        reading.error(record, "XHEV",
                      "the edge vector (XHEV, YHEV, ZHEV) has no direction across the normal");
    wall.length = {record.real("LENL"), record.real("LENM"), 0};
    if (record.peek("LENP")) wall.length[2] = record.real("LENP");
}

void read_friction(const Record& record, RigidWall& wall, Reading& reading)
{
    wall.orthotropic = true;
    wall.static_friction = {record.real("SFRICA"), record.real("SFRICB")};
    wall.dynamic_friction = {record.real("DFRICA"), record.real("DFRICB")};
    wall.friction_decay = {record.real("DECAYA"), record.real("DECAYB")};
    wall.friction_axis = {record.real("D1"), record.real("D2"), record.real("D3")};
    const Index from = reading.find(record, "NODE1", Kind::node),
                to = reading.find(record, "NODE2", Kind::node);
    if (from != none && to != none)
        wall.friction_axis = reading.model.nodes.position[to] - reading.model.nodes.position[from];
    const Vec3 along = wall.friction_axis - dot(wall.friction_axis, wall.normal) * wall.normal;
    if (norm(along) == 0)
        reading.error(record, "D1",
                      "orthotropic friction needs a direction in the wall (NODE1, NODE2 or D1, D2, D3)");
}

void read_planar_wall(const Record& record, const Block& block, Reading& reading)
{
    RigidWall wall = common_of(record, block, reading);
    check_normal(record, wall, reading);
    wall.offset = record.real("OFFSET");
    if (wall.friction >= 2) wall.weld_velocity = record.real("WVEL");
    if (has_option(record, "_ORTHO")) read_friction(record, wall, reading);
    if (has_option(record, "_FINITE")) {
        wall.shape = RigidWall::Shape::finite_plane;
        read_edges(record, block, wall, reading);
    }
    if (has_option(record, "_MOVING")) {
        wall.mass = record.real("MASS");
        wall.start_velocity = record.real("V0");
        if (!(wall.mass > 0)) reading.error(record, "MASS", "a moving wall needs a mass");
    }
    if (record.peek("SOFT") && record.integer("SOFT") > 0)
        reading.error(record, "SOFT", "stopping nodes over several cycles is not supported; leave it at 0");
    reading.model.rigid_walls.push_back(std::move(wall));
}

/// Motion of a geometric wall: OPT 0 velocity, 1 displacement along (VX, VY, VZ).
void read_motion(const Record& record, const Block& block, RigidWall& wall, Reading& reading)
{
    wall.motion_curve = reading.find(record, "LCID", Kind::curve);
    if (record.integer("LCID") == 0) reading.error(record, "LCID", "a moving wall needs a curve");
    wall.motion_is_displacement = record.integer("OPT") == 1;
    const Vec3 direction =
        reading.motion_of(block).direction({record.real("VX"), record.real("VY"), record.real("VZ")});
    wall.motion_direction = unit(direction);
    if (norm(direction) == 0)
        reading.error(record, "VX", "the direction (VX, VY, VZ) of the wall's motion has no length");
}

void read_geometric_wall(const Record& record, const Block& block, Reading& reading)
{
    RigidWall wall = common_of(record, block, reading);
    if (has_option(record, "_SPHERE")) {
        wall.shape = RigidWall::Shape::sphere;
        wall.radius = record.real("RADSPH");
        if (norm(wall.normal) < 0.5) wall.normal = {0, 0, 1};
        if (!(wall.radius > 0)) reading.error(record, "RADSPH", "a sphere needs a radius");
    } else {
        check_normal(record, wall, reading);
    }
    if (has_option(record, "_CYLINDER")) {
        wall.shape = RigidWall::Shape::cylinder;
        wall.interior = has_option(record, "_INTERIOR");
        wall.radius = record.real("RADCYL");
        wall.length[0] = record.real("LENCYL");
        const Vec3 helper = std::abs(wall.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        wall.edge = unit(cross(wall.normal, helper));
        if (!(wall.radius > 0)) reading.error(record, "RADCYL", "a cylinder needs a radius");
    } else if (has_option(record, "_FLAT")) {
        wall.shape = RigidWall::Shape::finite_plane;
        read_edges(record, block, wall, reading);
    } else if (has_option(record, "_PRISM")) {
        wall.shape = RigidWall::Shape::prism;
        read_edges(record, block, wall, reading);
        for (double length : wall.length)
            if (!(length > 0))
                reading.error(record, "LENP", "a prism needs three lengths (LENL, LENM, LENP)");
    }
    if (has_option(record, "_MOTION")) read_motion(record, block, wall, reading);
    reading.model.rigid_walls.push_back(std::move(wall));
}

constexpr Translator rigid_wall_table[] = {
    {"RIGIDWALL_PLANAR*", Phase::conditions, read_planar_wall},
    {"RIGIDWALL_GEOMETRIC*", Phase::conditions, read_geometric_wall},
};

} // namespace

std::span<const Translator> rigid_wall_keywords()
{
    return rigid_wall_table;
}

} // namespace plash

// *RIGIDWALL_PLANAR.

#include "parser/reading.h"

#include <algorithm>

namespace plash {
namespace {

void read_planar_wall(const Record& record, const Block& block, Reading& reading)
{
    Model& model = reading.model;
    PlanarWall wall;
    wall.id = record.integer("ID");
    wall.title = record.title;
    wall.where = record.where;
    const Affine motion = reading.motion_of(block);
    wall.tail = motion.point({record.real("XT"), record.real("YT"), record.real("ZT")});
    const Vec3 head = motion.point({record.real("XH"), record.real("YH"), record.real("ZH")});
    wall.normal = unit(head - wall.tail);
    if (norm(wall.normal) < 0.5)
        reading.error(record, "XH",
                      "the head (XH, YH, ZH) and tail (XT, YT, ZT) of the normal are one point");
    wall.friction = record.real("FRIC");
    wall.offset = record.real("OFFSET");
    wall.birth = record.real("BIRTH");
    const double death = record.real("DEATH", forever);
    wall.death = death == 0 || death >= 1e20 ? forever : death;

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
    model.planar_walls.push_back(std::move(wall));
}

constexpr Translator keywords[] = {
    {"RIGIDWALL_PLANAR", Phase::conditions, read_planar_wall},
};

} // namespace

std::span<const Translator> rigid_wall_keywords()
{
    return keywords;
}

} // namespace plash

// *LOAD_NODE and *LOAD_BODY.

#include "parser/reading.h"

#include <fmt/format.h>

namespace plash {
namespace {

Vec3 axis_of(const Record& record, int axis, Reading& reading)
{
    const Index system = reading.find(record, "CID", Kind::coordinate);
    return system == none ? CoordinateSystem{}.axes[axis]
                          : reading.model.coordinate_systems[system].axes[axis];
}

/// A load without a curve would be zero at all times in LS-DYNA: the deck surely means something else.
bool find_curve(const Record& record, Index& curve, Reading& reading)
{
    curve = reading.find(record, "LCID", Kind::curve);
    if (record.integer("LCID") == 0) reading.error(record, "LCID", "a load needs a curve");
    return curve != none;
}

void read_nodal_load(const Record& record, const Block&, Reading& reading)
{
    NodalLoad load;
    load.where = record.where;
    if (record.peek("NSID")) {
        const Index set = reading.find(record, "NSID", Kind::node_set);
        if (set != none) load.nodes = reading.model.node_sets[set].nodes;
    } else if (const Index node = reading.find(record, "NID", Kind::node); node != none) {
        load.nodes = {node};
    }
    const Id freedom = record.integer("DOF");
    if (freedom < 1 || freedom > 7 || freedom == 4) {
        reading.error(record, "DOF",
                      fmt::format("{} is not supported; 1 to 3 are forces, 5 to 7 moments", freedom));
        return;
    }
    load.moment = freedom > 4;
    load.direction = axis_of(record, static_cast<int>((freedom - 1) % 4), reading);
    load.scale = record.real("SF", 1);
    if (find_curve(record, load.curve, reading) && !load.nodes.empty())
        reading.model.nodal_loads.push_back(std::move(load));
}

void read_body_load(const Record& record, const Block&, Reading& reading)
{
    BodyLoad load;
    load.where = record.where;
    load.direction = axis_of(record, record.keyword.back() - 'X', reading);
    load.scale = record.real("SF", 1);
    if (find_curve(record, load.curve, reading)) reading.model.body_loads.push_back(std::move(load));
}

/// *LOAD_RIGID_BODY: DOF 1 to 3 force along, 5 to 7 moment about an axis; 4, 8 normal to a plane of nodes.
void read_rigid_body_load(const Record& record, const Block&, Reading& reading)
{
    RigidBodyLoad load;
    load.where = record.where;
    load.body = reading.find_body(record.integer("PID"));
    const Id freedom = record.integer("DOF", 1);
    if (freedom < 1 || freedom > 8) {
        reading.error(record, "DOF",
                      fmt::format("{} is not one of 1 to 3 force, 5 to 7 moment, 4 and 8 follower", freedom));
        return;
    }
    load.moment = freedom > 4;
    if (freedom % 4 == 0) {
        constexpr std::string_view fields[] = {"M1", "M2", "M3"};
        for (int i = 0; i < 3; ++i) {
            load.plane[i] = reading.table(Kind::node).find(record.integer(fields[i]));
            if (load.plane[i] == none)
                reading.error(record, fields[i],
                              fmt::format("there is no node {}", record.integer(fields[i])));
        }
    } else {
        load.direction = axis_of(record, static_cast<int>((freedom - 1) % 4), reading);
    }
    load.scale = record.real("SF", 1);
    if (find_curve(record, load.curve, reading) && load.body != none)
        reading.model.rigid_body_loads.push_back(load);
}

/// *LOAD_BODY_PARTS: all body loads act on these parts only.
void read_body_parts(const Record& record, const Block&, Reading& reading)
{
    const Index set = reading.find(record, "PSID", Kind::part_set);
    if (set != none) reading.body_load_parts = reading.model.part_sets[set].parts;
}

constexpr Translator keywords[] = {
    {"LOAD_NODE_POINT", Phase::conditions, read_nodal_load},
    {"LOAD_NODE_SET", Phase::conditions, read_nodal_load},
    {"LOAD_RIGID_BODY", Phase::conditions, read_rigid_body_load},
    {"LOAD_BODY_X", Phase::conditions, read_body_load},
    {"LOAD_BODY_Y", Phase::conditions, read_body_load},
    {"LOAD_BODY_Z", Phase::conditions, read_body_load},
    {"LOAD_BODY_PARTS", Phase::conditions, read_body_parts},
};

} // namespace

std::span<const Translator> load_keywords()
{
    return keywords;
}

void finish_loads(Reading& reading)
{
    for (BodyLoad& load : reading.model.body_loads) load.parts = reading.body_load_parts;
}

} // namespace plash

// *LOAD_NODE, *LOAD_BODY, *LOAD_GRAVITY_PART, *LOAD_SEGMENT and *LOAD_SHELL.

#include "parser/reading.h"

#include <array>
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

/// M1, M2, M3: the load is normal to their plane, or along M1 M2 without the third.
bool read_followed_nodes(const Record& record, NodalLoad& load, Reading& reading)
{
    const char* fields[] = {"M1", "M2", "M3"};
    for (int i = 0; i < 3; ++i) load.follows[i] = reading.find(record, fields[i], Kind::node);
    if (load.follows[0] != none && load.follows[1] != none) return true;
    reading.error(record, "M1", "a load that follows a plane (DOF 4, 8) needs the nodes M1, M2 and M3");
    return false;
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
    if (freedom < 1 || freedom > 8) {
        reading.error(record, "DOF",
                      fmt::format("{} is not supported; 1 to 4 are forces, 5 to 8 moments", freedom));
        return;
    }
    load.moment = freedom > 4;
    load.axis = static_cast<int>((freedom - 1) % 4);
    if (load.axis == 3) {
        if (!read_followed_nodes(record, load, reading)) return;
    } else {
        load.direction = axis_of(record, load.axis, reading);
        const Index system = reading.find(record, "CID", Kind::coordinate);
        if (system != none && reading.model.coordinate_systems[system].nodes[0] != none) load.system = system;
    }
    load.scale = record.real("SF", 1);
    if (find_curve(record, load.curve, reading) && !load.nodes.empty())
        reading.model.nodal_loads.push_back(std::move(load));
}

/// With a curve of its own for dynamic relaxation there are two loads.
void keep_body_load(const Record& record, const char* relaxation_field, BodyLoad load, Reading& reading)
{
    if (const Index curve = reading.find(record, relaxation_field, Kind::curve); curve != none) {
        BodyLoad other = load;
        other.curve = curve;
        other.phase = BodyLoad::Phase::relaxation;
        reading.model.body_loads.push_back(std::move(other));
        load.phase = BodyLoad::Phase::transient;
    }
    reading.model.body_loads.push_back(std::move(load));
}

/// *LOAD_BODY_X, _RX, _VECTOR ...
void read_body_load(const Record& record, const Block& block, Reading& reading)
{
    BodyLoad load;
    load.where = record.where;
    load.scale = record.real("SF", 1);
    if (record.keyword.ends_with("_VECTOR")) {
        const Vec3 v{record.real("V1"), record.real("V2"), record.real("V3")};
        load.direction = unit(reading.motion_of(block).direction(v));
        if (norm(v) == 0) reading.error(record, "V1", "the vector (V1, V2, V3) has no length");
    } else {
        load.direction = axis_of(record, record.keyword.back() - 'X', reading);
        if (record.keyword[record.keyword.size() - 2] == 'R') {
            load.kind = BodyLoad::Kind::centrifugal;
            load.center =
                reading.motion_of(block).point({record.real("XC"), record.real("YC"), record.real("ZC")});
        }
    }
    if (find_curve(record, load.curve, reading)) keep_body_load(record, "LCIDDR", std::move(load), reading);
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

/// Nodes that *LOAD_BODY_GENERALIZED speaks of: a range of numbers, a set of nodes or of parts.
void read_generalized_nodes(const Record& record, const Block& block, BodyLoad& load, Reading& reading)
{
    const Model& model = reading.model;
    if (record.peek("NSID")) {
        const Index set = reading.find(record, "NSID", Kind::node_set);
        if (set != none) load.nodes = model.node_sets[set].nodes;
    } else if (record.peek("PSID")) {
        const Index set = reading.find(record, "PSID", Kind::part_set);
        if (set != none) load.parts = model.part_sets[set].parts;
    } else {
        const Id first = block.number(Kind::node, record.integer("N1")),
                 last = block.number(Kind::node, record.integer("N2"));
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes.id[i] >= first && model.nodes.id[i] <= last)
                load.nodes.push_back(static_cast<Index>(i));
        }
    }
}

/// Components of acceleration and of rotation, each as its own load; ANGTYP says what the rotation is.
void read_generalized_load(const Record& record, const Block& block, Reading& reading)
{
    BodyLoad load;
    load.where = record.where;
    load.own_nodes = true;
    read_generalized_nodes(record, block, load, reading);
    if (load.nodes.empty() && load.parts.empty()) return;
    if (!find_curve(record, load.curve, reading)) return;
    const Affine motion = reading.motion_of(block);
    load.center = motion.point({record.real("XC"), record.real("YC"), record.real("ZC")});
    std::array<Vec3, 3> axes;
    for (int i = 0; i < 3; ++i) axes[i] = axis_of(record, i, reading);
    const auto vector = [&](const char* x, const char* y, const char* z) {
        return record.real(x) * axes[0] + record.real(y) * axes[1] + record.real(z) * axes[2];
    };
    const Vec3 acceleration = vector("AX", "AY", "AZ"), rotation = vector("OMX", "OMY", "OMZ");
    if (norm(acceleration) > 0) {
        load.direction = acceleration;
        keep_body_load(record, "DRLCID", load, reading);
    }
    if (norm(rotation) == 0) return;
    const std::string_view type = record.text("ANGTYP");
    load.direction = rotation;
    if (type == "CENT" || type.empty()) {
        load.kind = BodyLoad::Kind::centrifugal;
    } else if (type == "CORI") {
        load.kind = BodyLoad::Kind::coriolis;
    } else if (type == "ROTA") {
        load.kind = BodyLoad::Kind::angular_acceleration;
    } else {
        reading.error(record, "ANGTYP", fmt::format("'{}' is not one of CENT, CORI, ROTA", type));
    }
    keep_body_load(record, "DRLCID", std::move(load), reading);
}

/// *LOAD_GRAVITY_PART: ACCEL times the curve as base acceleration of a part.
void read_gravity(const Record& record, const Block&, Reading& reading)
{
    BodyLoad load;
    load.where = record.where;
    load.own_nodes = true;
    const bool set = record.keyword.ends_with("_SET");
    if (set) {
        const Index parts = reading.find(record, "PSID", Kind::part_set);
        if (parts != none) load.parts = reading.model.part_sets[parts].parts;
    } else if (const Index part = reading.find(record, "PID", Kind::part); part != none) {
        load.parts = {part};
    }
    const Id freedom = record.integer("DOF");
    if (freedom < 1 || freedom > 3) {
        reading.error(record, "DOF", fmt::format("{} is not one of 1, 2, 3", freedom));
        return;
    }
    load.direction = CoordinateSystem{}.axes[freedom - 1];
    load.scale = record.real("ACCEL");
    load.curve = reading.find(record, "LC", Kind::curve);
    if (!load.parts.empty()) reading.model.body_loads.push_back(std::move(load));
}

void keep_pressure(const Record& record, PressureLoad load, Reading& reading)
{
    load.where = record.where;
    load.scale = record.real("SF", 1);
    load.arrival = record.real("AT");
    if (find_curve(record, load.curve, reading) && !load.segments.empty())
        reading.model.pressure_loads.push_back(std::move(load));
}

void read_segment_load(const Record& record, const Block&, Reading& reading)
{
    PressureLoad load;
    const auto nodes = reading.find_segment(record);
    if (!nodes) return;
    if (record.integer("N5") != 0)
        reading.error(record, "N5", "pressure on segments of six or eight nodes is not supported");
    load.segments = {*nodes};
    keep_pressure(record, std::move(load), reading);
}

void read_segment_set_load(const Record& record, const Block&, Reading& reading)
{
    const Index set = reading.find(record, "SSID", Kind::segment_set);
    if (set == none) return;
    PressureLoad load;
    load.segments = reading.model.segment_sets[set].segments;
    keep_pressure(record, std::move(load), reading);
}

void read_shell_load(const Record& record, const Block&, Reading& reading)
{
    PressureLoad load;
    const Model& model = reading.model;
    if (record.peek("ESID")) {
        const Index set = reading.find(record, "ESID", Kind::shell_set);
        if (set == none) return;
        for (Index shell : model.shell_sets[set].elements) load.segments.push_back(model.shells.nodes[shell]);
    } else if (const Index shell = reading.find(record, "EID", Kind::shell); shell != none) {
        load.segments = {model.shells.nodes[shell]};
    }
    keep_pressure(record, std::move(load), reading);
}

/// *LOAD_BODY_PARTS: all body loads act on these parts only.
void read_body_parts(const Record& record, const Block&, Reading& reading)
{
    const Index set = reading.find(record, "PSID", Kind::part_set);
    if (set != none) reading.body_load_parts = reading.model.part_sets[set].parts;
}

constexpr Translator load_table[] = {
    {"LOAD_NODE_POINT", Phase::conditions, read_nodal_load},
    {"LOAD_NODE_SET", Phase::conditions, read_nodal_load},
    {"LOAD_RIGID_BODY", Phase::conditions, read_rigid_body_load},
    {"LOAD_BODY_X", Phase::conditions, read_body_load},
    {"LOAD_BODY_Y", Phase::conditions, read_body_load},
    {"LOAD_BODY_Z", Phase::conditions, read_body_load},
    {"LOAD_BODY_RX", Phase::conditions, read_body_load},
    {"LOAD_BODY_RY", Phase::conditions, read_body_load},
    {"LOAD_BODY_RZ", Phase::conditions, read_body_load},
    {"LOAD_BODY_VECTOR", Phase::conditions, read_body_load},
    {"LOAD_BODY_GENERALIZED*", Phase::conditions, read_generalized_load},
    {"LOAD_GRAVITY_PART", Phase::conditions, read_gravity},
    {"LOAD_GRAVITY_PART_SET", Phase::conditions, read_gravity},
    {"LOAD_SEGMENT", Phase::conditions, read_segment_load},
    {"LOAD_SEGMENT_SET", Phase::conditions, read_segment_set_load},
    {"LOAD_SHELL_ELEMENT", Phase::conditions, read_shell_load},
    {"LOAD_SHELL_SET", Phase::conditions, read_shell_load},
    {"LOAD_BODY_PARTS", Phase::conditions, read_body_parts},
};

} // namespace

std::span<const Translator> load_keywords()
{
    return load_table;
}

void finish_loads(Reading& reading)
{
    for (BodyLoad& load : reading.model.body_loads) {
        if (!load.own_nodes) load.parts = reading.body_load_parts;
    }
}

} // namespace plash

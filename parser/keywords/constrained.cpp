// *CONSTRAINED_ rigid bodies and their joints, *DEFORMABLE_TO_RIGID.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plash {
namespace {

/// Freedoms of the code that CON1 and CON2 share: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz.
FreedomMask freedoms_of_code(const Record& record, std::string_view field, Reading& reading)
{
    constexpr FreedomMask masks[8] = {0, 1, 2, 4, 3, 6, 5, 7};
    const Id code = record.integer(field);
    if (code >= 0 && code <= 7) return masks[code];
    reading.error(record, field, fmt::format("{} is not a constraint code from 0 to 7", code));
    return 0;
}

/// CMO, CON1, CON2 of the _SPC option: as those of *MAT_RIGID.
BodyFixity fixity_of(const Record& record, Reading& reading)
{
    BodyFixity fixity;
    const double option = record.real("CMO");
    if (option == 0) return fixity;
    if (option > 0) {
        fixity.freedoms =
            freedoms_of_code(record, "CON1", reading) | freedoms_of_code(record, "CON2", reading) << 3;
        return fixity;
    }
    if (const Id id = record.integer("CON1"); id != 0) {
        const Index system = reading.table(Kind::coordinate).find(id);
        if (system == none)
            reading.error(record, "CON1", fmt::format("there is no coordinate system {}", id));
        else
            fixity.axes = reading.model.coordinate_systems[system].axes;
    }
    Id rest = record.integer("CON2");
    for (int freedom = 5; freedom >= 0; --freedom, rest /= 10) {
        if (rest % 10 == 1)
            fixity.freedoms |= 1u << freedom;
        else if (rest % 10 != 0)
            reading.error(record, "CON2", "has figures that are not 0 or 1");
    }
    return fixity;
}

/// The number and the set are known at once, the nodes of the set later.
void read_nodal_rigid_body(const Record& record, const Block& block, Reading& reading)
{
    NodalRigidBody body;
    body.id = record.id; // the fields are read, and counted, once the sets are there: of a copy
    body.title = record.title;
    body.where = record.where;
    const bool held = record.keyword.find("_SPC") != std::string::npos;
    const bool has_inertia = record.keyword.find("_INERTIA") != std::string::npos;
    reading.model.nodal_rigid_bodies.push_back(std::move(body));
    reading.pending_bodies.push_back({record, &block, held, has_inertia});
}

/// "PIDL": a part or a nodal rigid body.
BodyNumber find_body(const Record& record, std::string_view field, Reading& reading)
{
    return reading.find_body(record.integer(field));
}

void read_merge(const Record& record, const Block& block, Reading& reading)
{
    RigidMerge merge;
    merge.where = record.where;
    merge.lead = find_body(record, "PIDL", reading);
    merge.add_inertia = record.integer("IFLAG") == 1;
    if (merge.lead == none) return;
    if (record.keyword.ends_with("_SET")) {
        const Id id = block.number(Kind::part_set, record.integer("PIDC"));
        const Index set = reading.table(Kind::part_set).find(id);
        if (set == none) {
            reading.error(record, "PIDC", fmt::format("there is no part set {}", id));
            return;
        }
        for (Index part : reading.model.part_sets[set].parts) {
            merge.follower = part;
            if (part != merge.lead) reading.model.rigid_merges.push_back(merge);
        }
        return;
    }
    merge.follower = find_body(record, "PIDC", reading);
    if (merge.follower != none) reading.model.rigid_merges.push_back(merge);
}

void read_extra_nodes(const Record& record, const Block&, Reading& reading)
{
    ExtraNodes extra;
    extra.where = record.where;
    extra.body = find_body(record, "PID", reading);
    extra.add_inertia = record.integer("IFLAG") == 1;
    if (record.peek("NSID")) {
        if (const Index set = reading.find(record, "NSID", Kind::node_set); set != none)
            extra.nodes = reading.model.node_sets[set].nodes;
    } else if (const Index node = reading.find(record, "NID", Kind::node); node != none) {
        extra.nodes = {node};
    }
    if (extra.body != none && !extra.nodes.empty()) reading.model.extra_nodes.push_back(std::move(extra));
}

constexpr std::pair<std::string_view, Joint::Type> joint_types[] = {
    {"SPHERICAL", Joint::Type::spherical},
    {"REVOLUTE", Joint::Type::revolute},
    {"CYLINDRICAL", Joint::Type::cylindrical},
    {"PLANAR", Joint::Type::planar},
    {"UNIVERSAL", Joint::Type::universal},
    {"CONSTANT_VELOCITY", Joint::Type::constant_velocity},
    {"TRANSLATIONAL", Joint::Type::translational},
    {"LOCKING", Joint::Type::locking},
    {"GEARS", Joint::Type::gears},
    {"PULLEY", Joint::Type::pulley},
    {"RACK_AND_PINION", Joint::Type::rack_and_pinion},
    {"SCREW", Joint::Type::screw},
    {"TRANSLATIONAL_MOTOR", Joint::Type::translational_motor},
    {"ROTATIONAL_MOTOR", Joint::Type::rotational_motor},
};

std::optional<JointFailure> read_joint_failure(const Record& record, Reading& reading)
{
    if (!record.peek("TFAIL")) return {};
    JointFailure failure;
    if (const double end = record.real("TFAIL"); end > 0) failure.end = end;
    failure.coupled = record.real("COUPL") <= 0;
    const char* const forces[] = {"NXX", "NYY", "NZZ"};
    const char* const moments[] = {"MXX", "MYY", "MZZ"};
    const auto strength = [&](const char* field) {
        const double value = record.real(field);
        if (value < 0) reading.error(record, field, "the strength is negative");
        return value;
    };
    for (int i = 0; i < 3; ++i) {
        failure.force[i] = strength(forces[i]);
        failure.moment[i] = strength(moments[i]);
    }
    failure.system = reading.find(record, "CID", Kind::coordinate);
    return failure;
}

void read_joint(const Record& record, const Block& block, Reading& reading)
{
    constexpr std::string_view prefix = "CONSTRAINED_JOINT_", coordinates = "COOR_";
    std::string_view type = record.keyword;
    type.remove_prefix(prefix.size());
    Joint joint;
    joint.by_places = type.starts_with(coordinates);
    if (joint.by_places) type.remove_prefix(coordinates.size());
    for (const auto& [name, value] : joint_types)
        if (name == type) joint.type = value;
    joint.id = record.integer("ID");
    if (joint.id == 0) joint.id = static_cast<Id>(reading.model.joints.size()) + 1;
    joint.title = record.title;
    joint.where = record.where;
    for (int i = 0; i < 6; ++i) {
        const std::string number = std::to_string(i + 1);
        if (joint.by_places) {
            joint.places[i] =
                reading.motion_of(block).point(vector_of(record, "X" + number, "Y" + number, "Z" + number));
        } else {
            joint.nodes[i] = reading.find(record, "N" + number, Kind::node);
        }
    }
    if (joint.by_places) {
        joint.bodies = {find_body(record, "RBID_A", reading), find_body(record, "RBID_B", reading)};
        for (int i = 0; i < 2; ++i)
            if (joint.bodies[i] == none)
                reading.error(record, i == 0 ? "RBID_A" : "RBID_B", "there is no such rigid body");
    }
    const bool motor = type.ends_with("_MOTOR");
    if (record.peek("PARM")) joint.parameter = record.real("PARM");
    if (motor) {
        joint.curve = reading.find(record, "LCID", Kind::curve);
        if (joint.curve == none && record.integer("LCID") == 0)
            reading.error(record, "LCID", "a motor needs a curve");
        const Id kind = record.integer("TYPE");
        if (kind < 0 || kind > 2)
            reading.error(record, "TYPE", "is not one of 0 velocity, 1 acceleration, 2 displacement");
        else
            joint.motion = static_cast<PrescribedMotion::Kind>(kind);
    } else if (record.peek("PARM") && joint.parameter == 0) {
        reading.error(record, "PARM", "this joint needs a ratio");
    }
    joint.failure = read_joint_failure(record, reading);
    reading.model.joints.push_back(std::move(joint));
}

/// Fields of one freedom: "PH" in LCIDPH, DLCIDPH, ESPH, FMPH, NSAPH, PSAPH.
JointStiffness::Freedom read_freedom(const Record& record, const std::string& name, bool translational,
                                     Reading& reading)
{
    JointStiffness::Freedom freedom;
    freedom.stiffness_curve = reading.find(record, "LCID" + name, Kind::curve);
    if (const Id id = record.integer("DLCID" + name); id != 0) {
        freedom.damping_curve = reading.table(Kind::curve).find(id);
        if (freedom.damping_curve == none)
            reading.error(record, "DLCID" + name, fmt::format("there is no curve {}", id));
    }
    freedom.elastic = record.real("ES" + name);
    const std::string friction = (translational ? "FF" : "FM") + name;
    freedom.friction = record.real(friction);
    if (freedom.friction < 0) {
        const Id id = static_cast<Id>(-freedom.friction);
        freedom.friction_curve = reading.table(Kind::curve).find(id);
        if (freedom.friction_curve == none)
            reading.error(record, friction, fmt::format("there is no curve {}", id));
    }
    const std::string stop = translational ? "SD" : "SA";
    const double unit = translational ? 1 : 3.14159265358979323846 / 180; // stop angles stand in degrees
    freedom.negative_stop = unit * record.real("N" + stop + name);
    freedom.positive_stop = unit * record.real("P" + stop + name);
    return freedom;
}

void read_joint_stiffness(const Record& record, const Block&, Reading& reading)
{
    JointStiffness stiffness;
    stiffness.where = record.where;
    stiffness.id = record.integer("JSID");
    stiffness.title = record.title;
    stiffness.translational = record.keyword.ends_with("TRANSLATIONAL");
    stiffness.first = find_body(record, "PIDA", reading);
    stiffness.second = find_body(record, "PIDB", reading);
    for (std::string_view field : {"PIDA", "PIDB"})
        if (find_body(record, field, reading) == none)
            reading.error(record, field, fmt::format("there is no rigid body {}", record.integer(field)));
    const auto system = [&](std::string_view field) {
        const Id id = record.integer(field);
        const Index found = reading.table(Kind::coordinate).find(id);
        if (found != none) return reading.model.coordinate_systems[found];
        reading.error(record, field, fmt::format("there is no coordinate system {}", id));
        return CoordinateSystem{};
    };
    const CoordinateSystem first = system("CIDA");
    const CoordinateSystem second = record.integer("CIDB") == 0 ? first : system("CIDB");
    stiffness.first_axes = first.axes;
    stiffness.first_origin = first.origin;
    stiffness.second_axes = second.axes;
    stiffness.second_origin = second.origin;
    const std::array<std::string, 3> names = stiffness.translational
                                                 ? std::array<std::string, 3>{"X", "Y", "Z"}
                                                 : std::array<std::string, 3>{"PH", "T", "PS"};
    for (int i = 0; i < 3; ++i)
        stiffness.freedoms[i] = read_freedom(record, names[i], stiffness.translational, reading);
    reading.model.joint_stiffnesses.push_back(std::move(stiffness));
}

/// *CONSTRAINED_GLOBAL: nodes in a plane that is normal to a global axis are held.
void read_constrained_plane(const Record& record, const Block& block, Reading& reading)
{
    const Id direction = record.integer("DIR");
    if (direction < 1 || direction > 3) {
        reading.error(record, "DIR", fmt::format("{} is not one of 1 x, 2 y, 3 z", direction));
        return;
    }
    const auto axis = vector_component[direction - 1];
    const double place = reading.motion_of(block).point(vector_of(record, "X", "Y", "Z")).*axis;
    const std::vector<Vec3>& positions = reading.model.nodes.position;
    double low = place, high = place;
    for (const Vec3& position : positions) {
        low = std::min(low, position.*axis);
        high = std::max(high, position.*axis);
    }
    const double given = record.real("TOL");
    const double tolerance = given > 0 ? given : 1e-6 * (high - low);
    FixedNodes fixed;
    fixed.where = record.where;
    fixed.freedoms = freedoms_of_code(record, "TC", reading) | freedoms_of_code(record, "RC", reading) << 3;
    for (std::size_t node = 0; node < positions.size(); ++node)
        if (std::abs(positions[node].*axis - place) <= tolerance)
            fixed.nodes.push_back(static_cast<Index>(node));
    if (fixed.nodes.empty()) reading.warning(record, "", "no node lies in this plane");
    if (!fixed.nodes.empty() && fixed.freedoms) reading.model.fixed_nodes.push_back(std::move(fixed));
}

/// The part, or the parts of the set (PTYPE = PSET), become rigid at the start.
void read_deformable_to_rigid(const Record& record, const Block&, Reading& reading)
{
    std::vector<Index> parts;
    if (record.text("PTYPE") == "PSET") {
        const Index set = reading.table(Kind::part_set).find(record.integer("PID"));
        if (set != none) parts = reading.model.part_sets[set].parts;
        if (set == none) reading.error(record, "PID", "there is no such part set");
    } else if (const Index part = reading.table(Kind::part).find(record.integer("PID")); part != none) {
        parts = {part};
    } else {
        reading.error(record, "PID", fmt::format("there is no part {}", record.integer("PID")));
    }
    const BodyNumber lead = find_body(record, "LRB", reading);
    reading.model.others.push_back(record); // a switch may set the parts free later
    for (Index part : parts) {
        reading.model.parts[part].made_rigid = true;
        if (lead != none) reading.model.rigid_merges.push_back({lead, part, true, record.where});
    }
}

void read_rigid_inertia(const Record& record, const Block& block, Reading& reading)
{
    const Index part = reading.find(record, "PID", Kind::part);
    if (part == none) return;
    reading.model.part_inertias[part] = read_inertia(record, block, "", reading);
}

constexpr Translator constrained_table[] = {
    {"CONSTRAINED_NODAL_RIGID_BODY", Phase::parts, read_nodal_rigid_body},
    {"CONSTRAINED_NODAL_RIGID_BODY_SPC", Phase::parts, read_nodal_rigid_body},
    {"CONSTRAINED_NODAL_RIGID_BODY_INERTIA", Phase::parts, read_nodal_rigid_body},
    {"CONSTRAINED_NODAL_RIGID_BODY_INERTIA_SPC", Phase::parts, read_nodal_rigid_body},
    {"CONSTRAINED_NODAL_RIGID_BODY_SPC_INERTIA", Phase::parts, read_nodal_rigid_body},
    {"CONSTRAINED_RIGID_BODIES", Phase::conditions, read_merge},
    {"CONSTRAINED_RIGID_BODIES_SET", Phase::conditions, read_merge},
    {"CONSTRAINED_EXTRA_NODES_NODE", Phase::conditions, read_extra_nodes},
    {"CONSTRAINED_EXTRA_NODES_SET", Phase::conditions, read_extra_nodes},
    {"CONSTRAINED_JOINT_SPHERICAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_REVOLUTE", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_CYLINDRICAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_PLANAR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_UNIVERSAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_CONSTANT_VELOCITY", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_CONSTANT_VELOCITY", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_TRANSLATIONAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_LOCKING", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_GEARS", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_PULLEY", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_RACK_AND_PINION", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_SCREW", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_TRANSLATIONAL_MOTOR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_ROTATIONAL_MOTOR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_SPHERICAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_REVOLUTE", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_CYLINDRICAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_PLANAR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_UNIVERSAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_TRANSLATIONAL", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_LOCKING", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_GEARS", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_PULLEY", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_RACK_AND_PINION", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_SCREW", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_TRANSLATIONAL_MOTOR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_COOR_ROTATIONAL_MOTOR", Phase::conditions, read_joint},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", Phase::conditions, read_joint_stiffness},
    {"CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL", Phase::conditions, read_joint_stiffness},
    {"CONSTRAINED_GLOBAL", Phase::conditions, read_constrained_plane},
    {"DEFORMABLE_TO_RIGID", Phase::conditions, read_deformable_to_rigid},
    {"DEFORMABLE_TO_RIGID_INERTIA", Phase::conditions, read_rigid_inertia},
};

} // namespace

std::span<const Translator> constrained_keywords()
{
    return constrained_table;
}

void finish_switched_parts(Reading& reading)
{
    Model& model = reading.model;
    std::vector<bool> set_free(model.parts.size());
    for (const Record& record : model.others) {
        if (record.keyword != "DEFORMABLE_TO_RIGID_AUTOMATIC") continue;
        for (const Table& table : record.tables) {
            if (table.columns.size() != 2) continue; // D2R cards
            for (std::size_t row = 0; row < table.rows(); ++row) {
                const Id id = static_cast<Id>(table.at(row, 0));
                const bool many = table.text[2 * row + 1] == "PSET";
                const Index found = reading.table(many ? Kind::part_set : Kind::part).find(id);
                if (found == none) continue; // named where the switches are made
                const std::vector<Index> one{found};
                for (Index part : many ? model.part_sets[found].parts : one) set_free[part] = true;
            }
        }
    }
    const auto switched = [&](BodyNumber body) {
        return body < static_cast<Index>(model.parts.size()) && set_free[body] &&
               model.parts[body].made_rigid;
    };
    std::erase_if(model.rigid_merges, [&](const RigidMerge& merge) { return switched(merge.follower); });
    for (std::size_t part = 0; part < set_free.size(); ++part)
        if (set_free[part]) model.parts[part].made_rigid = false;
}

void finish_nodal_rigid_bodies(Reading& reading)
{
    for (std::size_t i = 0; i < reading.pending_bodies.size(); ++i) {
        const PendingBody& pending = reading.pending_bodies[i];
        NodalRigidBody& body = reading.model.nodal_rigid_bodies[i];
        const Record& record = pending.record;
        const Index set = reading.find(record, "NSID", Kind::node_set);
        if (set != none) body.nodes = reading.model.node_sets[set].nodes;
        if (record.integer("NSID") == 0) reading.error(record, "NSID", "a nodal rigid body needs a node set");
        body.center_node = reading.find(record, "PNODE", Kind::node);
        for (std::string_view field : {"DRFLAG", "RRFLAG"})
            if (record.integer(field) != 0)
                reading.error(record, field, "released freedoms of nodal rigid bodies are not supported");
        if (pending.held) body.fixity = fixity_of(record, reading);
        if (pending.has_inertia) body.inertia = read_inertia(record, *pending.block, "CID2", reading);
    }
}

} // namespace plash

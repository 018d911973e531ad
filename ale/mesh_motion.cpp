#include "ale/mesh_motion.h"

#include "core/prescribed_rate.h"
#include "materials/parameters.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// The record of a keyword that a field of another one names.
const Record& named(const Model& model, const std::string& keyword, Id id, const Record& from,
                    const std::string& field)
{
    const auto found = std::find_if(model.others.begin(), model.others.end(), [&](const Record& record) {
        return record.keyword == keyword && record.integer("ID") == id;
    });
    if (found == model.others.end())
        reject_field(from, field, fmt::format("there is no *{} {}", keyword, id));
    return *found;
}

void set_curves(const Model& model, const Record& record, MeshMotion::Rule& rule)
{
    for (int number = 1; number <= 12; ++number) {
        const std::string field = fmt::format("LC{}", number);
        const Id curve = record.integer(field);
        if (curve == 0) continue;
        rule.curves[number - 1] = model.find_curve(curve);
        if (rule.curves[number - 1] == none)
            reject_field(record, field, fmt::format("there is no curve {}", curve));
    }
}

Index node_of_field(const Model& model, const Record& record, const std::string& field)
{
    const auto& ids = model.nodes.id;
    const auto found = std::find(ids.begin(), ids.end(), record.integer(field));
    if (found == ids.end())
        reject_field(record, field, fmt::format("there is no node {}", record.integer(field)));
    return static_cast<Index>(found - ids.begin());
}

/// NID1 up to the given number, as far as they are there.
void set_nodes(const Model& model, const Record& record, int most, MeshMotion::Rule& rule)
{
    for (int number = 1; number <= most; ++number) {
        const std::string field = fmt::format("NID{}", number);
        if (record.integer(field) != 0 || number == 1)
            rule.nodes.push_back(node_of_field(model, record, field));
    }
}

/// The first three nodes, which turn a mesh.
void set_turning(const Model& model, const Record& record, MeshMotion::Rule& rule)
{
    set_nodes(model, record, 3, rule);
    const auto& x = model.nodes.position;
    const bool spanned = rule.nodes.size() == 3 && norm(cross(x[rule.nodes[1]] - x[rule.nodes[0]],
                                                              x[rule.nodes[2]] - x[rule.nodes[0]])) > 0;
    if (!spanned)
        reject_field(record, "NID3", "a mesh that turns with its nodes wants three that span a plane");
}

void set_frame(const Model& model, const Record& group, const Record& record, MeshMotion::Rule& rule)
{
    const Id held = group.integer("BCROT");
    if (held == 7) {
        rule.kind = MeshMotion::Kind::node;
        set_nodes(model, record, 1, rule);
        return;
    }
    if (held != 0)
        reject_field(group, "BCROT",
                     fmt::format("{} would let the mesh turn about some axes only; there are 0 with its "
                                 "nodes and 7 not at all",
                                 held));
    rule.kind = MeshMotion::Kind::frame;
    set_turning(model, record, rule);
}

/// Nodes of the system that BCTRAN names, the centre, and those of the parts of PRID.
void set_enclosing(const Model& model, const Record& group, MeshMotion::Rule& rule)
{
    for (const char* field : {"EXPLIM", "FRCPAD", "IEXPND", "BCROT"})
        if (group.real(field) != 0)
            reject_field(
                group, field,
                "what it limits with PRTYPE 9 is not known well enough; there the mesh turns with its "
                "system of nodes and is always stretched as its parts reach from the centre");
    rule.kind = MeshMotion::Kind::enclosing;
    set_turning(model, named(model, "ALE_REFERENCE_SYSTEM_NODE", group.integer("BCTRAN"), group, "BCTRAN"),
                rule);
    rule.nodes.push_back(node_of_field(model, group, "ICOORD"));
    std::vector<bool> enclosed(model.parts.size()), own(model.nodes.size());
    for (const Index part : parts_of_fields(model, group, "PRID", "")) enclosed[part] = true;
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t element = 0; element < elements.size(); ++element) {
            if (!enclosed[elements.part[element]]) continue;
            for (const Index node : elements.nodes[element])
                if (node != none) own[node] = true;
        }
    });
    for (std::size_t node = 0; node < own.size(); ++node)
        if (own[node]) rule.nodes.push_back(static_cast<Index>(node));
    if (rule.nodes.size() == 4) reject_field(group, "PRID", "the parts to enclose have no nodes");
}

/// type_field, id_field  of `record`, which say how the mesh moves and by what
MeshMotion::Rule rule_of(const Model& model, const Record& group, const Record& record,
                         const std::string& type_field, const std::string& id_field)
{
    MeshMotion::Rule rule;
    const Id type = record.integer(type_field);
    const auto by = [&](const char* keyword) -> const Record& {
        return named(model, keyword, record.integer(id_field), record, id_field);
    };
    switch (type) {
    case 0:
        break;
    case 1:
        rule.kind = MeshMotion::Kind::material;
        break;
    case 2:
        rule.kind = MeshMotion::Kind::smoothed;
        break;
    case 8:
        rule.kind = MeshMotion::Kind::delayed;
        break;
    case 3:
        rule.kind = MeshMotion::Kind::curves;
        set_curves(model, by("ALE_REFERENCE_SYSTEM_CURVE"), rule);
        break;
    case 4:
        rule.kind = MeshMotion::Kind::average;
        break;
    case 5:
        set_frame(model, group, by("ALE_REFERENCE_SYSTEM_NODE"), rule);
        break;
    case 7:
        rule.kind = MeshMotion::Kind::extent;
        set_nodes(model, by("ALE_REFERENCE_SYSTEM_NODE"), 12, rule);
        break;
    case 9:
        if (&record != &group)
            reject_field(record, type_field,
                         "9 is not supported in a list: BCTRAN of the group would name nodes and hold axes");
        set_enclosing(model, group, rule);
        break;
    default:
        reject_field(
            record, type_field,
            fmt::format("{} is not supported; there are 0 no motion, 1 with the material, 2 smoothed, "
                        "3 by curves, 4 with the mean velocity of the fluid, 5 with nodes, 7 as the "
                        "box around nodes, 8 delayed, 9 around parts, and 6 of these one after the other",
                        type));
    }
    return rule;
}

/// TYPE1 until T1, TYPE2 until T2 and so on; the first T that does not rise ends the list.
void set_switch(const Model& model, const Record& group, MeshMotion& motion)
{
    const Record& record = named(model, "ALE_REFERENCE_SYSTEM_SWITCH", group.integer("PRID"), group, "PRID");
    for (int number = 1; number <= 8; ++number) {
        motion.rules.push_back(
            rule_of(model, group, record, fmt::format("TYPE{}", number), fmt::format("ID{}", number)));
        if (number == 8) break;
        const double time = record.real(fmt::format("T{}", number));
        if (!(time > (motion.until.empty() ? 0 : motion.until.back()))) break;
        motion.until.push_back(time);
    }
}

/// Axes that a constraint code holds, bits 1, 2, 4.
unsigned constraint(const Record& record, const std::string& field)
{
    constexpr unsigned held[] = {0, 1, 2, 4, 3, 6, 5, 7}; // x, y, z, xy, yz, zx, xyz
    const Id code = record.integer(field);
    if (code < 0 || code > 7)
        reject_field(record, field, fmt::format("{} is not a constraint code from 0 to 7", code));
    return held[code];
}

bool moves(const Model& model, const Record& group, const MeshBlock& block)
{
    const Id type = group.integer("STYPE");
    if (type > 1)
        reject_field(group, "STYPE", fmt::format("{} is not supported; there are 0 part set, 1 part", type));
    const std::vector<Index> parts = parts_of_fields(model, group, "SID", "STYPE");
    return std::any_of(block.solids.begin(), block.solids.end(), [&](Index solid) {
        return std::find(parts.begin(), parts.end(), model.solids.part[solid]) != parts.end();
    });
}

/// Of the mass of some fluids, where a node has an eighth of each of its cells.
std::array<double, 3> mean_velocity(const Fluid& fluid, unsigned fluids)
{
    std::array<double, 3> sum{};
    double total = 0;
    for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
        const FluidCell cell = fluid.cell(number);
        double mass = 0;
        for (std::size_t group = 0; group < fluid.groups.size(); ++group)
            if (fluids >> group & 1) mass += fluid.fields.groups[group].mass[cell.place];
        if (mass == 0) continue;
        total += mass;
        for (const std::ptrdiff_t node : cell.corners)
            for (int axis = 0; axis < 3; ++axis)
                sum[axis] += 0.125 * mass * fluid.fields.velocity[axis][node];
    }
    for (double& component : sum) component = total > 0 ? component / total : 0;
    return sum;
}

/// The part of a structured mesh; none: there is no such mesh.
Index part_of_mesh(const Model& model, Id mesh)
{
    for (const Record& record : model.others)
        if (record.keyword == "ALE_STRUCTURED_MESH" && record.integer("MSHID") == mesh)
            return find_part(model, record.integer("DPID"));
    return none;
}

/// *ALE_STRUCTURED_MESH_MOTION, FOLLOW_GC: with the centre of mass of the groups of AMMGSID. Symmetry planes
/// (the digits of ISYM) stay where they are.
void follow_centre(const Model& model, const Record& record, const MeshBlock& block, const DeckGroups& groups,
                   MeshMotion& motion)
{
    const Index part = part_of_mesh(model, record.integer("MSHID"));
    if (part == none)
        reject_field(record, "MSHID",
                     fmt::format("there is no *ALE_STRUCTURED_MESH {}", record.integer("MSHID")));
    const bool own = std::any_of(block.solids.begin(), block.solids.end(),
                                 [&](Index solid) { return model.solids.part[solid] == part; });
    if (!own) return;
    const std::string_view option = record.text("OPTION");
    if (!option.empty() && option != "FOLLOW_GC")
        reject_field(record, "OPTION", fmt::format("{} is not supported; there is FOLLOW_GC", option));
    motion = {};
    MeshMotion::Rule rule;
    rule.kind = MeshMotion::Kind::average;
    if (const Id set = record.integer("AMMGSID"); set != 0)
        rule.fluids = fluids_of_set(model, record, "AMMGSID", set, groups);
    motion.rules.push_back(rule);
    Id planes = record.integer("ISYM");
    for (int axis = 2; axis >= 0; --axis, planes /= 10)
        if (planes % 10 != 0) motion.held |= 1u << axis;
    if (motion.held != 0 && !block.is_box())
        reject_field(record, "ISYM", "the planes of the mesh do not stand across the global axes");
}

bool has(const MeshMotion& motion, MeshMotion::Kind kind)
{
    return std::any_of(motion.rules.begin(), motion.rules.end(),
                       [kind](const MeshMotion::Rule& rule) { return rule.kind == kind; });
}

void set_delay(const Record& record, MeshMotion& motion)
{
    motion.back = record.real("EFAC");
    if (!(motion.back > 0 && motion.back <= 1))
        reject_field(
            record, "EFAC",
            fmt::format("{:g} is no share above 0 and up to 1, of the way that nodes go back to their "
                        "places of the start in a step; for 0 there is PRTYPE 1",
                        motion.back));
}

} // namespace

bool MeshMotion::moves() const
{
    return std::any_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.kind != Kind::none; });
}

bool MeshMotion::deforms() const
{
    return std::any_of(rules.begin(), rules.end(), [](const Rule& rule) {
        if (rule.follows() || rule.kind == Kind::frame || rule.kind == Kind::extent ||
            rule.kind == Kind::enclosing)
            return true;
        for (int number = 0; number < 12; ++number)
            if (number % 4 != 0 && rule.curves[number] != none) return true;
        return false;
    });
}

bool MeshMotion::follows() const
{
    return std::any_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.follows(); });
}

bool MeshMotion::only_follows() const
{
    return follows() && std::all_of(rules.begin(), rules.end(), [](const Rule& rule) {
               return rule.follows() || rule.kind == Kind::none;
           });
}

bool MeshMotion::smooths() const
{
    return has(*this, Kind::smoothed);
}

std::size_t MeshMotion::rule_number(double time) const
{
    return std::upper_bound(until.begin(), until.end(), time) - until.begin();
}

std::array<double, 3> MeshMotion::velocity(const Model& model, const Fluid& fluid,
                                           const std::vector<Vec3>& nodes, double time) const
{
    const Rule& rule = rules[rule_number(time)];
    std::array<double, 3> result{};
    double mass = 0;
    switch (rule.kind) {
    case Kind::curves:
        for (int axis = 0; axis < 3; ++axis)
            if (const Index curve = rule.curves[4 * axis]; curve != none)
                result[axis] = curve_value(model, curve, time);
        break;
    case Kind::average:
        if (rule.fluids != ~0u) {
            result = mean_velocity(fluid, rule.fluids);
            break;
        }
        for (int group = 0; group < static_cast<int>(fluid.groups.size()); ++group)
            mass += fluid.total_mass(group);
        if (!(mass > 0)) break;
        result = fluid.momentum();
        for (double& component : result) component /= mass;
        break;
    case Kind::node:
        result = {nodes[rule.nodes[0]].x, nodes[rule.nodes[0]].y, nodes[rule.nodes[0]].z};
        break;
    case Kind::none:
    case Kind::material:
    case Kind::smoothed:
    case Kind::delayed:
    case Kind::frame:
    case Kind::extent:
    case Kind::enclosing:
        break;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (held & (1u << axis)) result[axis] = 0;
    return result;
}

MeshMotion mesh_motion_of(const Model& model, const MeshBlock& block, const DeckGroups& groups)
{
    MeshMotion motion;
    for (const Record& record : model.others) {
        if (record.keyword == "ALE_STRUCTURED_MESH_MOTION")
            follow_centre(model, record, block, groups, motion);
        if (record.keyword != "ALE_REFERENCE_SYSTEM_GROUP" || !moves(model, record, block)) continue;
        motion = {};
        if (record.integer("PRTYPE") == 6)
            set_switch(model, record, motion);
        else
            motion.rules.push_back(rule_of(model, record, record, "PRTYPE", "PRID"));
        const bool encloses = has(motion, MeshMotion::Kind::enclosing);
        if (!encloses) motion.held = constraint(record, "BCTRAN");
        motion.idle_centre = !encloses && record.integer("ICOORD") != 0;
        if (encloses || has(motion, MeshMotion::Kind::extent)) motion.stiff = constraint(record, "BCEXP");
        if (has(motion, MeshMotion::Kind::delayed))
            set_delay(record, motion);
        else
            motion.idle_back = record.real("EFAC") != 0;
        if (motion.deforms()) motion.centre = {record.real("XC"), record.real("YC"), record.real("ZC")};
    }
    return motion;
}

} // namespace plash

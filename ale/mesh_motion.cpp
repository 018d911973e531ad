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

/// Curves f1 .. f12 of x' = f1 + f2 x + f3 y + f4 z and so on; only f1, f5, f9 may be there.
void set_curves(const Model& model, const Record& record, MeshMotion::Rule& rule)
{
    for (int number = 1; number <= 12; ++number) {
        const std::string field = fmt::format("LC{}", number);
        const Id curve = record.integer(field);
        if (curve == 0) continue;
        if (number % 4 != 1)
            reject_field(record, field, "a mesh can be moved, but not scaled or sheared; leave it empty");
        rule.curves[number / 4] = model.find_curve(curve);
    }
}

/// The origin of the system that NID1 to NID3 span; the mesh does not turn with it.
void set_node(const Model& model, const Record& record, MeshMotion::Rule& rule)
{
    const Id id = record.integer("NID1");
    const auto& ids = model.nodes.id;
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end()) reject_field(record, "NID1", fmt::format("there is no node {}", id));
    rule.node = static_cast<Index>(found - ids.begin());
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
    case 3:
        rule.kind = MeshMotion::Kind::curves;
        set_curves(model, by("ALE_REFERENCE_SYSTEM_CURVE"), rule);
        break;
    case 4:
        rule.kind = MeshMotion::Kind::average;
        break;
    case 5:
        rule.kind = MeshMotion::Kind::node;
        if (group.integer("BCROT") != 7)
            reject_field(group, "BCROT",
                         "a mesh is moved with the nodes of its reference system, but not turned; 7 says so");
        set_node(model, by("ALE_REFERENCE_SYSTEM_NODE"), rule);
        break;
    default:
        reject_field(record, type_field,
                     fmt::format("{} is not supported; there are 0 no motion, 3 by curves, 4 with the mean "
                                 "velocity of the fluid, 5 with a node, and 6 of these one after the other",
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

} // namespace

bool MeshMotion::moves() const
{
    return std::any_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.kind != Kind::none; });
}

std::array<double, 3> MeshMotion::velocity(const Model& model, const Fluid& fluid,
                                           const std::vector<Vec3>& nodes, double time) const
{
    const Rule& rule = rules[std::upper_bound(until.begin(), until.end(), time) - until.begin()];
    std::array<double, 3> result{};
    double mass = 0;
    switch (rule.kind) {
    case Kind::none:
        break;
    case Kind::curves:
        for (int axis = 0; axis < 3; ++axis)
            if (rule.curves[axis] != none) result[axis] = curve_value(model, rule.curves[axis], time);
        break;
    case Kind::average:
        for (int group = 0; group < static_cast<int>(fluid.groups.size()); ++group)
            mass += fluid.total_mass(group);
        if (!(mass > 0)) break;
        result = fluid.momentum();
        for (double& component : result) component /= mass;
        break;
    case Kind::node:
        result = {nodes[rule.node].x, nodes[rule.node].y, nodes[rule.node].z};
        break;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (held & (1u << axis)) result[axis] = 0;
    return result;
}

MeshMotion mesh_motion_of(const Model& model, const MeshBlock& block)
{
    MeshMotion motion;
    for (const Record& record : model.others) {
        if (record.keyword != "ALE_REFERENCE_SYSTEM_GROUP" || !moves(model, record, block)) continue;
        motion = {};
        if (record.integer("PRTYPE") == 6)
            set_switch(model, record, motion);
        else
            motion.rules.push_back(rule_of(model, record, record, "PRTYPE", "PRID"));
        constexpr unsigned held[] = {0, 1, 2, 4, 3, 6, 5, 7}; // x, y, z, xy, yz, zx, xyz
        const Id code = record.integer("BCTRAN");
        if (code < 0 || code > 7)
            reject_field(record, "BCTRAN", fmt::format("{} is not a constraint code from 0 to 7", code));
        motion.held = held[code];
    }
    return motion;
}

} // namespace plash

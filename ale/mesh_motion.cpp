#include "ale/mesh_motion.h"

#include "core/prescribed_rate.h"
#include "materials/parameters.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Curves f1 .. f12 of x' = f1 + f2 x + f3 y + f4 z and so on; only f1, f5, f9 may be there.
void set_curves(const Model& model, const Record& group, MeshMotion& motion)
{
    const Id id = group.integer("PRID");
    const auto found = std::find_if(model.others.begin(), model.others.end(), [&](const Record& record) {
        return record.keyword == "ALE_REFERENCE_SYSTEM_CURVE" && record.integer("ID") == id;
    });
    if (found == model.others.end())
        reject_field(group, "PRID", fmt::format("there is no *ALE_REFERENCE_SYSTEM_CURVE {}", id));
    for (int number = 1; number <= 12; ++number) {
        const std::string field = fmt::format("LC{}", number);
        const Id curve = found->integer(field);
        if (curve == 0) continue;
        if (number % 4 != 1)
            reject_field(*found, field, "a mesh can be moved, but not scaled or sheared; leave it empty");
        motion.curves[number / 4] = model.find_curve(curve);
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

std::array<double, 3> MeshMotion::velocity(const Model& model, const Fluid& fluid, double time) const
{
    std::array<double, 3> result{};
    if (kind == Kind::none) return result;
    double mass = 0;
    if (kind == Kind::average) {
        for (int group = 0; group < static_cast<int>(fluid.groups.size()); ++group)
            mass += fluid.total_mass(group);
        if (mass > 0) result = fluid.momentum();
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (kind == Kind::curves)
            result[axis] = curves[axis] == none ? 0 : curve_value(model, curves[axis], time);
        else if (mass > 0)
            result[axis] /= mass;
        if (held & (1u << axis)) result[axis] = 0;
    }
    return result;
}

MeshMotion mesh_motion_of(const Model& model, const MeshBlock& block)
{
    MeshMotion motion;
    for (const Record& record : model.others) {
        if (record.keyword != "ALE_REFERENCE_SYSTEM_GROUP" || !moves(model, record, block)) continue;
        motion = {};
        const Id type = record.integer("PRTYPE");
        switch (type) {
        case 0:
            break;
        case 3:
            motion.kind = MeshMotion::Kind::curves;
            set_curves(model, record, motion);
            break;
        case 4:
            motion.kind = MeshMotion::Kind::average;
            break;
        default:
            reject_field(
                record, "PRTYPE",
                fmt::format("{} is not supported yet; there are 0 no motion, 3 by curves, 4 with the "
                            "mean velocity of the fluid",
                            type));
        }
        constexpr unsigned held[] = {0, 1, 2, 4, 3, 6, 5, 7}; // x, y, z, xy, yz, zx, xyz
        const Id code = record.integer("BCTRAN");
        if (code < 0 || code > 7)
            reject_field(record, "BCTRAN", fmt::format("{} is not a constraint code from 0 to 7", code));
        motion.held = held[code];
    }
    return motion;
}

} // namespace plash

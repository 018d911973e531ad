// *PART in all its forms: which section, material, equation of state and hourglass control its elements have.

#include "parser/reading.h"

#include <fmt/format.h>

namespace plash {
namespace {

Part new_part(const Record& record, Reading& reading)
{
    Part part;
    part.id = record.integer("PID");
    part.title = record.title;
    part.where = record.where;
    part.section = reading.find(record, "SECID", Kind::section);
    part.material = reading.find(record, "MID", Kind::material);
    const Index index = static_cast<Index>(reading.model.parts.size());
    if (record.peek("SECID") && record.integer("SECID") == 0) reading.parts_without_section.push_back(index);
    if (record.peek("MID") && record.integer("MID") == 0) reading.parts_without_material.push_back(index);
    part.equation_of_state = reading.find(record, "EOSID", Kind::eos);
    part.hourglass = reading.find(record, "HGID", Kind::hourglass);
    return part;
}

void read_part(const Record& record, const Block&, Reading& reading)
{
    reading.model.parts.push_back(new_part(record, reading));
}

void read_part_inertia(const Record& record, const Block& block, Reading& reading)
{
    const PartInertia inertia = read_inertia(record, block, "CID", reading);
    reading.model.parts.push_back(new_part(record, reading));
    reading.model.part_inertias[static_cast<Index>(reading.model.parts.size()) - 1] = inertia;
}

void read_part_contact(const Record& record, const Block&, Reading& reading)
{
    PartContact contact;
    contact.static_friction = record.real("FS");
    contact.dynamic_friction = record.real("FD");
    contact.friction_decay = record.real("DC");
    contact.friction_stress = record.real("VC");
    contact.thickness = record.real("OPTT");
    contact.thickness_scale = record.real("SFT");
    contact.stiffness_scale = record.real("SSF");
    for (double* scale : {&contact.thickness_scale, &contact.stiffness_scale})
        if (*scale == 0) *scale = 1;
    reading.model.parts.push_back(new_part(record, reading));
    reading.model.part_contacts[static_cast<Index>(reading.model.parts.size()) - 1] = contact;
}

/// Two plies to a line, bottom first; a ply without material and thickness is not there.
void read_part_composite(const Record& record, const Block&, Reading& reading)
{
    Part part = new_part(record, reading);
    part.composite = static_cast<Index>(reading.model.others.size());
    reading.model.others.push_back(record);
    if (const Table* plies = record.table("MID1")) {
        for (std::size_t row = 0; row < plies->rows(); ++row) {
            for (std::size_t column = 0; column + 2 < plies->columns.size(); ++column) {
                if (!plies->columns[column].starts_with("MID")) continue;
                Layer layer;
                layer.material = reading.look_up(Kind::material, static_cast<Id>(plies->at(row, column)));
                layer.thickness = plies->at(row, column + 1);
                layer.angle = plies->at(row, column + 2);
                if (plies->at(row, column) != 0 && layer.thickness != 0) part.layers.push_back(layer);
            }
        }
    }
    if (part.layers.empty()) reading.error(record, "MID1", fmt::format("part {} has no layers", part.id));
    reading.model.parts.push_back(std::move(part));
}

constexpr Translator part_table[] = {
    {"PART", Phase::parts, read_part},
    {"PART_AVERAGED", Phase::parts, read_part},
    {"PART_INERTIA", Phase::parts, read_part_inertia},
    {"PART_CONTACT", Phase::parts, read_part_contact},
    {"PART_COMPOSITE", Phase::parts, read_part_composite},
    {"PART_COMPOSITE_TSHELL", Phase::parts, read_part_composite},
};

} // namespace

std::span<const Translator> part_keywords()
{
    return part_table;
}

PartInertia read_inertia(const Record& record, const Block& block, std::string_view system_field,
                         Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    PartInertia inertia;
    inertia.where = record.where;
    inertia.mass = record.real("TM");
    inertia.center = motion.point(vector_of(record, "XC", "YC", "ZC"));
    if (record.peek("NODEID")) inertia.center_node = reading.find(record, "NODEID", Kind::node);
    inertia.xx = record.real("IXX");
    inertia.xy = record.real("IXY");
    inertia.xz = record.real("IXZ");
    inertia.yy = record.real("IYY");
    inertia.yz = record.real("IYZ");
    inertia.zz = record.real("IZZ");
    if (record.peek("VTX")) {
        inertia.velocity = motion.direction(vector_of(record, "VTX", "VTY", "VTZ"));
        inertia.angular_velocity = motion.direction(vector_of(record, "VRX", "VRY", "VRZ"));
    }
    if (record.peek("IRCS") && record.integer("IRCS") == 1) {
        const Index system =
            record.peek(system_field) ? reading.find(record, system_field, Kind::coordinate) : none;
        if (system != none) {
            inertia.axes = reading.model.coordinate_systems[system].axes;
            return inertia;
        }
        const Vec3 x = unit(vector_of(record, "XL", "YL", "ZL"));
        const Vec3 z = unit(cross(x, vector_of(record, "XLIP", "YLIP", "ZLIP")));
        if (norm(z) < 0.5) reading.error(record, "XL", "the axes of the inertia tensor lie on one line");
        inertia.axes = {x, cross(z, x), z};
    }
    for (Vec3& axis : inertia.axes) axis = motion.direction(axis);
    return inertia;
}

} // namespace plash

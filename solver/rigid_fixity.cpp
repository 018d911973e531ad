#include "solver/rigid_fixity.h"

#include <fmt/format.h>

namespace plash {

namespace {

[[noreturn]] void reject(const Record& material, std::string_view field, const std::string& text)
{
    throw DeckError(material.where, fmt::format("*{}, field {}: {}", material.keyword, field, text));
}

/// Freedoms of the code that CON1 and CON2 share: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz.
FreedomMask freedoms_of_code(const Record& material, std::string_view field)
{
    constexpr FreedomMask masks[8] = {0, 1, 2, 4, 3, 6, 5, 7};
    const Id code = material.integer(field);
    if (code < 0 || code > 7)
        reject(material, field, fmt::format("{} is not a constraint code from 0 to 7", code));
    return masks[code];
}

const CoordinateSystem& system_of(const Model& model, const Record& material, std::string_view field)
{
    const Id id = material.integer(field);
    for (const CoordinateSystem& system : model.coordinate_systems)
        if (system.id == id) return system;
    reject(material, field, fmt::format("there is no coordinate system {}", id));
}

} // namespace

BodyFixity fixity_of_part(const Model& model, Index part)
{
    const Record& material = model.materials[model.parts[part].material];
    BodyFixity fixity;
    if (material.keyword != "MAT_RIGID") return fixity; // *DEFORMABLE_TO_RIGID
    const double option = material.real("CMO");
    if (option == 0) return fixity;
    if (option > 0) {
        fixity.freedoms = freedoms_of_code(material, "CON1") | freedoms_of_code(material, "CON2") << 3;
        return fixity;
    }
    if (material.integer("CON1") != 0) fixity.axes = system_of(model, material, "CON1").axes;
    const Id digits = material.integer("CON2");
    Id rest = digits;
    for (int freedom = 5; freedom >= 0; --freedom, rest /= 10) {
        if (rest % 10 > 1)
            reject(material, "CON2", fmt::format("{} has figures that are not 0 or 1", digits));
        if (rest % 10 == 1) fixity.freedoms |= 1u << freedom;
    }
    if (rest != 0 || digits < 0)
        reject(material, "CON2", fmt::format("{} has more than six figures", digits));
    return fixity;
}

std::array<Vec3, 3> local_axes_of_part(const Model& model, Index part)
{
    const Record& material = model.materials[model.parts[part].material];
    const std::array<Vec3, 3> global = CoordinateSystem{}.axes;
    if (material.keyword != "MAT_RIGID") return global;
    const Vec3 a{material.real("LCO_OR_A1"), material.real("A2"), material.real("A3")};
    const Vec3 v{material.real("V1"), material.real("V2"), material.real("V3")};
    if (a.x != 0 && a.y == 0 && a.z == 0 && dot(v, v) == 0)
        return system_of(model, material, "LCO_OR_A1").axes;
    if (dot(a, a) == 0) return global;
    const Vec3 x = unit(a), z = unit(cross(x, v));
    if (norm(z) < 0.5) reject(material, "V1", "the vectors A and V lie on one line");
    return {x, cross(z, x), z};
}

} // namespace plash

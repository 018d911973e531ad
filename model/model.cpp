#include "model/model.h"

#include <fmt/format.h>

namespace plash {

std::string Model::place(const Location& where) const
{
    if (where.file < 0 || where.file >= static_cast<int>(files.size())) return {};
    return fmt::format("{}:{}", files[where.file], where.line);
}

Index Model::find_curve(Id id) const
{
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (curves[i].id == id) return static_cast<Index>(i);
    return none;
}

Index Model::find_table(Id id) const
{
    for (std::size_t i = 0; i < tables.size(); ++i)
        if (tables[i].id == id) return static_cast<Index>(i);
    return none;
}

bool Model::is_rigid(Index part) const
{
    if (parts[part].made_rigid) return true;
    const Index material = parts[part].material;
    return material != none && materials[material].keyword == "MAT_RIGID";
}

Id Model::body_id(BodyNumber body) const
{
    const Index part_count = static_cast<Index>(parts.size());
    return body < part_count ? parts[body].id : nodal_rigid_bodies[body - part_count].id;
}

const std::string& Model::body_title(BodyNumber body) const
{
    const Index part_count = static_cast<Index>(parts.size());
    return body < part_count ? parts[body].title : nodal_rigid_bodies[body - part_count].title;
}

} // namespace plash

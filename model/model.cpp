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

} // namespace plash

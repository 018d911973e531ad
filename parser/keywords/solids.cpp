// *ELEMENT_SOLID in both formats, its _ORTHO form and ten-node tetrahedra.

#include "parser/large_pages.h"
#include "parser/number.h"
#include "parser/number_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace plash {
namespace {

/// Everything on one line (number, part, eight nodes), or number and part on one and up to ten nodes on the
/// next.
class SolidReader {
public:
    SolidReader(const Block& block, Reading& reading)
        : block_(block),
          reading_(reading),
          cursor_(block.text, block.where.line + 1),
          whole_(block, reading, block.keyword.layout->cards[1].fields),
          nodes_(block, reading, block.keyword.layout->cards[0].group[1].fields),
          axis_(block, reading, {real_field(), real_field(), real_field(), real_field()}),
          ids_(block, reading),
          orthotropic_(block.keyword.name == "ELEMENT_SOLID_ORTHO")
    {}

    void run()
    {
        SolidElements& solids = reading_.model.solids;
        solids.id.reserve(solids.size() + block_.lines);
        solids.part.reserve(solids.id.capacity());
        solids.nodes.reserve(solids.id.capacity());
        use_large_pages(solids.id);
        use_large_pages(solids.part);
        use_large_pages(solids.nodes);
        if (orthotropic_) solids.axes.resize(solids.size());
        TextRelease release(*reading_.deck.files[block_.where.file], block_.text);
        std::string_view line;
        while (cursor_.next_data(line)) {
            release.up_to(line.data());
            if (!trimmed(line).empty()) read_element(line);
        }
        if (!solids.axes.empty()) solids.axes.resize(solids.size());
        if (!solids.ten_nodes.empty()) solids.ten_nodes.resize(solids.size(), none);
    }

private:
    static FieldLayout real_field()
    {
        FieldLayout field;
        field.name = "A1";
        field.width = 16;
        return field;
    }

    void read_element(std::string_view line)
    {
        const int number = cursor_.line();
        const bool fine = whole_.read(line, number);
        ++reading_.report.elements.solid;
        const Id id = whole_.id(0);
        std::array<Index, 8> corners{};
        bool two_lines = fine, ten = false, found = fine;
        for (std::size_t column = 2; column < 10; ++column) two_lines = two_lines && whole_.id(column) == 0;
        if (two_lines) {
            if (!cursor_.next_data(line)) {
                reading_.report.error({block_.where.file, number}, block_.keyword.name, "N1",
                                      fmt::format("element {} has no line of nodes", id));
                return;
            }
            found = nodes_.read(line, cursor_.line());
            ten = found && (nodes_.id(8) != 0 || nodes_.id(9) != 0);
        }
        MaterialAxes axes;
        if (orthotropic_ && !read_axes(axes, id, number)) return;
        if (!found || !ids_.is_number(id, number)) return;
        const Index part = ids_.find_part(whole_.id(1), id, number);
        if (ten && !keep_tetrahedron(id, part)) return;
        found = ten         ? corners_of_last(corners)
                : two_lines ? ids_.find_nodes(nodes_, 0, id, cursor_.line(), corners)
                            : ids_.find_nodes(whole_, 2, id, number, corners);
        if (part == none || !found) return;
        SolidElements& solids = reading_.model.solids;
        solids.id.push_back(id);
        solids.part.push_back(part);
        solids.nodes.push_back(corners);
        if (ten) {
            solids.ten_nodes.resize(solids.size(), none);
            solids.ten_nodes.back() = static_cast<Index>(reading_.model.tetrahedra.size()) - 1;
        }
        if (orthotropic_) solids.axes.push_back(axes);
    }

    bool keep_tetrahedron(Id id, Index part)
    {
        std::array<Index, 10> nodes{};
        if (!ids_.find_nodes(nodes_, 0, id, cursor_.line(), nodes) || part == none) return false;
        TetrahedronElements& tetrahedra = reading_.model.tetrahedra;
        tetrahedra.id.push_back(id);
        tetrahedra.part.push_back(part);
        tetrahedra.nodes.push_back(nodes);
        return true;
    }

    bool corners_of_last(std::array<Index, 8>& corners) const
    {
        const std::array<Index, 10>& nodes = reading_.model.tetrahedra.nodes.back();
        for (int i = 0; i < 8; ++i) corners[i] = nodes[std::min(i, 3)];
        return true;
    }

    bool read_axes(MaterialAxes& axes, Id id, int number)
    {
        for (Vec3* axis : {&axes.a, &axes.d}) {
            std::string_view line;
            if (!cursor_.next_data(line)) {
                reading_.report.error({block_.where.file, number}, block_.keyword.name, "A1",
                                      fmt::format("element {} has no lines of material axes", id));
                return false;
            }
            if (!axis_.read(line, cursor_.line())) return false;
            *axis = {axis_.real(0), axis_.real(1), axis_.real(2)};
        }
        return true;
    }

    const Block& block_;
    Reading& reading_;
    LineCursor cursor_;
    NumberLine whole_, nodes_, axis_;
    ElementIds ids_;
    bool orthotropic_;
};

void read_solids(const Block& block, Reading& reading)
{
    SolidReader(block, reading).run();
}

constexpr Translator solids_table[] = {
    {"ELEMENT_SOLID", Phase::elements, nullptr, read_solids},
    {"ELEMENT_SOLID_ORTHO", Phase::elements, nullptr, read_solids},
    {"ELEMENT_SOLID_H8TOH20", Phase::elements, nullptr, read_solids},
    {"ELEMENT_SOLID_H8TOH27", Phase::elements, nullptr, read_solids},
    {"ELEMENT_SOLID_TET4TOTET10", Phase::elements, nullptr, read_solids},
    {"ELEMENT_SOLID_T4TOT10", Phase::elements, nullptr, read_solids},
};

} // namespace

std::span<const Translator> solid_keywords()
{
    return solids_table;
}

} // namespace plash

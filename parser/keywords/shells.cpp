// *ELEMENT_SHELL with all its options, and *ELEMENT_TSHELL: the lines after the first are told by the layout.

#include "parser/large_pages.h"
#include "parser/number.h"
#include "parser/number_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace plash {
namespace {

/// One more line of each element: which of its columns mean what.
struct ExtraLine {
    NumberLine numbers;
    bool only_with_mid_nodes;
    int thickness = none, angle = none, system = none, offset = none; ///< columns
};

/// The lines of an element's own layers, one or two to a line (MID, THICK, B, not used).
class LayerLines {
public:
    LayerLines(const Block& block, Reading& reading, const CardLayout& card)
        : block_(block), reading_(reading), numbers_(block, reading, card.fields)
    {
        for (std::size_t i = 0; i < card.fields.size(); ++i)
            if (card.fields[i].name.starts_with("MID")) columns_.push_back(i);
    }

    /// Layers go on until a line that can only be an element: whole numbers without a point.
    std::vector<Layer> read(LineCursor& cursor)
    {
        std::vector<Layer> layers;
        std::string_view line;
        for (LineCursor ahead = cursor; ahead.next_data(line); cursor = ahead) {
            if (trimmed(line).empty()) continue;
            if (line.find_first_of(".eE") == std::string_view::npos) break;
            if (!numbers_.read(line, ahead.line())) continue;
            for (const std::size_t column : columns_) {
                const Id material = numbers_.id(column);
                if (material == 0) continue;
                Layer layer{reading_.look_up(Kind::material, material), numbers_.real(column + 1),
                            numbers_.real(column + 2)};
                if (layer.material == none)
                    reading_.report.error({block_.where.file, ahead.line()}, block_.keyword.name,
                                          fmt::format("MID{}", column == 0 ? 1 : 2),
                                          fmt::format("there is no material {}", material));
                layers.push_back(layer);
            }
        }
        return layers;
    }

private:
    const Block& block_;
    Reading& reading_;
    NumberLine numbers_;
    std::vector<std::size_t> columns_; ///< of the materials
};

class ShellReader {
public:
    ShellReader(const Block& block, Reading& reading)
        : block_(block),
          reading_(reading),
          cursor_(block.text, block.where.line + 1),
          first_(block, reading, block.keyword.layout->cards[0].fields),
          ids_(block, reading)
    {
        for (const CardLayout& card : block.keyword.layout->cards) {
            if (&card == &block.keyword.layout->cards.front()) continue;
            if (card.repeat == CardLayout::Repeat::rows) {
                layers_.emplace(block, reading, card);
                continue;
            }
            ExtraLine extra{NumberLine(block, reading, card.fields), !card.condition.empty()};
            for (std::size_t i = 0; i < card.fields.size(); ++i) {
                const std::string& name = card.fields[i].name;
                if (name == "THIC1") extra.thickness = static_cast<int>(i);
                if (name == "BETA" || name == "PSI") extra.angle = static_cast<int>(i);
                if (name == "MCID") extra.system = static_cast<int>(i);
                if (name == "OFFSET") extra.offset = static_cast<int>(i);
            }
            extra_lines_.push_back(std::move(extra));
        }
    }

    void run()
    {
        ShellElements& shells = reading_.model.shells;
        const std::size_t expected = shells.size() + block_.lines / (1 + extra_lines_.size());
        shells.id.reserve(expected);
        shells.part.reserve(expected);
        shells.nodes.reserve(expected);
        use_large_pages(shells.id);
        use_large_pages(shells.part);
        use_large_pages(shells.nodes);
        TextRelease release(*reading_.deck.files[block_.where.file], block_.text);
        std::string_view line;
        while (cursor_.next_data(line)) {
            release.up_to(line.data());
            if (!trimmed(line).empty()) read_element(line);
        }
        for (auto* list : {&shells.material_angle, &shells.offset})
            if (!list->empty()) list->resize(shells.size());
        if (!shells.thickness.empty()) shells.thickness.resize(shells.size());
        if (!shells.layers.empty()) shells.layers.resize(shells.size());
        if (!shells.material_system.empty()) shells.material_system.resize(shells.size(), none);
        if (!shells.mid_nodes.empty()) shells.mid_nodes.resize(shells.size(), {none, none, none, none});
    }

private:
    void read_element(std::string_view line)
    {
        const int number = cursor_.line();
        bool fine = first_.read(line, number);
        ++reading_.report.elements.shell;
        const Id id = first_.id(0);
        const bool has_mid_nodes = fine && first_.id(6) + first_.id(7) + first_.id(8) + first_.id(9) != 0;
        std::array<double, 4> thickness{};
        double angle = 0, offset = 0;
        Index system = none;
        for (ExtraLine& extra : extra_lines_) {
            if (extra.only_with_mid_nodes && !has_mid_nodes) continue;
            if (!cursor_.next_data(line)) {
                reading_.report.error({block_.where.file, number}, block_.keyword.name, "",
                                      fmt::format("the lines of element {} are not complete", id));
                return;
            }
            if (!extra.numbers.read(line, cursor_.line())) {
                fine = false;
                continue;
            }
            if (extra.thickness != none)
                for (int i = 0; i < 4; ++i) thickness[i] = extra.numbers.real(extra.thickness + i);
            if (extra.angle != none) angle = extra.numbers.real(extra.angle);
            if (extra.system != none) system = system_of(extra.numbers.id(extra.system), id, cursor_.line());
            if (extra.offset != none) offset = extra.numbers.real(extra.offset);
        }
        std::vector<Layer> layers;
        if (layers_) layers = layers_->read(cursor_);
        if (!fine || !ids_.is_number(id, number)) return;
        const Index part = ids_.find_part(first_.id(1), id, number);
        std::array<Index, 4> nodes{}, mid_nodes{};
        if (!ids_.find_nodes(first_, 2, id, number, nodes) || part == none) return;
        if (has_mid_nodes && !ids_.find_nodes(first_, 6, id, number, mid_nodes)) return;

        ShellElements& shells = reading_.model.shells;
        shells.id.push_back(id);
        shells.part.push_back(part);
        shells.nodes.push_back(nodes);
        const auto put = [&](auto& list, const auto& value, bool given) {
            if (list.empty() && !given) return;
            list.resize(shells.size());
            list.back() = value;
        };
        put(shells.thickness, thickness, thickness[0] != 0);
        put(shells.material_angle, angle, angle != 0);
        put(shells.offset, offset, offset != 0);
        put(shells.layers, layers, !layers.empty());
        if (system != none || !shells.material_system.empty()) {
            shells.material_system.resize(shells.size(), none);
            shells.material_system.back() = system;
        }
        if (has_mid_nodes || !shells.mid_nodes.empty()) {
            shells.mid_nodes.resize(shells.size(), {none, none, none, none});
            if (has_mid_nodes) shells.mid_nodes.back() = mid_nodes;
        }
    }

    Index system_of(Id id, Id element, int line)
    {
        if (id == 0) return none;
        const Index found = reading_.look_up(Kind::coordinate, id);
        if (found == none)
            reading_.report.error(
                {block_.where.file, line}, block_.keyword.name, "MCID",
                fmt::format("element {} has coordinate system {}, which is not defined", element, id));
        return found;
    }

    const Block& block_;
    Reading& reading_;
    LineCursor cursor_;
    NumberLine first_;
    std::vector<ExtraLine> extra_lines_;
    ElementIds ids_;
    std::optional<LayerLines> layers_;
};

void read_shells(const Block& block, Reading& reading)
{
    ShellReader(block, reading).run();
}

/// With an angle and layers of their own in the _BETA and _COMPOSITE forms.
void read_thick_shells(const Block& block, Reading& reading)
{
    ThickShellElements& elements = reading.model.thick_shells;
    const std::vector<CardLayout>& cards = block.keyword.layout->cards;
    NumberLine numbers(block, reading, cards[0].fields);
    std::optional<NumberLine> angles;
    std::optional<LayerLines> layer_lines;
    for (std::size_t card = 1; card < cards.size(); ++card) {
        if (cards[card].repeat == CardLayout::Repeat::rows)
            layer_lines.emplace(block, reading, cards[card]);
        else
            angles.emplace(block, reading, cards[card].fields);
    }
    ElementIds ids(block, reading);
    LineCursor cursor(block.text, block.where.line + 1);
    std::string_view line;
    while (cursor.next_data(line)) {
        if (trimmed(line).empty()) continue;
        ++reading.report.elements.tshell;
        const int number = cursor.line();
        bool fine = numbers.read(line, number) && ids.is_number(numbers.id(0), number);
        double angle = 0;
        if (angles && cursor.next_data(line)) {
            fine = angles->read(line, cursor.line()) && fine;
            angle = angles->real(4);
        }
        std::vector<Layer> layers;
        if (layer_lines) layers = layer_lines->read(cursor);
        std::array<Index, 8> nodes{};
        if (!fine) continue;
        const Index part = ids.find_part(numbers.id(1), numbers.id(0), number);
        if (!ids.find_nodes(numbers, 2, numbers.id(0), number, nodes) || part == none) continue;
        elements.id.push_back(numbers.id(0));
        elements.part.push_back(part);
        elements.nodes.push_back(nodes);
        if (angle != 0 || !elements.material_angle.empty()) elements.material_angle.resize(elements.size());
        if (angle != 0) elements.material_angle.back() = angle;
        if (!layers.empty() || !elements.layers.empty()) elements.layers.resize(elements.size());
        if (!layers.empty()) elements.layers.back() = std::move(layers);
    }
}

constexpr Translator shells_table[] = {
    {"ELEMENT_SHELL", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS_BETA", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS_BETA_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS_MCID", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_THICKNESS_MCID_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA_COMPOSITE", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA_OFFSET_COMPOSITE", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_MCID", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_MCID_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_OFFSET", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_OFFSET_COMPOSITE", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_COMPOSITE", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_COMPOSITE_LONG", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA_COMPOSITE_LONG", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_OFFSET_COMPOSITE_LONG", Phase::elements, nullptr, read_shells},
    {"ELEMENT_SHELL_BETA_OFFSET_COMPOSITE_LONG", Phase::elements, nullptr, read_shells},
    {"ELEMENT_TSHELL", Phase::elements, nullptr, read_thick_shells},
    {"ELEMENT_TSHELL_BETA", Phase::elements, nullptr, read_thick_shells},
    {"ELEMENT_TSHELL_COMPOSITE", Phase::elements, nullptr, read_thick_shells},
    {"ELEMENT_TSHELL_BETA_COMPOSITE", Phase::elements, nullptr, read_thick_shells},
    {"ELEMENT_TSHELL_COMPOSITE_BETA", Phase::elements, nullptr, read_thick_shells},
};

} // namespace

std::span<const Translator> shell_keywords()
{
    return shells_table;
}

} // namespace plash

// *ELEMENT_SHELL with all its options, and *ELEMENT_TSHELL: the lines after the first are told by the layout.

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
    int thickness = none, angle = none, offset = none; ///< columns
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
                layers_ = true;
                layer_line_.emplace(block, reading, card.fields);
                continue;
            }
            ExtraLine extra{NumberLine(block, reading, card.fields), !card.condition.empty()};
            for (std::size_t i = 0; i < card.fields.size(); ++i) {
                const std::string& name = card.fields[i].name;
                if (name == "THIC1") extra.thickness = static_cast<int>(i);
                if (name == "BETA" || name == "PSI") extra.angle = static_cast<int>(i);
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
        std::string_view line;
        while (cursor_.next_data(line))
            if (!trimmed(line).empty()) read_element(line);
        for (auto* list : {&shells.material_angle, &shells.offset})
            if (!list->empty()) list->resize(shells.size());
        if (!shells.thickness.empty()) shells.thickness.resize(shells.size());
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
            if (extra.offset != none) offset = extra.numbers.real(extra.offset);
        }
        std::vector<Layer> layers;
        if (layers_) fine = read_layers(layers) && fine;
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
        if (!layers.empty() || !shells.layer_begin.empty()) {
            // Elements before the first with plies have none.
            shells.layer_begin.resize(shells.size(), 0);
            shells.layer_begin.back() = static_cast<Index>(shells.layers.size());
            shells.layers.insert(shells.layers.end(), layers.begin(), layers.end());
        }
        if (has_mid_nodes || !shells.mid_nodes.empty()) {
            shells.mid_nodes.resize(shells.size(), {none, none, none, none});
            if (has_mid_nodes) shells.mid_nodes.back() = mid_nodes;
        }
    }

    /// Lines of layers, one or two plies each, go on until one that can only be an element: whole numbers
    /// without a point.
    bool read_layers(std::vector<Layer>& layers)
    {
        bool fine = true;
        std::string_view line;
        for (LineCursor ahead = cursor_; ahead.next_data(line); cursor_ = ahead) {
            if (line.find('.') == std::string_view::npos && !trimmed(line).empty()) break;
            if (!layer_line_->read(line, ahead.line())) {
                fine = false;
                continue;
            }
            for (int column : {0, 4}) {
                const Id id = layer_line_->id(column);
                if (id == 0 || layer_line_->real(column + 1) == 0) continue;
                Layer layer{reading_.table(Kind::material).find(id), layer_line_->real(column + 1),
                            layer_line_->real(column + 2)};
                if (layer.material == none) {
                    reading_.report.error({block_.where.file, ahead.line()}, block_.keyword.name,
                                          column == 0 ? "MID1" : "MID2",
                                          fmt::format("there is no material {}", id));
                    fine = false;
                }
                layers.push_back(layer);
            }
        }
        return fine;
    }

    const Block& block_;
    Reading& reading_;
    LineCursor cursor_;
    NumberLine first_;
    std::vector<ExtraLine> extra_lines_;
    ElementIds ids_;
    bool layers_ = false;
    std::optional<NumberLine> layer_line_;
};

void read_shells(const Block& block, Reading& reading)
{
    ShellReader(block, reading).run();
}

void read_thick_shells(const Block& block, Reading& reading)
{
    ThickShellElements& elements = reading.model.thick_shells;
    NumberLine numbers(block, reading, block.keyword.layout->cards[0].fields);
    ElementIds ids(block, reading);
    LineCursor cursor(block.text, block.where.line + 1);
    std::string_view line;
    while (cursor.next_data(line)) {
        if (trimmed(line).empty()) continue;
        ++reading.report.elements.tshell;
        if (!numbers.read(line, cursor.line()) || !ids.is_number(numbers.id(0), cursor.line())) continue;
        std::array<Index, 8> nodes{};
        const Index part = ids.find_part(numbers.id(1), numbers.id(0), cursor.line());
        if (!ids.find_nodes(numbers, 2, numbers.id(0), cursor.line(), nodes) || part == none) continue;
        elements.id.push_back(numbers.id(0));
        elements.part.push_back(part);
        elements.nodes.push_back(nodes);
    }
}

constexpr Translator keywords[] = {
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
    {"ELEMENT_TSHELL", Phase::elements, nullptr, read_thick_shells},
};

} // namespace

std::span<const Translator> shell_keywords()
{
    return keywords;
}

} // namespace plash

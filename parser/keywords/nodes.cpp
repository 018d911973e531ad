// *NODE: the longest list of a deck.

#include "parser/large_pages.h"
#include "parser/number.h"
#include "parser/number_line.h"

#include <fmt/format.h>

namespace plash {
namespace {

/// TC and RC of *NODE: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz.
FreedomMask freedoms_of_code(Id code)
{
    constexpr FreedomMask masks[] = {0, 1, 2, 4, 1 | 2, 2 | 4, 4 | 1, 1 | 2 | 4};
    return code >= 1 && code <= 7 ? masks[code] : 0;
}

void fix_node(Reading& reading, FreedomMask freedoms, Index node, Location where)
{
    for (FixedNodes& fixed : reading.model.fixed_nodes) {
        if (fixed.freedoms == freedoms) {
            fixed.nodes.push_back(node);
            return;
        }
    }
    FixedNodes fixed;
    fixed.nodes = {node};
    fixed.freedoms = freedoms;
    fixed.where = where;
    reading.model.fixed_nodes.push_back(std::move(fixed));
}

void read_nodes(const Block& block, Reading& reading)
{
    Nodes& nodes = reading.model.nodes;
    nodes.id.reserve(nodes.id.size() + block.lines);
    nodes.position.reserve(nodes.position.size() + block.lines);
    use_large_pages(nodes.id);
    use_large_pages(nodes.position);
    if (block.transform && !block.transform->transformations.empty())
        reading.moved_nodes.emplace_back(&block, static_cast<Index>(nodes.size()));
    else if (!reading.moved_nodes.empty())
        reading.moved_nodes.emplace_back(nullptr, static_cast<Index>(nodes.size()));
    NumberLine numbers(block, reading, block.keyword.layout->cards[0].fields);
    LineCursor cursor(block.text, block.where.line + 1);
    const char* const last_data = end_of_data(block.text);
    const std::size_t before = nodes.size();
    TextRelease release(*reading.deck.files[block.where.file], block.text);
    std::string_view line;
    while (cursor.next_data(line)) {
        release.up_to(line.data());
        if (trimmed(line).empty()) {
            if (cursor.position() >= last_data) break;
            continue;
        }
        if (!numbers.read(line, cursor.line())) continue;
        const Location where{block.where.file, cursor.line()};
        if (numbers.id(0) <= 0) {
            reading.report.error(where, "NODE", "NID", "a node needs a positive number");
            continue;
        }
        const FreedomMask freedoms = freedoms_of_code(numbers.id(4)) | freedoms_of_code(numbers.id(5)) << 3;
        if (freedoms) fix_node(reading, freedoms, static_cast<Index>(nodes.size()), where);
        if (numbers.id(4) < 0 || numbers.id(4) > 7 || numbers.id(5) < 0 || numbers.id(5) > 7)
            reading.report.error(where, "NODE", numbers.id(4) < 0 || numbers.id(4) > 7 ? "TC" : "RC",
                                 "a constraint code is 0 to 7");
        nodes.id.push_back(numbers.id(0));
        nodes.position.push_back({numbers.real(1), numbers.real(2), numbers.real(3)});
    }
    reading.report.fields.honoured += static_cast<long>(4 * (nodes.size() - before));
}

/// Kept until all nodes are known: some transformations are told by nodes.
void keep_transformation(const Record& record, const Block&, Reading& reading)
{
    reading.transformations.emplace(record.id, record);
}

void keep_node_transform(const Record& record, const Block&, Reading& reading)
{
    reading.node_transforms.push_back(record);
}

/// Positions by node number, for transformations that are told by nodes.
auto position_in(Reading& reading)
{
    return [&reading](Id id) -> std::optional<Vec3> {
        const Index node = reading.table(Kind::node).find(id);
        if (node == none) return std::nullopt;
        return reading.model.nodes.position[node];
    };
}

constexpr Translator nodes_table[] = {
    {"NODE", Phase::nodes, nullptr, read_nodes},
    {"DEFINE_TRANSFORMATION", Phase::nodes, keep_transformation},
    {"NODE_TRANSFORM", Phase::sets, keep_node_transform},
};

} // namespace

std::span<const Translator> node_keywords()
{
    return nodes_table;
}

void move_included_nodes(Reading& reading)
{
    Nodes& nodes = reading.model.nodes;
    const auto node_position = position_in(reading);
    for (const auto& transform : reading.deck.transforms) {
        Affine motion;
        for (const auto& [id, where] : transform->transformations) {
            const auto found = reading.transformations.find(id);
            if (found == reading.transformations.end())
                reading.report.error(where, "INCLUDE_TRANSFORM", "TRANID",
                                     fmt::format("there is no transformation {}", id));
            else
                motion = then(motion, transformation_of(found->second, node_position, reading.report));
        }
        if (!motion.is_identity()) reading.motions[transform.get()] = motion;
    }
    for (std::size_t i = 0; i < reading.moved_nodes.size(); ++i) {
        const auto& [block, first] = reading.moved_nodes[i];
        if (!block) continue;
        const Affine motion = reading.motion_of(*block);
        const std::size_t end =
            i + 1 < reading.moved_nodes.size() ? reading.moved_nodes[i + 1].second : nodes.size();
        for (std::size_t node = first; node < end; ++node)
            nodes.position[node] = motion.point(nodes.position[node]);
    }
}

void move_node_sets(Reading& reading)
{
    for (const Record& record : reading.node_transforms) {
        const Id id = record.integer("TRSID");
        const auto found = reading.transformations.find(id);
        if (found == reading.transformations.end()) {
            reading.report.error(record.where, record.keyword, "TRSID",
                                 fmt::format("there is no transformation {}", id));
            continue;
        }
        const Affine motion = transformation_of(found->second, position_in(reading), reading.report);
        const Index set = reading.find(record, "NSID", Kind::node_set);
        if (set == none) continue;
        for (Index node : reading.model.node_sets[set].nodes) {
            Vec3& position = reading.model.nodes.position[node];
            position = motion.point(position);
        }
    }
}

} // namespace plash

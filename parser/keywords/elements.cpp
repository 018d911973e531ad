// *ELEMENT_BEAM, _DISCRETE, _MASS and _SPH.

#include "parser/number.h"
#include "parser/number_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plash {
namespace {

/// The part of an element; the report of missing ones comes with all references.
Index part_of(const Record& record, Reading& reading)
{
    return reading.find(record, "PID", Kind::part);
}

void read_beam(const Record& record, const Block&, Reading& reading)
{
    if (!record.peek("N1")) { // pulleys and the like are no beams
        reading.model.others.push_back(record);
        return;
    }
    BeamElements& beams = reading.model.beams;
    ++reading.report.elements.beam;
    const Index part = part_of(record, reading);
    const std::array<Index, 3> nodes{reading.find(record, "N1", Kind::node),
                                     reading.find(record, "N2", Kind::node),
                                     reading.find(record, "N3", Kind::node)};
    if (part == none || nodes[0] == none || nodes[1] == none) return;
    beams.id.push_back(record.id);
    beams.part.push_back(part);
    beams.nodes.push_back(nodes);
    // Everything that a beam may have besides stays at hand as the deck gives it.
    const bool more = std::any_of(record.fields.begin(), record.fields.end(), [](const Record::Field& field) {
        return field.given && field.name != "PID" && field.name != "N1" && field.name != "N2" &&
               field.name != "N3";
    });
    if (more || !beams.options.empty()) beams.options.resize(beams.size(), none);
    if (more) {
        beams.options.back() = static_cast<Index>(reading.model.others.size());
        reading.model.others.push_back(record);
    }
    const bool orientation = record.peek("VX") != nullptr;
    if (!orientation && beams.orientation.empty()) return;
    beams.orientation.resize(beams.size());
    if (orientation) beams.orientation.back() = {record.real("VX"), record.real("VY"), record.real("VZ")};
}

void read_discrete(const Record& record, const Block&, Reading& reading)
{
    DiscreteElements& elements = reading.model.discretes;
    ++reading.report.elements.discrete;
    const Index part = part_of(record, reading);
    const std::array<Index, 2> nodes{reading.find(record, "N1", Kind::node),
                                     reading.find(record, "N2", Kind::node)};
    if (part == none || (nodes[0] == none && nodes[1] == none)) return;
    elements.id.push_back(record.id);
    elements.part.push_back(part);
    elements.nodes.push_back(nodes);
    elements.orientation.push_back(reading.find(record, "VID", Kind::orientation));
    const double scale = record.real("S", 1);
    elements.scale.push_back(scale == 0 ? 1 : scale);
    elements.initial_offset.push_back(record.real("OFFSET"));
    elements.silent.push_back(record.integer("PF") == 1);
}

void read_mass(const Record& record, const Block&, Reading& reading)
{
    NodalMasses& masses = reading.model.masses;
    ++reading.report.elements.mass;
    const Index node = reading.find(record, "NID", Kind::node);
    if (node == none) return;
    masses.id.push_back(record.id);
    masses.node.push_back(node);
    masses.mass.push_back(record.real("MASS"));
}

/// The mass is shared out in equal parts to the nodes of the set.
void read_mass_of_set(const Record& record, const Block&, Reading& reading)
{
    NodalMasses& masses = reading.model.masses;
    const Index set = reading.find(record, "NSID", Kind::node_set);
    if (set == none) return;
    const std::vector<Index>& nodes = reading.model.node_sets[set].nodes;
    for (Index node : nodes) {
        ++reading.report.elements.mass;
        masses.id.push_back(record.id);
        masses.node.push_back(node);
        masses.mass.push_back(record.real("MASS") / static_cast<double>(nodes.size()));
    }
}

/// Particles NID to NEND when NEND is given.
void read_particles(const Block& block, Reading& reading)
{
    ParticleElements& particles = reading.model.particles;
    const std::size_t expected = particles.size() + block.lines;
    particles.node.reserve(expected);
    particles.part.reserve(expected);
    particles.mass.reserve(expected);
    const UnitFactors units = block.transform ? block.transform->units : UnitFactors{};
    const double volume_over_mass = std::pow(units.length, 3) / units.mass;
    const bool volumes = block.keyword.name.ends_with("_VOLUME");
    NumberLine numbers(block, reading, block.keyword.layout->cards[0].fields);
    ElementIds ids(block, reading);
    LineCursor cursor(block.text, block.where.line + 1);
    std::string_view line;
    while (cursor.next_data(line)) {
        if (trimmed(line).empty()) continue;
        ++reading.report.elements.sph;
        if (!numbers.read(line, cursor.line())) continue;
        const Id first = numbers.id(0), last = std::max(first, numbers.id(3));
        const Index part = ids.find_part(numbers.id(1), first, cursor.line());
        if (part == none) continue;
        if (last - first >= static_cast<Id>(reading.model.nodes.size())) {
            reading.report.error(
                {block.where.file, cursor.line()}, block.keyword.name, "NEND",
                fmt::format("{} to {} are more particles than there are nodes", first, last));
            continue;
        }
        for (Id id = first; id <= last; ++id) {
            const Index node = reading.table(Kind::node).find(id);
            if (node == none) {
                reading.report.error({block.where.file, cursor.line()}, block.keyword.name, "NID",
                                     fmt::format("there is no node {}", id));
                continue;
            }
            particles.node.push_back(node);
            particles.part.push_back(part);
            const double value = numbers.real(2);
            // A negative mass is a volume, and came with the factor of a mass.
            particles.mass.push_back(volumes ? -value : value < 0 ? value * volume_over_mass : value);
        }
        reading.report.elements.sph += last - first;
    }
}

constexpr Translator elements_table[] = {
    {"ELEMENT_BEAM", Phase::elements, read_beam},
    {"ELEMENT_BEAM_*", Phase::elements, read_beam},
    {"ELEMENT_DISCRETE", Phase::elements, read_discrete},
    {"ELEMENT_MASS", Phase::elements, read_mass},
    {"ELEMENT_MASS_NODE_SET", Phase::conditions, read_mass_of_set},
    {"ELEMENT_SPH", Phase::elements, nullptr, read_particles},
    {"ELEMENT_SPH_VOLUME", Phase::elements, nullptr, read_particles},
};

} // namespace

std::span<const Translator> element_keywords()
{
    return elements_table;
}

} // namespace plash

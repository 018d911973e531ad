#include "output/d3plot_layout.h"

#include "model/eulerian.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <string_view>

namespace plash {

namespace {

/// Positions of `ids` in rising order of the numbers.
std::vector<Index> sorted_by_id(const std::vector<Id>& ids)
{
    std::vector<Index> order(ids.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return ids[a] < ids[b]; });
    return order;
}

/// Place (from 1) of each index of the Model in the database.
std::vector<std::uint32_t> places(const std::vector<Index>& order)
{
    std::vector<std::uint32_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::uint32_t>(i + 1);
    return place;
}

/// Four characters a word, blank at the end.
void put_text(std::vector<std::uint32_t>& words, std::string_view text, std::size_t word_count)
{
    std::string padded(text.substr(0, 4 * word_count));
    padded.resize(4 * word_count, ' ');
    const std::size_t begin = words.size();
    words.resize(begin + word_count);
    std::memcpy(words.data() + begin, padded.data(), padded.size());
}

std::uint32_t bits(double value)
{
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

template <int Corners>
void put_elements(std::vector<std::uint32_t>& words, const Elements<Corners>& elements,
                  const std::vector<Index>& order, const std::vector<std::uint32_t>& node_place,
                  const std::vector<std::uint32_t>& part_place)
{
    for (Index element : order) {
        for (Index node : elements.nodes[element]) words.push_back(node_place[node]);
        words.push_back(part_place[elements.part[element]]);
    }
}

/// Two ends, the node that turns the section (the first again where there is none), two words without
/// meaning, the part.
void put_beams(std::vector<std::uint32_t>& words, const Model& model, const std::vector<Index>& order,
               const std::vector<std::uint32_t>& node_place, const std::vector<std::uint32_t>& part_place)
{
    for (Index beam : order) {
        const auto& nodes = model.beams.nodes[beam];
        for (Index node : nodes) words.push_back(node_place[node == none ? nodes[0] : node]);
        words.insert(words.end(), 2, 0);
        words.push_back(part_place[model.beams.part[beam]]);
    }
}

void put_ids(std::vector<std::uint32_t>& words, const std::vector<Id>& ids, const std::vector<Index>& order)
{
    for (Index index : order) words.push_back(static_cast<std::uint32_t>(ids[index]));
}

/// Number of parts that have one of these elements.
std::uint32_t parts_with(const std::vector<Index>& part_of_element, std::size_t part_count)
{
    std::vector<bool> used(part_count);
    for (Index part : part_of_element) used[part] = true;
    return static_cast<std::uint32_t>(std::count(used.begin(), used.end(), true));
}

/// Number of parts that have no element at all. Readers sum up the numbers of parts by kinds of elements and
/// trust that no material is above: VTK's breaks down otherwise.
std::uint32_t parts_without_elements(const Model& model)
{
    std::vector<bool> used(model.parts.size());
    for (const auto* parts : {&model.solids.part, &model.thick_shells.part, &model.beams.part,
                              &model.shells.part, &model.particles.part}) {
        for (Index part : *parts) used[part] = true;
    }
    return static_cast<std::uint32_t>(std::count(used.begin(), used.end(), false));
}

/// The numbers that the deck gives to nodes, elements and parts (NARBS words).
void put_numbers(std::vector<std::uint32_t>& words, const Model& model, const D3plotLayout& layout,
                 const std::vector<Id>& part_ids)
{
    const auto nodes = static_cast<std::uint32_t>(layout.nodes.size());
    const auto solids = static_cast<std::uint32_t>(layout.solids.size());
    const auto beams = static_cast<std::uint32_t>(layout.beams.size());
    const auto shells = static_cast<std::uint32_t>(layout.shells.size());
    const auto parts = static_cast<std::uint32_t>(layout.parts.size());
    const std::uint32_t solid_place = 1 + nodes, beam_place = solid_place + solids;
    const std::uint32_t shell_place = beam_place + beams;
    const auto thick_shells = static_cast<std::uint32_t>(layout.thick_shells.size());
    const std::uint32_t thick_place = shell_place + shells, part_place = thick_place + thick_shells;
    const std::uint32_t header[16] = {
        static_cast<std::uint32_t>(-1), // NSORT; the minus: part numbers follow
        solid_place,
        beam_place,
        shell_place,
        thick_place,
        nodes,
        solids,
        beams,
        shells,
        thick_shells,
        part_place + parts,
        part_place,
        part_place + 2 * parts, // sorted, as the deck has them, cross-reference
        parts,
        0,
        parts,
    };
    words.insert(words.end(), std::begin(header), std::end(header));
    put_ids(words, model.nodes.id, layout.nodes);
    put_ids(words, model.solids.id, layout.solids);
    put_ids(words, model.beams.id, layout.beams);
    put_ids(words, model.shells.id, layout.shells);
    put_ids(words, model.thick_shells.id, layout.thick_shells);
    put_ids(words, part_ids, layout.parts);
    put_ids(words, part_ids, layout.parts);
    for (std::uint32_t part = 1; part <= parts; ++part) words.push_back(part);
}

/// ISPHFG: how many flags there are and how many words each quantity of a particle has: radius of influence
/// (h), pressure, stress, plastic strain, density, internal energy, neighbours, strain and its rate, mass,
/// history. LS-DYNA 2025 writes 11 of them too, with 12 strains and 3 history variables.
constexpr std::uint32_t particle_flags[] = {11, 1, 1, 6, 1, 1, 1, 1, 0, 1, 0};

std::vector<Id> part_numbers(const Model& model)
{
    std::vector<Id> ids;
    for (const Part& part : model.parts) ids.push_back(part.id);
    return ids;
}

/// The particles by the numbers of their nodes.
std::vector<Index> sorted_particles(const Model& model)
{
    std::vector<Id> ids;
    for (Index node : model.particles.node) ids.push_back(model.nodes.id[node]);
    return sorted_by_id(ids);
}

} // namespace

D3plotLayout::D3plotLayout(const Model& model)
    : nodes(sorted_by_id(model.nodes.id)),
      solids(sorted_by_id(model.solids.id)),
      beams(sorted_by_id(model.beams.id)),
      shells(sorted_by_id(model.shells.id)),
      thick_shells(sorted_by_id(model.thick_shells.id)),
      particles(sorted_particles(model)),
      walls(model.rigid_walls.size()),
      fluid_groups(has_eulerian_mesh(model) ? multi_material_groups(model) : 0)
{
    parts = sorted_by_id(part_numbers(model));

    const auto field = [&](const char* name, int fallback) {
        const int value = model.controls.output.extent_of(name);
        return value == 0 ? fallback : value;
    };
    solid_variables = std::max(0, field("NEIPH", 0));
    shell_variables = std::max(0, field("NEIPS", 0));
    strains = model.controls.output.strains();
    layers = std::abs(field("MAXINT", 3));
    beam_points = std::max(0, field("BEAMIP", 0));
    shell_stress = field("SIGFLG", 1) != 2;
    shell_strain = field("EPSFLG", 1) != 2;
    shell_forces = field("RLTFLG", 1) != 2;
    shell_extra = field("ENGFLG", 1) != 2;
    one_state_per_file = field("IEVERP", 0) == 1;
}

std::vector<std::uint32_t> d3plot_control(const Model& model, const D3plotLayout& layout)
{
    const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    const std::size_t part_count = layout.parts.size();
    std::vector<std::uint32_t> words;
    put_text(words, model.title, 10);
    words.resize(64);
    words[11] = 1;          // file type: d3plot
    words[13] = 0x30303152; // release "R100": the files that this layout was compared with
    words[14] = bits(971);  // version; from 971 on a rigid wall has a force and a place
    words[15] = 4;          // NDIM: three dimensions, connectivities one word a node
    words[16] = count(layout.nodes.size());
    words[17] = 6; // ICODE: LS-DYNA
    words[18] = count(layout.global_words());
    words[20] = words[21] = words[22] = 1; // IU, IV, IA
    words[23] = count(layout.solids.size());
    words[24] = parts_with(model.solids.part, part_count) + parts_without_elements(model);
    words[27] = count(layout.solid_words());
    words[28] = count(layout.beams.size());
    words[29] = parts_with(model.beams.part, part_count);
    words[30] = count(layout.beam_words()); // NV1D
    words[31] = count(layout.shells.size());
    words[32] = parts_with(model.shells.part, part_count);
    words[33] = count(layout.shell_words());
    words[34] = count(layout.solid_history() + 6 * layout.strains); // NEIPH: the last six are strains
    words[35] = static_cast<std::uint32_t>(layout.shell_variables); // NEIPS
    words[36] =
        static_cast<std::uint32_t>(-(10000 + layout.layers)); // MAXINT; the minus: deletion per element
    words[37] = count(layout.particles.size());               // NMSPH
    words[38] = parts_with(model.particles.part, part_count);
    words[39] = count(16 + layout.nodes.size() + layout.solids.size() + layout.beams.size() +
                      layout.shells.size() + layout.thick_shells.size() + 3 * part_count);
    words[40] = count(layout.thick_shells.size());               // NELT
    words[41] = parts_with(model.thick_shells.part, part_count); // NUMMATT
    words[42] = count(layout.thick_shell_words());               // NV3DT
    words[43] = layout.shell_stress ? 1000 : 999;
    words[44] = layout.shell_strain ? 1000 : 999;
    words[45] = layout.shell_forces ? 1000 : 999;
    words[46] = layout.shell_extra ? 1000 : 999;
    words[51] = count(part_count);
    words[53] = 1;                          // INN: invariant node numbering for shells
    words[56] = layout.strains ? 10000 : 0; // IDTDT: its fifth digit is ISTRN
    return words;
}

std::vector<std::uint32_t> D3plotLayout::node_places() const
{
    return places(nodes);
}

void put_mesh(std::vector<std::uint32_t>& words, const Model& model, const D3plotLayout& layout)
{
    for (Index node : layout.nodes) {
        const Vec3& position = model.nodes.position[node];
        for (double x : {position.x, position.y, position.z}) words.push_back(bits(x));
    }
    const std::vector<std::uint32_t> node_place = places(layout.nodes), part_place = places(layout.parts);
    put_elements(words, model.solids, layout.solids, node_place, part_place);
    put_elements(words, model.thick_shells, layout.thick_shells, node_place, part_place);
    put_beams(words, model, layout.beams, node_place, part_place);
    put_elements(words, model.shells, layout.shells, node_place, part_place);
    put_numbers(words, model, layout, part_numbers(model));
}

std::vector<std::uint32_t> d3plot_geometry(const Model& model, const D3plotLayout& layout)
{
    std::vector<std::uint32_t> words = d3plot_control(model, layout);
    if (!layout.particles.empty()) {
        words.insert(words.end(), std::begin(particle_flags), std::end(particle_flags));
    }
    put_mesh(words, model, layout);
    const std::vector<std::uint32_t> node_place = places(layout.nodes), part_place = places(layout.parts);
    for (Index particle : layout.particles) {
        words.push_back(node_place[model.particles.node[particle]]);
        words.push_back(part_place[model.particles.part[particle]]);
    }

    words.push_back(bits(-999999));
    words.push_back(90001); // part titles
    words.push_back(static_cast<std::uint32_t>(layout.parts.size()));
    for (Index part : layout.parts) {
        words.push_back(static_cast<std::uint32_t>(model.parts[part].id));
        put_text(words, model.parts[part].title, 18);
    }
    words.push_back(90000); // title of the deck
    put_text(words, model.title, 18);
    return words;
}

} // namespace plash

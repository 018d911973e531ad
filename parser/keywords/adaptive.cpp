// *DEFINE_ADAPTIVE_SOLID_TO_SPH: particles that wait in solids until these are deleted.

#include "model/measures.h"
#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace plash {
namespace {

void keep_stand_ins(const Record& record, const Block& block, Reading& reading)
{
    reading.pending_stand_ins.push_back({record, &block});
}

/// The parts whose solids are to be replaced.
std::vector<Index> replaced_parts(const Record& record, const Block& block, Reading& reading)
{
    const Id kind = record.integer("ITYPE");
    if (kind != 0 && kind != 1) {
        reading.error(record, "ITYPE",
                      fmt::format("there is no type {}; there are 0 (part) and 1 (part set)", kind));
        return {};
    }
    const Kind wanted = kind == 0 ? Kind::part : Kind::part_set;
    const Index found = reading.look_up(wanted, block.number(wanted, record.integer("IPID")));
    if (found == none) {
        reading.error(record, "IPID",
                      fmt::format("there is no {} {}", to_string(wanted), record.integer("IPID")));
        return {};
    }
    if (kind == 0) return {found};
    return reading.model.part_sets[found].parts;
}

StandIns::Bond bond_of(const Record& record, Reading& reading)
{
    const Id coupling = record.integer("ICPL"), method = record.integer("IOPT");
    if (coupling != 0 && coupling != 1) {
        reading.error(
            record, "ICPL",
            fmt::format("there is no {}; there are 0 (debris) and 1 (bonded with the solids beside)",
                        coupling));
    }
    if (method != 0 && method != 1) {
        reading.error(
            record, "IOPT",
            fmt::format("there is no {}; there are 0 (bonded from the start) and 1 (from the loss of "
                        "a solid on)",
                        method));
    }
    if (coupling != 1) return StandIns::Bond::none;
    return method == 1 ? StandIns::Bond::at_loss : StandIns::Bond::at_start;
}

Vec3 place_of(const std::array<double, 8>& weights, const std::array<Index, 8>& nodes,
              const std::vector<Vec3>& position)
{
    Vec3 place{};
    for (int i = 0; i < 8; ++i) place += weights[i] * position[nodes[i]];
    return place;
}

/// One solid's particles, with equal shares of its volume.
void add_particles(StandIns stand_ins, Index part, Id& next_id, Model& model)
{
    const std::array<Index, 8>& nodes = model.solids.nodes[stand_ins.solid];
    const auto places = stand_in_weights(nodes, stand_ins.per_edge);
    stand_ins.first = static_cast<Index>(model.particles.size());
    const double volume = solid_volume(nodes, model.nodes.position) / static_cast<double>(places.size());
    for (const auto& weights : places) {
        model.particles.node.push_back(static_cast<Index>(model.nodes.size()));
        model.particles.part.push_back(part);
        model.particles.mass.push_back(-volume);
        model.nodes.position.push_back(place_of(weights, nodes, model.nodes.position));
        model.nodes.id.push_back(next_id++);
    }
    model.stand_ins.push_back(stand_ins);
}

constexpr Translator adaptive_table[] = {
    {"DEFINE_ADAPTIVE_SOLID_TO_SPH", Phase::sets, keep_stand_ins},
};

} // namespace

std::span<const Translator> adaptive_keywords()
{
    return adaptive_table;
}

void make_stand_ins(Reading& reading)
{
    Model& model = reading.model;
    Id next_id = 1;
    for (Id id : model.nodes.id) next_id = std::max(next_id, id + 1);
    std::vector<bool> replaced(model.solids.size());
    std::map<Index, StandIns::Bond> bonds; // by part of particles
    for (const PendingStandIns& pending : reading.pending_stand_ins) {
        const Record& record = pending.record;
        StandIns stand_ins;
        stand_ins.bond = bond_of(record, reading);
        const Id per_edge = record.integer("NQ");
        if (per_edge < 1 || per_edge > 3) {
            reading.error(
                record, "NQ",
                fmt::format("{} is not supported; there are 1, 2 and 3 particles along an edge", per_edge));
            continue;
        }
        stand_ins.per_edge = static_cast<int>(per_edge);
        const Index particles = reading.find(record, "IPSPH", Kind::part);
        if (particles == none) {
            reading.error(record, "IPSPH", "the new particles need a part");
            continue;
        }
        if (bonds.emplace(particles, stand_ins.bond).first->second != stand_ins.bond)
            reading.error(record, "ICPL",
                          "the particles of one part are all bonded in one way, or not at all");
        if (const Index section = reading.find(record, "ISSPH", Kind::section); section != none)
            model.parts[particles].section = section;
        std::vector<bool> wanted(model.parts.size());
        for (Index part : replaced_parts(record, *pending.block, reading)) wanted[part] = true;
        const std::size_t before = model.stand_ins.size();
        for (std::size_t solid = 0; solid < model.solids.size(); ++solid) {
            const Index part = model.solids.part[solid];
            if (part == none || !wanted[part] || replaced[solid]) continue;
            replaced[solid] = true;
            stand_ins.solid = static_cast<Index>(solid);
            add_particles(stand_ins, particles, next_id, model);
        }
        if (model.stand_ins.size() == before)
            reading.warning(record, "IPID", "names no solids, or those of another definition alone");
    }
    reading.pending_stand_ins.clear();
}

} // namespace plash

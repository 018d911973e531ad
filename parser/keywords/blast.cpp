#include "parser/reading.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr double pounds_per_kilogram = 1 / 0.45359237;
constexpr double feet_per_metre = 1 / 0.3048;
constexpr double pascals_per_psi = 4.4482216152605 / (0.0254 * 0.0254);

/// UNIT: what the deck's units are (keyword manual, *LOAD_BLAST_ENHANCED).
bool read_units(const Record& record, BlastLoad::Units& units, Reading& reading)
{
    constexpr double kg = pounds_per_kilogram, m = feet_per_metre, pascal = 1 / pascals_per_psi;
    switch (const Id unit = record.integer("UNIT")) {
    case 1:
        units = {1, 1, 1000, 1};
        return true;
    case 2:
        units = {kg, m, 1000, pascal};
        return true;
    case 3:
        units = {386.0885826771654, 1.0 / 12, 1000, 1};
        return true; // mass: lbf s^2 / in
    case 4:
        units = {1e-3 * kg, 0.01 * m, 1e-3, 1e11 * pascal};
        return true;
    case 5:
        units = {record.real("CFM"), record.real("CFL"), record.real("CFT"), record.real("CFP")};
        for (const char* field : {"CFM", "CFL", "CFT", "CFP"}) {
            if (record.real(field) > 0) continue;
            reading.error(
                record, field,
                "UNIT = 5 needs pounds, feet, milliseconds and pounds per square inch of one unit of "
                "the deck in CFM, CFL, CFT and CFP");
            return false;
        }
        return true;
    case 6:
        units = {kg, 1e-3 * m, 1, 1e9 * pascal};
        return true;
    case 7:
        units = {1e3 * kg, 1e-3 * m, 1000, 1e6 * pascal};
        return true;
    case 8:
        units = {1e-3 * kg, 1e-3 * m, 1, 1e6 * pascal};
        return true;
    default:
        reading.error(record, "UNIT", fmt::format("{} is not one of 1 to 8", unit));
        return false;
    }
}

void read_blast(const Record& record, const Block&, Reading& reading)
{
    BlastLoad load;
    load.where = record.where;
    load.id = record.integer("BID");
    load.mass = record.real("M");
    if (!(load.mass > 0)) reading.error(record, "M", "the mass of TNT must be above zero");
    load.centre = {record.real("XBO"), record.real("YBO"), record.real("ZBO")};
    if (record.integer("NIDBO") != 0) load.node = reading.find(record, "NIDBO", Kind::node);
    load.start = record.real("TBO");
    if (record.real("DEATH") > 0) load.death = record.real("DEATH");
    const Id blast = record.integer("BLAST");
    load.on_the_ground = blast == 1;
    if (blast != 1 && blast != 2)
        reading.error(
            record, "BLAST",
            fmt::format("burst {} is not supported (1: hemisphere on the ground, 2: sphere in air)", blast));
    const Id negative = record.integer("NEGPHS");
    load.negative_phase = negative == 0;
    if (negative != 0 && negative != 1)
        reading.error(record, "NEGPHS", fmt::format("{} is not 0 (with the negative phase) or 1", negative));
    if (read_units(record, load.units, reading)) {
        if (record.integer("UNIT") != 5)
            for (const char* field : {"CFM", "CFL", "CFT", "CFP"})
                if (record.real(field) != 0) reading.warning(record, field, "acts with UNIT = 5 alone");
    }
    reading.model.blast_loads.push_back(std::move(load));
}

/// Gives a blast the segments of a card.
void add_surface(const Record& record, std::vector<std::array<Index, 4>> segments, Reading& reading)
{
    for (const char* field : {"ALEPID", "SFNRB"})
        if (record.real(field) != 0)
            reading.error(record, field,
                          "blasts that enter through an ambient layer of an Eulerian mesh are not supported");
    const Id id = record.integer("BID");
    auto& loads = reading.model.blast_loads;
    const auto load =
        std::find_if(loads.begin(), loads.end(), [&](const BlastLoad& l) { return l.id == id; });
    if (load == loads.end()) {
        reading.error(record, "BID", fmt::format("there is no *LOAD_BLAST_ENHANCED {}", id));
        return;
    }
    const double scale = record.real("SCALEP");
    load->surfaces.push_back({std::move(segments), scale != 0 ? scale : 1});
}

void read_blast_segment(const Record& record, const Block&, Reading& reading)
{
    if (const auto nodes = reading.find_segment(record)) add_surface(record, {*nodes}, reading);
}

void read_blast_segment_set(const Record& record, const Block&, Reading& reading)
{
    const Index set = reading.find(record, "SSID", Kind::segment_set);
    if (set != none) add_surface(record, reading.model.segment_sets[set].segments, reading);
}

constexpr Translator blast_table[] = {
    {"LOAD_BLAST_ENHANCED", Phase::sets, read_blast}, // before what it loads, wherever that stands
    {"LOAD_BLAST_SEGMENT", Phase::conditions, read_blast_segment},
    {"LOAD_BLAST_SEGMENT_SET", Phase::conditions, read_blast_segment_set},
};

} // namespace

std::span<const Translator> blast_keywords()
{
    return blast_table;
}

} // namespace plash

// *DAMPING family.

#include "parser/reading.h"

#include <numbers>

namespace plash {
namespace {

/// Scale factors of the six freedoms; all zero means all one.
void read_scales(const Record& record, NodeDamping& damping)
{
    constexpr std::string_view fields[] = {"STX", "STY", "STZ", "SRX", "SRY", "SRZ"};
    if (!record.peek("STX")) return;
    std::array<double, 6> scale{};
    bool any = false;
    for (int i = 0; i < 6; ++i) {
        scale[i] = record.real(fields[i]);
        any = any || scale[i] != 0;
    }
    if (any) damping.scale = scale;
}

void read_global(const Record& record, const Block&, Reading& reading)
{
    NodeDamping damping;
    damping.where = record.where;
    damping.curve = reading.find(record, "LCID", Kind::curve);
    damping.rate = damping.curve == none ? record.real("VALDMP") : 1;
    read_scales(record, damping);
    if (damping.rate != 0) reading.model.dampings.push_back(std::move(damping));
}

void read_part_mass(const Record& record, const Block&, Reading& reading)
{
    NodeDamping damping;
    damping.where = record.where;
    damping.curve = reading.find(record, "LCID", Kind::curve);
    if (record.integer("LCID") == 0) reading.error(record, "LCID", "the damping of a part needs a curve");
    damping.rate = record.real("SF", 1);
    if (record.integer("FLAG") == 1) read_scales(record, damping);
    if (record.peek("PSID")) {
        const Index set = reading.find(record, "PSID", Kind::part_set);
        if (set != none) damping.parts = reading.model.part_sets[set].parts;
    } else if (const Index part = reading.find(record, "PID", Kind::part); part != none) {
        damping.parts = {part};
    }
    if (!damping.parts.empty()) reading.model.dampings.push_back(std::move(damping));
}

/// CDAMP is a fraction of the critical damping of an oscillator of frequency FREQ: c = 2 CDAMP omega m.
void read_relative(const Record& record, const Block&, Reading& reading)
{
    NodeDamping damping;
    damping.where = record.where;
    damping.rate = 4 * std::numbers::pi * record.real("CDAMP") * record.real("FREQ");
    damping.curve = reading.find(record, "LCID", Kind::curve);
    const Index set = reading.find(record, "PSID", Kind::part_set);
    const Index body = reading.find(record, "PIDRB", Kind::part);
    if (record.integer("PSID") == 0) reading.error(record, "PSID", "relative damping needs a set of parts");
    if (record.integer("PIDRB") == 0) reading.error(record, "PIDRB", "relative damping needs a rigid part");
    if (set == none || body == none) return;
    damping.parts = reading.model.part_sets[set].parts;
    damping.reference_nodes = nodes_of_parts(reading.model, {body});
    if (!damping.parts.empty() && damping.rate != 0) reading.model.dampings.push_back(std::move(damping));
}

/// COEF, or SIGN * |COEF|: above 0 a share of critical damping, below 0 Rayleigh's coefficient.
void read_part_stiffness(const Record& record, const Block&, Reading& reading)
{
    std::vector<Index> parts;
    if (record.peek("PSID")) {
        const Index set = reading.find(record, "PSID", Kind::part_set);
        if (set != none) parts = reading.model.part_sets[set].parts;
    } else if (const Index part = reading.find(record, "PID", Kind::part); part != none) {
        parts = {part};
    }
    const double coefficient = record.real("COEF");
    if (coefficient >= 1)
        reading.error(record, "COEF",
                      "a share of critical damping must be below 1; Rayleigh's coefficient is negative");
    for (Index part : parts) {
        if (coefficient != 0) reading.model.stiffness_dampings.push_back({part, coefficient, record.where});
    }
}

constexpr Translator damping_table[] = {
    {"DAMPING_GLOBAL", Phase::conditions, read_global},
    {"DAMPING_PART_MASS", Phase::conditions, read_part_mass},
    {"DAMPING_PART_MASS_SET", Phase::conditions, read_part_mass},
    {"DAMPING_PART_STIFFNESS", Phase::conditions, read_part_stiffness},
    {"DAMPING_PART_STIFFNESS_SET", Phase::conditions, read_part_stiffness},
    {"DAMPING_RELATIVE", Phase::conditions, read_relative},
};

} // namespace

std::span<const Translator> damping_keywords()
{
    return damping_table;
}

} // namespace plash

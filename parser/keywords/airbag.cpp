// *AIRBAG_SIMPLE_PRESSURE_VOLUME, _ADIABATIC_GAS_MODEL, _SIMPLE_AIRBAG_MODEL, _WANG_NEFSKE, _LINEAR_FLUID.

#include "parser/reading.h"

#include <fmt/format.h>

#include <cmath>

namespace plash {
namespace {

/// Fields that have no say here: a deck that sets one means something that would be missing.
void refuse(const Record& record, std::initializer_list<std::pair<const char*, const char*>> fields,
            Reading& reading)
{
    for (const auto& [field, meaning] : fields) {
        if (record.real(field) != 0) reading.error(record, field, fmt::format("{} not supported", meaning));
    }
}

/// FLC FAC of a material: of *MAT_ADD_AIRBAG_POROSITY_LEAKAGE where it has one, else of *MAT_FABRIC [-].
double leak_share_of(const Model& model, Index material)
{
    if (material == none) return 0;
    const Record& own = model.materials[material];
    for (const Record& added : model.others)
        if (added.keyword == "MAT_ADD_AIRBAG_POROSITY_LEAKAGE" && added.integer("MID") == own.id)
            return added.real("X2/FLC") * added.real("X3/FAC");
    return own.keyword == "MAT_FABRIC" ? own.real("FLC/X2") * own.real("FAC/X3") : 0;
}

/// The surface: a segment set (SIDTYP = 0), or the shells of a set of parts. `leak_share` gets the share of
/// each segment that leaks.
bool read_surface(const Record& record, Airbag& bag, std::vector<double>& leak_share, Reading& reading)
{
    const Model& model = reading.model;
    const Kind kind = record.integer("SIDTYP") == 0 ? Kind::segment_set : Kind::part_set;
    const Index set = reading.find(record, "SID", kind);
    if (set == none) {
        reading.error(record, "SID",
                      fmt::format("there is no {} set {}", kind == Kind::part_set ? "part" : "segment",
                                  record.integer("SID")));
        return false;
    }
    if (kind == Kind::segment_set) {
        bag.segments = model.segment_sets[set].segments;
        return true;
    }
    std::vector<std::uint8_t> wanted(model.parts.size());
    for (Index part : model.part_sets[set].parts) wanted[part] = 1;
    for (std::size_t i = 0; i < model.shells.size(); ++i) {
        const Index part = model.shells.part[i];
        if (!wanted[part]) continue;
        bag.segments.push_back(model.shells.nodes[i]);
        leak_share.push_back(leak_share_of(model, model.parts[part].material));
    }
    if (bag.segments.empty())
        reading.error(record, "SID", fmt::format("no part of set {} has shells", record.integer("SID")));
    return !bag.segments.empty();
}

/// What all airbags have on their first card.
bool read_bag(const Record& record, Airbag& bag, std::vector<double>& leak_share, Reading& reading)
{
    bag.id = record.id != 0 ? record.id : static_cast<Id>(reading.model.airbags.size()) + 1;
    bag.title = record.title;
    bag.where = record.where;
    bag.volume_scale = real_or(record, "VSCA", 1);
    bag.pressure_scale = real_or(record, "PSCA", 1);
    refuse(record,
           {{"RBID", "activation by a rigid body is"},
            {"VINI", "a volume that is filled at the start is"},
            {"MWD", "damping of the bag is"},
            {"SPSF", "stagnation pressure is"}},
           reading);
    return read_surface(record, bag, leak_share, reading);
}

void need_positive(const Record& record, std::initializer_list<const char*> fields, Reading& reading)
{
    for (const char* field : fields) {
        if (record.real(field) <= 0)
            reading.error(record, field, fmt::format("{} is not above 0", record.real(field)));
    }
}

/// A value, or below 0 the number of a curve instead of it.
Index curve_below_zero(const Record& record, const char* field, double& value, Reading& reading)
{
    value = record.real(field);
    if (value >= 0) return none;
    const Id number = std::llround(-value);
    const Index curve = reading.look_up(Kind::curve, number);
    if (curve == none) reading.error(record, field, fmt::format("there is no curve {}", number));
    value = 0;
    return curve;
}

void read_pressure_volume(const Record& record, const Block&, Reading& reading)
{
    Airbag bag;
    std::vector<double> unused;
    const bool whole = read_bag(record, bag, unused, reading);
    PressureOfVolume content;
    content.coefficient_curve = curve_below_zero(record, "CN", content.coefficient, reading);
    content.scale = record.real("BETA");
    content.curve = reading.find(record, "LCID", Kind::curve);
    content.relaxation_curve = reading.find(record, "LCIDDR", Kind::curve);
    if (content.curve == none && content.scale == 0)
        reading.error(record, "BETA", "without a scale, or a curve LCID, there would be no pressure");
    bag.content = content;
    if (whole) reading.model.airbags.push_back(std::move(bag));
}

void read_adiabatic_gas(const Record& record, const Block&, Reading& reading)
{
    Airbag bag;
    std::vector<double> unused;
    const bool whole = read_bag(record, bag, unused, reading);
    refuse(record, {{"LCID", "a curve for the preload is"}}, reading);
    AdiabaticGas content;
    content.ratio_of_specific_heats = record.real("GAMMA");
    content.pressure = record.real("PO");
    content.ambient_pressure = record.real("PE");
    content.density = record.real("RO");
    bag.pressure_scale *= real_or(record, "PSF", 1);
    if (content.ratio_of_specific_heats <= 1)
        reading.error(record, "GAMMA", fmt::format("{} is not above 1", content.ratio_of_specific_heats));
    bag.content = content;
    if (whole) reading.model.airbags.push_back(std::move(bag));
}

/// The gas of _SIMPLE_AIRBAG_MODEL and _WANG_NEFSKE, their fields in common.
VentedGas read_gas(const Record& record, const char* inflow_field, Reading& reading)
{
    VentedGas gas;
    gas.heat_at_constant_volume = record.real("CV");
    gas.heat_at_constant_pressure = record.real("CP");
    if (gas.heat_at_constant_volume == 0)
        reading.error(record, "CV",
                      "heat capacities by molecular weight (CV = 0) are not supported: give CV and CP");
    else if (gas.heat_at_constant_pressure <= gas.heat_at_constant_volume)
        reading.error(record, "CP",
                      fmt::format("{} is not above CV, {}", gas.heat_at_constant_pressure,
                                  gas.heat_at_constant_volume));
    if (record.integer(inflow_field) < 0)
        reading.error(record, inflow_field, "inflow by a sensor or a function is not supported");
    else
        gas.inflow_curve = reading.find(record, inflow_field, Kind::curve);
    gas.inflow_temperature = record.real("T");
    gas.ambient_pressure = record.real("PE");
    gas.density = record.real("RO");
    need_positive(record, {"PE", "RO"}, reading);
    for (const char* field : {"TEXT", "A", "B", "MW", "GASC"}) record.real(field); // for CV = 0 only
    return gas;
}

void read_simple_airbag(const Record& record, const Block&, Reading& reading)
{
    Airbag bag;
    std::vector<double> unused;
    const bool whole = read_bag(record, bag, unused, reading);
    VentedGas gas = read_gas(record, "LCID", reading);
    Orifice hole;
    hole.coefficient_curve = curve_below_zero(record, "MU", hole.coefficient, reading);
    hole.coefficient_of_pressure = true;
    hole.area_curve = curve_below_zero(record, "AREA", hole.area, reading);
    gas.orifices = {hole};
    gas.outflow_curve = reading.find(record, "LOU", Kind::curve);
    bag.content = std::move(gas);
    if (whole) reading.model.airbags.push_back(std::move(bag));
}

/// C23, A23 and their curves, or those of the pores.
Orifice read_orifice(const Record& record, const char* coefficient, const char* coefficient_curve,
                     const char* area, const char* area_curve, Reading& reading)
{
    Orifice hole;
    hole.coefficient = record.real(coefficient);
    if (hole.coefficient == 0) hole.coefficient_curve = reading.find(record, coefficient_curve, Kind::curve);
    hole.area = record.real(area);
    if (hole.area == 0) hole.area_curve = reading.find(record, area_curve, Kind::curve);
    return hole;
}

void read_wang_nefske(const Record& record, const Block&, Reading& reading)
{
    Airbag bag;
    std::vector<double> leak_share;
    const bool whole = read_bag(record, bag, leak_share, reading);
    VentedGas gas = read_gas(record, "LCMT", reading);
    gas.temperature_curve = reading.find(record, "LCT", Kind::curve);
    gas.overpressure = record.real("POVER");
    gas.opening_pressure = record.real("PPOP");
    gas.conversion = real_or(record, "GC", 1);
    gas.outflow_curve = reading.find(record, "LCEFR", Kind::curve);
    refuse(record,
           {{"TVOL", "inflow from a tank test is"},
            {"LCDT", "inflow from a tank test is"},
            {"KNKDN", "a tank in place of the bag is"},
            {"IOC", "an inflator of its own is"},
            {"IOA", "an inflator of its own is"},
            {"LCBF", "an inflator of its own is"},
            {"HCONV", "heat through the fabric is"}},
           reading);
    if (record.real("A23") < 0 || record.real("AP23") < 0)
        reading.error(record, record.real("A23") < 0 ? "A23" : "AP23",
                      "holes that are a part (values below 0) are not supported");
    gas.orifices = {read_orifice(record, "C23", "LCC23", "A23", "LCA23", reading)};
    const Id option = record.integer("OPT");
    if (option == 0) {
        gas.orifices.push_back(read_orifice(record, "CP23", "LCCP23", "AP23", "LCAP23", reading));
    } else if (option == 1 || option == 2) {
        bool leaks = false;
        for (double share : leak_share) {
            leaks = leaks || share > 0;
            if (share < 0)
                reading.error(record, "OPT",
                              "leakage of fabrics by curves (FLC or FAC below 0) is not supported");
        }
        if (leaks) gas.leak_share = std::move(leak_share);
        if (leaks && option == 2)
            reading.warning(record, "OPT", "fabric that something covers leaks like the rest of it");
    } else {
        reading.error(record, "OPT",
                      fmt::format("leakage of fabrics by option {} is not supported (0: CP23 and AP23; 1, 2: "
                                  "FLC and FAC of the fabric)",
                                  option));
    }
    bag.content = std::move(gas);
    if (whole) reading.model.airbags.push_back(std::move(bag));
}

void read_linear_fluid(const Record& record, const Block&, Reading& reading)
{
    Airbag bag;
    std::vector<double> unused;
    const bool whole = read_bag(record, bag, unused, reading);
    LinearFluid fluid;
    fluid.bulk_modulus = record.real("BULK");
    fluid.density = record.real("RO");
    need_positive(record, {"RO"}, reading);
    if (record.integer("LCINT") < 0)
        reading.error(record, "LCINT", "a volume in place of an inflow (a value below 0) is not supported");
    else
        fluid.inflow_curve = reading.find(record, "LCINT", Kind::curve);
    fluid.outflow_curve = reading.find(record, "LCOUTT", Kind::curve);
    fluid.outflow_by_pressure = reading.find(record, "LCOUTP", Kind::curve);
    fluid.added_pressure = reading.find(record, "LCFIT", Kind::curve);
    fluid.bulk_curve = reading.find(record, "LCBULK", Kind::curve);
    fluid.pressure_by_volume = reading.find(record, "LCID", Kind::curve);
    if (record.real("P_LIMIT") != 0) fluid.largest_pressure = record.real("P_LIMIT");
    fluid.largest_pressure_curve = reading.find(record, "P_LIMLC", Kind::curve);
    refuse(record, {{"NONULL", "another pressure of stretched fluid than the law's is"}}, reading);
    if (fluid.bulk_curve == none && fluid.pressure_by_volume == none && fluid.bulk_modulus <= 0)
        reading.error(record, "BULK", "a fluid needs BULK, LCBULK or LCID");
    bag.content = fluid;
    if (whole) reading.model.airbags.push_back(std::move(bag));
}

constexpr Translator airbag_table[] = {
    {"AIRBAG_SIMPLE_PRESSURE_VOLUME", Phase::conditions, read_pressure_volume},
    {"AIRBAG_ADIABATIC_GAS_MODEL", Phase::conditions, read_adiabatic_gas},
    {"AIRBAG_SIMPLE_AIRBAG_MODEL", Phase::conditions, read_simple_airbag},
    {"AIRBAG_WANG_NEFSKE", Phase::conditions, read_wang_nefske},
    {"AIRBAG_LINEAR_FLUID", Phase::conditions, read_linear_fluid},
};

} // namespace

std::span<const Translator> airbag_keywords()
{
    return airbag_table;
}

} // namespace plash

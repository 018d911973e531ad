// *CONTROL family: the last block of a keyword wins.

#include "parser/reading.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace plash {
namespace {

/// LS-DYNA takes a zero for "as by default".
int whole(const Record& record, std::string_view field)
{
    return static_cast<int>(record.integer(field));
}

void read_termination(const Record& record, const Block&, Reading& reading)
{
    TimeControls& time = reading.model.controls.time;
    time.end_time = record.real("ENDTIM");
    time.end_cycle = record.integer("ENDCYC");
    time.smallest_step_factor = record.real("DTMIN");
    time.end_energy_change = record.real("ENDENG");
    time.end_mass_change = real_or(record, "ENDMAS", 1e8);
    const Id no_solution = record.integer("NOSOL");
    time.no_solution = no_solution == 1;
    if (no_solution != 0 && no_solution != 1)
        reading.error(record, "NOSOL",
                      fmt::format("{} is neither 0, a run, nor 1, its start alone", no_solution));
    if (time.end_time < 0) reading.error(record, "ENDTIM", "the end time is negative");
}

/// IMSCL, which acts if masses are scaled: 1 all parts, negative a set of parts.
void read_selective_mass(const Record& record, TimeControls& time, Reading& reading)
{
    const Id selective = record.integer("IMSCL");
    if (selective == 0) return;
    if (selective > 1) {
        reading.error(
            record, "IMSCL",
            fmt::format("{} is neither 1, all parts, nor minus the number of a set of parts", selective));
        return;
    }
    time.selective_mass = true;
    time.selective_parts.clear();
    if (time.mass_scaled_step == 0 && time.mass_scaled_share == 0)
        reading.warning(record, "IMSCL", "has no effect without DT2MS: no mass is added");
    if (selective == 1) return;
    const Index set = reading.look_up(Kind::part_set, -selective);
    if (set == none) {
        reading.error(record, "IMSCL", fmt::format("there is no set of parts {}", -selective));
        return;
    }
    time.selective_parts = reading.model.part_sets[set].parts;
    if (time.selective_parts.empty())
        reading.error(record, "IMSCL", fmt::format("the set of parts {} is empty", -selective));
}

void read_timestep(const Record& record, const Block&, Reading& reading)
{
    TimeControls& time = reading.model.controls.time;
    time.initial_step = record.real("DTINIT");
    time.step_scale = real_or(record, "TSSFAC", 0.9);
    time.shell_length_rule = whole(record, "ISDO");
    time.where = record.where;
    time.mass_scaled_step = record.real("DT2MS");
    time.mass_scaled_share = record.real("DT2MSF");
    if (time.mass_scaled_share < 0)
        reading.error(record, "DT2MSF", "the share of the first step is negative");
    if (time.mass_scaled_share != 0 && time.mass_scaled_step != 0)
        reading.warning(record, "DT2MSF", "has no effect beside DT2MS");
    if (time.mass_scaled_share > 0 && time.mass_scaled_share <= 1 && time.mass_scaled_step == 0)
        reading.warning(record, "DT2MSF",
                        fmt::format("{} of the first step asks for no more than elements have at the start, "
                                    "and masses are scaled then alone",
                                    time.mass_scaled_share));
    read_selective_mass(record, time, reading);
    time.shell_step = record.real("TSLIMT");
    if (time.shell_step < 0) reading.error(record, "TSLIMT", "the smallest step of shells is negative");
    time.largest_step_curve = reading.find(record, "LCTM", Kind::curve);
    const Id erode = record.integer("ERODE");
    time.erode_small_step = erode % 10 == 1;
    time.erode_small_shells = erode / 10 % 10 == 1;
    time.erode_small_beams = erode / 100 == 1;
    if (erode < 0 || erode > 111 || erode % 10 > 1 || erode / 10 % 10 > 1)
        reading.error(
            record, "ERODE",
            fmt::format("{} is no sum of 1 (solids, thick shells), 10 (shells) and 100 (beams)", erode));
    if (time.step_scale < 0) reading.error(record, "TSSFAC", "the scale of the step is negative");
}

/// IDRFLG = -999: no dynamic relaxation; 0: if a curve asks for it (SIDR); 1: from the start; -1: the same
/// with histories; 3 and -3: as 1 and -1, with the kinetic energy of some parts; 5: solve for the
/// equilibrium; 2: nodes go to places of a file.
void read_relaxation(const Record& record, const Block&, Reading& reading)
{
    RelaxationControls& relaxation = reading.model.controls.relaxation;
    relaxation.where = record.where;
    relaxation.flag = whole(record, "IDRFLG");
    constexpr int known[] = {-999, -3, -1, 0, 1, 2, 3, 5};
    if (std::find(std::begin(known), std::end(known), relaxation.flag) == std::end(known)) {
        reading.error(
            record, "IDRFLG",
            fmt::format("{} is not supported; 1 and 3 (-1, -3) relax explicitly, 0 if a curve asks for "
                        "it, 2 goes to a prescribed geometry, 5 solves for the equilibrium, -999 never",
                        relaxation.flag));
    }
    relaxation.check_cycles = record.integer("NRCYCK") == 0 ? 250 : whole(record, "NRCYCK");
    relaxation.tolerance = real_or(record, "DRTOL", 0.001);
    relaxation.factor = real_or(record, "DRFCTR", 0.995);
    relaxation.end_time = record.real("DRTERM");
    relaxation.step_scale = record.real("TSSFDR");
    if (relaxation.check_cycles < 1) reading.error(record, "NRCYCK", "the number of cycles is negative");
    if (!(relaxation.factor > 0 && relaxation.factor <= 1))
        reading.error(record, "DRFCTR", fmt::format("{} is not between 0 and 1", relaxation.factor));
    if (record.integer("IRELAL") != 0)
        reading.error(record, "IRELAL", "automatic choice of the factor is not supported; leave it at 0");
    if (relaxation.flag == 2) {
        if (record.integer("NC") != 0) relaxation.geometry_cycles = whole(record, "NC");
        if (relaxation.geometry_cycles < 1) reading.error(record, "NC", "the number of cycles is negative");
        if (record.integer("NP") != 0)
            reading.error(
                record, "NP",
                "rotations of parts about vectors are not supported; nodes move straight with NP = 0");
    }
    if (std::abs(relaxation.flag) != 3) return;
    const Index set = reading.find(record, "DRPSET", Kind::part_set);
    if (set != none) relaxation.parts = reading.model.part_sets[set].parts;
    if (record.integer("DRPSET") == 0)
        reading.error(record, "DRPSET", fmt::format("IDRFLG = {} needs a set of parts", relaxation.flag));
}

/// Only structures are computed: SOLN = 1 and 2 ask for heat.
void read_solution(const Record& record, const Block&, Reading& reading)
{
    reading.heat_only = record.integer("SOLN") == 1;
    if (record.integer("SOLN") != 0)
        reading.error(record, "SOLN", "thermal analysis is not supported; 0 is structural analysis");
}

void read_hourglass(const Record& record, const Block&, Reading& reading)
{
    ElementControls& elements = reading.model.controls.elements;
    elements.hourglass_type = whole(record, "IHQ");
    elements.hourglass_coefficient = real_or(record, "QH", 0.1);
    reading.check_hourglass(record, "QH");
}

void read_bulk_viscosity(const Record& record, const Block&, Reading& reading)
{
    ElementControls& elements = reading.model.controls.elements;
    elements.quadratic_viscosity = real_or(record, "Q1", 1.5);
    elements.linear_viscosity = real_or(record, "Q2", 0.06);
    elements.bulk_viscosity_type = whole(record, "TYPE");
}

void read_shell(const Record& record, const Block&, Reading& reading)
{
    ElementControls& elements = reading.model.controls.elements;
    elements.shell_warp_angle = real_or(record, "WRPANG", 20);
    elements.sort_triangles = whole(record, "ESORT");
    elements.normal_update = whole(record, "IRNXX");
    elements.thickness_change = whole(record, "ISTUPD");
    elements.shell_theory = whole(record, "THEORY");
    elements.warping = whole(record, "BWC");
    elements.thickness_integration = whole(record, "INTGRD");
    elements.plane_stress_plasticity = whole(record, "MITER");
    elements.projection = whole(record, "PROJ");
}

void read_solid(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.elements.sort_solids = whole(record, "ESORT");
}

constexpr Translator control_table[] = {
    {"CONTROL_TERMINATION", Phase::conditions, read_termination},
    {"CONTROL_TIMESTEP", Phase::conditions, read_timestep},
    {"CONTROL_SOLUTION", Phase::conditions, read_solution},
    {"CONTROL_DAMPING", Phase::conditions, read_relaxation},
    {"CONTROL_DYNAMIC_RELAXATION", Phase::conditions, read_relaxation},
    {"CONTROL_HOURGLASS", Phase::conditions, read_hourglass},
    {"CONTROL_BULK_VISCOSITY", Phase::conditions, read_bulk_viscosity},
    {"CONTROL_SHELL", Phase::conditions, read_shell},
    {"CONTROL_SOLID", Phase::conditions, read_solid},
};

} // namespace

std::span<const Translator> control_keywords()
{
    return control_table;
}

} // namespace plash

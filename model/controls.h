#pragma once

#include "model/conditions.h"

#include <map>

namespace plash {

/// *CONTROL_TERMINATION and *CONTROL_TIMESTEP.
struct TimeControls {
    double end_time = 0;             ///< ENDTIM [time]
    long end_cycle = 0;              ///< ENDCYC; 0: no limit
    double smallest_step_factor = 0; ///< DTMIN: stop when the step falls below this share of the first one
    double end_energy_change = 0;    ///< ENDENG [percent]; 0: no limit
    double end_mass_change = 1e8;    ///< ENDMAS [percent]
    double initial_step = 0;         ///< DTINIT [time]; 0: found from the elements
    double step_scale = 0.9;         ///< TSSFAC
    int shell_length_rule = 0;       ///< ISDO
    double mass_scaled_step = 0;     ///< DT2MS [time]; negative: add mass only where the step is smaller
    double mass_scaled_share = 0;    ///< DT2MSF: -DT2MS over the smallest step of the start; 0: DT2MS holds
    bool selective_mass = false;     ///< IMSCL: added mass leaves rigid motion of an element alone
    std::vector<Index> selective_parts; ///< |IMSCL|: of these parts; empty: of all
    Index largest_step_curve = none;    ///< LCTM
    bool no_solution = false;           ///< NOSOL: the run ends after the first cycle's forces
    double shell_step = 0;              ///< TSLIMT [time]: shells soften rather than ask for less; 0: none
    bool erode_small_step =
        false; ///< last digit of ERODE: solids and thick shells go when their step falls below DTMIN
    bool erode_small_shells = false; ///< digit of tens: shells likewise
    bool erode_small_beams = false;  ///< digit of hundreds: beams likewise
    Location where;                  ///< of *CONTROL_TIMESTEP
};

/// *CONTROL_HOURGLASS, *CONTROL_BULK_VISCOSITY, *CONTROL_SHELL, *CONTROL_SOLID.
struct ElementControls {
    int hourglass_type = 0;             ///< IHQ; 0: LS-DYNA's default of the element
    double hourglass_coefficient = 0.1; ///< QH
    double quadratic_viscosity = 1.5;   ///< Q1
    double linear_viscosity = 0.06;     ///< Q2
    int bulk_viscosity_type = 1;        ///< TYPE
    double shell_warp_angle = 20;       ///< WRPANG [degree]
    int sort_triangles = 0;             ///< ESORT of *CONTROL_SHELL
    int normal_update = -1;             ///< IRNXX
    int thickness_change = 0;           ///< ISTUPD
    int shell_theory = 2;               ///< THEORY: formulation of sections that leave ELFORM at 0
    int warping = 2;                    ///< BWC: 1 Belytschko-Wong-Chiang, 2 Belytschko-Tsay
    int plane_stress_plasticity = 1;    ///< MITER
    int projection = 0;                 ///< PROJ
    int thickness_integration = 0;      ///< INTGRD: 0 Gauss, 1 Lobatto, where a section names no rule
    int sort_solids = 0;                ///< ESORT of *CONTROL_SOLID
};

/// *CONTROL_DYNAMIC_RELAXATION: whether and how the run begins with a search for equilibrium.
struct RelaxationControls {
    int flag = 0;              ///< IDRFLG; 0: only if a curve asks for it (SIDR)
    bool curves_ask = false;   ///< some curve has SIDR = 1 or 2
    int check_cycles = 250;    ///< NRCYCK: cycles between two looks at the kinetic energy
    int geometry_cycles = 100; ///< NC: with IDRFLG = 2, in which nodes go to the prescribed geometry
    double tolerance = 0.001;
    double factor = 0.995;    ///< DRFCTR: on velocities in each cycle
    double end_time = 0;      ///< DRTERM [time]; 0: none
    double step_scale = 0;    ///< TSSFDR; 0: TSSFAC
    std::vector<Index> parts; ///< DRPSET: whose kinetic energy decides; empty: all
    Location where;

    bool active() const { return flag != -999 && (flag != 0 || curves_ask); }
};

/// One *DATABASE_<name> request: how often a result file is written.
struct OutputRequest {
    double interval = 0; ///< [time]; 0: not asked for
    Index interval_curve = none;
    int states = 0; ///< NPLTC: number of states in place of an interval; 0: not asked for
    int binary = 0; ///< BINARY: 1 ASCII, 2 binout, 3 both; 0: default
    Location where;
};

/// *DATABASE_BINARY_D3DUMP and *DATABASE_BINARY_RUNRSF.
struct RestartRequest {
    long dump_cycles = 0;    ///< between d3dump files; 0: only on request
    long running_cycles = 0; ///< between runrsf files; 0: not asked for
    int running_files = 1;   ///< NR: how many runrsf files are overwritten in turn
};

/// *DATABASE family.
struct OutputControls {
    std::map<std::string, OutputRequest> ascii; ///< by lower-case file name: "glstat", "nodout" ...
    OutputRequest d3plot;
    long relaxation_states = 0; ///< *DATABASE_BINARY_D3DRLF: looks at the kinetic energy a state; 0: none
    RestartRequest restart;
    std::vector<Index> history_nodes;
    std::vector<Index> history_shells;
    std::vector<Index> history_solids;
    std::vector<Index> history_thick_shells;
    std::vector<Index> history_beams;
    std::vector<Index> history_particles; ///< nodes of *DATABASE_HISTORY_SPH
    std::map<std::string, double> extent; ///< *DATABASE_EXTENT_BINARY by field name, where the deck has it

    /// A field of *DATABASE_EXTENT_BINARY; 0 where the deck leaves it out.
    int extent_of(const std::string& field) const
    {
        const auto found = extent.find(field);
        return found == extent.end() ? 0 : static_cast<int>(found->second);
    }
    /// STRFLG, whose last digit asks for the strains of elements.
    bool strains() const { return extent_of("STRFLG") % 10 == 1; }
};

struct Controls {
    TimeControls time;
    ElementControls elements;
    RelaxationControls relaxation;
    OutputControls output;
};

} // namespace plash

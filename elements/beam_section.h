#pragma once

#include "model/model.h"

#include <vector>

namespace plash {

/// One integration point of a cross section.
struct BeamPoint {
    double s = 0, t = 0; ///< from the line of the nodes [length]
    double share = 0;    ///< of the area [-]
};

/// The cross section of the beams of a part (*SECTION_BEAM), the same over their length.
struct BeamSection {
    int formulation = 1;           ///< ELFORM
    double area = 0;               ///< [length^2]
    double inertia_s = 0;          ///< about the s axis, integral of t^2 [length^4]
    double inertia_t = 0;          ///< about the t axis, integral of s^2 [length^4]
    double torsion = 0;            ///< J [length^4]
    double shear_area = 0;         ///< SA of resultant beams; 0: they do not shear [length^2]
    double shear_factor = 1;       ///< SHRF of integrated beams
    double initial_stress = 0;     ///< STRESS of trusses at the start [stress]
    double added_mass = 0;         ///< NSM: mass of things that are not structure [mass/length]
    std::vector<BeamPoint> points; ///< of integrated beams

    double larger_inertia() const { return inertia_s > inertia_t ? inertia_s : inertia_t; }
    /// Bends alike in all directions, so that it needs no third node.
    bool isotropic() const;
};

/// Reads and checks the section of a part; DeckError for what is not supported.
///
/// Points of a rectangle are the product rule that QR/IRID names. Those of a tube stand on circles: four
/// where a rectangle has 2 x 2, at the radius that gives the exact moments of inertia (LS-DYNA's own points,
/// by its elout); eight on each of two circles, which share the area as Gauss points of the squared radius
/// do, where a rectangle has more.
BeamSection beam_section(const Model&, const Part&);

/// Mass and isotropic rotary inertia that an element gives to each of its ends.
struct BeamMass {
    double mass = 0;    ///< [mass]
    double inertia = 0; ///< [mass length^2]
};

/// Half the mass each. The inertia is that of LS-DYNA's resultant beam, mass (I / A + length^2 / 12), which
/// its formula of the stable step shows (Hallquist 2006, 'Time step calculations for beam elements'), or more
/// where the shear of a one-point beam would otherwise limit the step. shear_modulus_ratio  G / E times the
/// shear factor; 0 for beams without transverse shear energy step_scale           TSSFAC
BeamMass beam_mass(const BeamSection&, double density, double length, double shear_modulus_ratio,
                   double step_scale);

} // namespace plash

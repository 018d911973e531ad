#pragma once

#include "elements/beam_section.h"

namespace plash {

/// Points and properties of a section whose QR/IRID names an *INTEGRATION_BEAM (-number).
///
/// User points (ICST = 0): S and T from -1 to 1 over the thicknesses TS, TT of the section, weights WF as
/// shares of the area RA TS TT. Standard sections (ICST): 1 W (width W, flanges TF, depth D, web TW; W along
/// s, D along t), 5 rectangular tube (the same), 8 circle (radius D1), 9 tube (outer radius D1, inner D2).
/// Each wall of a standard section has 2 points across and 4 K along, by Gauss, so that area and moments of
/// inertia are exact; LS-DYNA's own points are fewer. Others are refused: where their axis lies is not
/// described.
void read_beam_integration(const Model&, const Record& section, Id number, double ts, double tt,
                           BeamSection& result);

/// Adds a tube's points on circles: four at the radius that gives the exact moments of inertia, or eight on
/// each of two circles.
void add_tube_points(double outer_radius, double inner_radius, int rule_points, BeamSection& result);

/// Area moments of the section about its axes from its points.
void take_inertia_of_points(BeamSection& result);

} // namespace plash

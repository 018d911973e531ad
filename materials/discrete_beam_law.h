#pragma once

#include "model/model.h"

#include <array>
#include <memory>
#include <span>
#include <string>

namespace plash {

/// The six freedoms of a discrete beam: along its local axes r, s, t, and about them.
using DiscreteFreedoms = std::array<double, 6>;

/// What the law of a discrete beam sees and keeps. Laws that act along the line of the nodes use the first
/// freedom alone.
struct DiscreteBeamPoint {
    DiscreteFreedoms way{};   ///< relative motion of node 2 since the start [length], [angle]
    DiscreteFreedoms rate{};  ///< of it, at n - 1/2
    DiscreteFreedoms force{}; ///< resultants at n, tension positive [force], [moment]
    double length = 0;        ///< at n [length]
    double start_length = 0;  ///< [length]
    std::array<double, 18> history{};
    bool failed = false;
};

/// A law of discrete beams (*SECTION_BEAM, ELFORM 6). One call takes all beams of a part.
class DiscreteBeamLaw {
public:
    virtual ~DiscreteBeamLaw() = default;

    /// New resultants from the ways and rates of the points, which are those of time n.
    virtual void advance(std::span<DiscreteBeamPoint> points, double time, double time_step) const = 0;

    /// Largest stiffness that each freedom may show, for the stable step [force/length], [moment/angle].
    virtual DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const = 0;
    /// Largest damping constant of each freedom.
    virtual DiscreteFreedoms damping(const DiscreteBeamPoint&) const { return {}; }

    double density = 0;       ///< RO [mass/volume]
    bool along_nodes = false; ///< acts on the line between the nodes and not in local axes
    bool cable = false;       ///< has an area (CA), and a volume from it where the section gives none
    double area = 0;          ///< CA of the section, set by the element [length^2]
    double length_offset = 0; ///< OFFSET of the section, set by the element [length]
    std::string notice;       ///< what the user should know of the law; empty: nothing
};

/// The law of a material. DeckError where it is none of discrete beams.
std::unique_ptr<DiscreteBeamLaw> make_discrete_beam_law(const Record& material, const Model& model);

/// A curve as force over way or rate: one that begins at zero or above holds alike, with opposite sign, below
/// zero. No points where the field is zero.
Curve odd_curve(const Record& material, const char* field, const Model& model);

} // namespace plash

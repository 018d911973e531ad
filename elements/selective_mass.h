#pragma once

#include "core/term.h"
#include "math/matrix3.h"

#include <memory>

namespace plash {

/// Selective mass scaling (*CONTROL_TIMESTEP IMSCL; Olovsson, Simonsson & Unosson 2005, 'Selective mass
/// scaling for explicit finite element analyses'): accelerations follow from
///
///     (M + C) a = f,   C = sum of X - X R (R^T X R)^-1 R^T X over the elements,
///
/// X the mass (and rotary inertia) that ordinary scaling would add to the corners of an element, R its six
/// rigid motions about the place where it stands. The paper takes out translations alone (its equation of the
/// element's added mass, 8 I - 1 1^T); with rotations as well no rigid motion of an element feels C, momentum
/// and angular momentum are those of M, and what distorts an element has the mass of ordinary scaling: an
/// element's own frequencies, and so the bound on the step, are the same.
///
/// C acts on the rate of the velocity as the element sees it, a - w x v with the mean spin w of the element:
/// a body that turns is not pressed inward by it.
///
/// Conjugate gradients with the diagonal of M + C, from the accelerations of the last cycle on. The forces of
/// the state become f - C a, whose sum and moment are those of f to round-off however good a is; supports and
/// driven nodes then get their exact reactions, since the solution knows their accelerations
/// (Term::list_held). Work per cycle: a few products with C, for the elements that are scaled.
class SelectiveMass : public Term {
public:
    explicit SelectiveMass(SelectiveMasses masses) : masses_(std::move(masses)) {}

    /// To be called once the scene is whole and nodes that the loop does not move have no mass any more
    /// (rigid bodies and ties move them). These cannot take part: their elements are scaled the ordinary way,
    /// on the other nodes; that mass goes into the state. holders  terms whose held freedoms the solution has
    /// to know
    void start(std::vector<const Term*> holders, State& state);

    std::string_view name() const override { return "selective mass scaling"; }
    std::size_t items() const override { return masses_.elements.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.kinetic += kinetic_; }
    std::vector<std::string> notices(const State&) const override;
    void serialise(Archive& archive) override { archive(motion_, spin_, kinetic_); }

    double ordinary_mass() const { return ordinary_mass_; } ///< that had to be added in full [mass]
    long iterations() const { return iterations_; }         ///< of conjugate gradients in the last cycle

private:
    using Vectors = std::vector<Vec3>;
    /// Values at the nodes that take part: accelerations, forces ...
    struct Field {
        Vectors linear, angular; ///< angular is empty without shells
    };
    struct Geometry {
        double mass = 0;   ///< of X
        Vec3 center{};     ///< of X
        Matrix3 inertia{}; ///< inverse of that of X about its center
        bool alive = true;
    };
    struct HeldNode {
        Index node; ///< of those that take part
        bool rotation;
        int count = 0;
        Vec3 direction[3]; ///< orthonormal
        double acceleration[3];
    };

    SelectiveMasses masses_;
    std::vector<Index> nodes_;       ///< of the State, that take part
    std::vector<Index> place_;       ///< by corner: into nodes_
    std::vector<std::size_t> slots_; ///< corners by node ...
    std::vector<std::size_t> first_; ///< ... and where those of each node begin
    std::vector<const Term*> holders_;
    std::vector<Index> place_of_node_; ///< of the State: into nodes_, or none
    bool rotates_ = false;
    double ordinary_mass_ = 0;
    std::size_t ordinary_count_ = 0;
    double kinetic_ = 0; ///< of C [energy]
    long iterations_ = 0;

    Vectors motion_, spin_; ///< accelerations of the last cycle
    std::vector<Geometry> geometry_;
    std::vector<double> mass_, inertia_;           ///< of M at the nodes
    std::vector<double> more_mass_, more_inertia_; ///< diagonal of C, from above
    Field corner_;                                 ///< products by corner
    std::vector<HeldNode> held_;

    void number_nodes(std::size_t node_count);
    void scale_the_ordinary_way(State& state);
    void place_elements(const State& state);
    void list_held_nodes(const Clock& clock, const State& state);
    Field zero() const;
    void hold(Field& field, bool at_rest) const;
    /// result = C field, or with `spun` C (w x field), w the mean spin of the element in the field.
    void multiply(const State& state, const Field& field, bool spun, Field& result);
    Field solve(const State& state, const Field& right);
    double product(const Field& a, const Field& b) const;
};

} // namespace plash

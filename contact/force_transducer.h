#pragma once

#include "contact/surface_contact.h"

namespace plash {

/// *CONTACT_FORCE_TRANSDUCER_PENALTY: measures what penalty contacts do to a surface, or between two
/// surfaces, and adds nothing. With both sides given, touches between them count; with the slave side alone,
/// all contact forces on its nodes.
class ForceTransducer : public Term {
public:
    /// contacts   those that it listens to; they must outlive it
    ForceTransducer(const Contact& contact, const Model& model, const std::vector<PartData>& parts,
                    std::vector<const SurfaceContact*> contacts);

    std::string_view name() const override { return "force transducer"; }
    void collect(const State& state, ElementResults& results) const override;

private:
    /// Which nodes (by State index) and parts are of a side.
    struct Side {
        std::vector<bool> node, part;
        bool by_part = false; ///< facets belong by their part, else by their nodes
        double mass = 0;

        bool holds(const ContactMesh& mesh, Index facet) const;
    };
    const Contact& contact_;
    std::vector<const SurfaceContact*> contacts_;
    Side slave_, master_;
    bool between_; ///< both sides are given

    static Side make_side(const ContactSide& side, const Contact& contact, const Model& model,
                          const std::vector<PartData>& parts);
    void add_facing(const ContactMesh& mesh, const FacingSegments& facing, const State& state,
                    ElementResults::ContactForce& sum) const;
    void add(const SurfaceContact& source, const State& state, ElementResults::ContactForce& sum) const;
};

} // namespace plash

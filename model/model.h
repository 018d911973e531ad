#pragma once

#include "math/curve.h"
#include "model/airbags.h"
#include "model/conditions.h"
#include "model/contact.h"
#include "model/controls.h"
#include "model/mesh.h"
#include "model/record.h"
#include "model/rigid.h"
#include "model/stand_ins.h"

#include <map>
#include <stdexcept>

namespace plash {

/// A *DEFINE_CURVE: points with scale and offset already applied.
struct NamedCurve {
    Id id = 0;
    std::string title;
    Location where;
    Curve curve;
    /// SIDR: loads and motions that follow the curve act in these phases of a run.
    bool in_transient = true, in_relaxation = false;
};

/// A *DEFINE_TABLE: one curve for each abscissa value, rising.
struct NamedTable {
    Id id = 0;
    std::string title;
    Location where;
    std::vector<double> abscissa;
    std::vector<Index> curves; ///< into Model::curves, one for each value
};

/// A *DEFINE_COORDINATE_...: origin and three unit axes in the global frame at the start.
struct CoordinateSystem {
    Id id = 0;
    Vec3 origin{};
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    std::array<Index, 3> nodes{none, none, none}; ///< origin, on x, in the xy plane: the axes turn with them
    Location where;
};

/// A *DEFINE_VECTOR: from tail to head [length].
struct NamedVector {
    Id id = 0;
    Vec3 tail{}, head{};
    Location where;
};

/// A *DEFINE_BOX with its number.
struct NamedBox {
    Id id = 0;
    Box box;
    Location where;
};

/// What a deck says, resolved and checked: plain data in the deck's own units, every reference an index.
struct Model {
    std::string title;
    std::vector<std::string> files; ///< deck and includes, as opened

    Nodes nodes;
    ShellElements shells;
    SolidElements solids;
    BeamElements beams;
    ThickShellElements thick_shells;
    TetrahedronElements tetrahedra;
    DiscreteElements discretes;
    NodalMasses masses;
    ParticleElements particles;
    std::vector<StandIns> stand_ins; ///< which of the particles wait in solids

    std::vector<Part> parts;
    std::vector<Record> sections;
    std::vector<Record> materials;
    std::vector<Record> equations_of_state;
    std::vector<Record> hourglass;
    std::vector<NamedCurve> curves;
    std::vector<NamedTable> tables;
    std::vector<CoordinateSystem> coordinate_systems;
    std::vector<NamedVector> vectors;
    std::vector<NamedBox> boxes;

    std::vector<NodeSet> node_sets;
    std::vector<SegmentSet> segment_sets;
    std::vector<PartSet> part_sets;
    std::vector<ElementSet> shell_sets;
    std::vector<ElementSet> solid_sets;
    std::vector<ElementSet> beam_sets;
    std::vector<ElementSet> thick_shell_sets;
    std::vector<ElementSet> discrete_sets;

    std::vector<FixedNodes> fixed_nodes;
    std::vector<PrescribedMotion> prescribed_motions;
    std::vector<NodalLoad> nodal_loads;
    std::vector<BodyLoad> body_loads;
    std::vector<PressureLoad> pressure_loads;
    std::vector<BlastLoad> blast_loads;
    std::vector<Airbag> airbags;
    std::vector<NodeDamping> dampings;
    std::vector<StiffnessDamping> stiffness_dampings;
    std::vector<NonReflectingBoundary> non_reflecting_boundaries;
    std::vector<Termination> terminations;
    std::vector<CrossSection> cross_sections; ///< at most 64
    std::vector<NodalForceGroup> nodal_force_groups;
    std::vector<InitialVelocity> initial_velocities;
    std::vector<RigidBodyVelocity> rigid_body_velocities;
    std::vector<NodalRigidBody> nodal_rigid_bodies;
    std::vector<RigidMerge> rigid_merges;
    std::vector<ExtraNodes> extra_nodes;
    std::vector<RigidBodyLoad> rigid_body_loads;
    std::vector<Joint> joints;
    std::vector<JointStiffness> joint_stiffnesses;
    std::vector<BeamPreload> beam_preloads;
    std::vector<RigidWall> rigid_walls;
    std::vector<Contact> contacts;
    std::map<Index, PartInertia> part_inertias; ///< by part, where the deck has *PART_INERTIA
    std::map<Index, PartContact> part_contacts; ///< by part, where the deck has *PART_CONTACT
    std::vector<Record> others;                 ///< definitions of every other keyword, as records

    Controls controls;

    /// "deck.k:12" for messages; empty when `where` points nowhere.
    std::string place(const Location& where) const;

    /// Position of the curve or table with this number (fields like LCSS name either); `none`: there is no
    /// such.
    Index find_curve(Id id) const;
    Index find_table(Id id) const;

    /// The part has no stresses: *MAT_RIGID or *DEFORMABLE_TO_RIGID.
    bool is_rigid(Index part) const;
    /// Number that the deck gives to a body.
    Id body_id(BodyNumber body) const;
    const std::string& body_title(BodyNumber body) const;
};

/// Bricks are what has faces: the solids, and behind them the thick shells, numbered through.
inline std::size_t brick_count(const Model& model)
{
    return model.solids.size() + model.thick_shells.size();
}
inline const std::array<Index, 8>& brick_nodes(const Model& model, Index brick)
{
    const auto solids = static_cast<Index>(model.solids.size());
    return brick < solids ? model.solids.nodes[brick] : model.thick_shells.nodes[brick - solids];
}
inline Index brick_part(const Model& model, Index brick)
{
    const auto solids = static_cast<Index>(model.solids.size());
    return brick < solids ? model.solids.part[brick] : model.thick_shells.part[brick - solids];
}

/// All nodes of a ten-node tetrahedron; nullptr for other bricks.
inline const std::array<Index, 10>* ten_nodes(const Model& model, Index brick)
{
    const std::vector<Index>& rows = model.solids.ten_nodes;
    if (brick >= static_cast<Index>(rows.size()) || rows[brick] == none) return nullptr;
    return &model.tetrahedra.nodes[rows[brick]];
}

/// Calls visit(elements) for every list of elements that have an id, a part and nodes.
template <class Visit>
void for_each_topology(const Model& model, Visit&& visit)
{
    visit(model.shells);
    visit(model.solids);
    visit(model.beams);
    visit(model.thick_shells);
    visit(model.tetrahedra);
    visit(model.discretes);
}

/// A fault of the deck that is found while physics is set up: names file, line, keyword and field.
class DeckError : public std::runtime_error {
public:
    DeckError(Location where, const std::string& message) : std::runtime_error(message), where(where) {}
    Location where;
};

} // namespace plash

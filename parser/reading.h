#pragma once

#include "model/model.h"
#include "parser/deck.h"
#include "parser/definition_reader.h"
#include "parser/id_table.h"
#include "parser/transformation.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <unordered_set>

namespace plash {

/// Work that turns blocks into the Model goes in this order, so that a definition finds what it refers to.
enum class Phase : std::uint8_t {
    nodes,
    properties, ///< sections, materials, curves, coordinate systems ...
    parts,
    elements,
    sets,
    conditions ///< everything else
};
inline constexpr Phase last_phase = Phase::conditions;

/// A set as the deck describes it, until all elements and other sets are known.
struct PendingSet {
    Kind kind;
    Index index; ///< into the Model's sets of this kind
    Record record;
    const Block* block;
};

/// A field that names a curve or a table, and what it takes its points to be.
struct CurveUse {
    std::string keyword, field;
    std::optional<CurveDimensions> dimensions; ///< nothing: Plash does not know
};

/// *CONSTRAINED_NODAL_RIGID_BODY, until its node set is known: belongs to the nodal rigid body at its place.
struct PendingBody {
    Record record;
    const Block* block;
    bool held, has_inertia;
};

/// *DEFINE_ADAPTIVE_SOLID_TO_SPH, until part sets are known.
struct PendingStandIns {
    Record record;
    const Block* block;
};

/// *CONTROL_CONTACT, until all contacts are read.
struct ContactDefaults {
    double penalty_scale = 0.1;
    int penalty_option = 1;
    int thickness_option = 0;
    int initial_penetration = 0;
    bool keep_eroded_nodes = false;
    bool limit_thickness = true;
    bool square_edges = false;
    bool one_way_erosion = false; ///< NSEROD
    bool drop_symmetry_faces = false, friction_energy = false, stiffness_of_nodes = false;
    PartContact of_parts; ///< what parts have that *PART_CONTACT says nothing of
};

/// Everything that translators work on: the deck as written, the Model that grows, numbers seen so far.
struct Reading {
    const Deck& deck;
    Model& model;
    Report& report;
    Reading(const Deck& the_deck, Model& the_model, Report& the_report)
        : deck(the_deck), model(the_model), report(the_report)
    {}

    std::array<IdTable, static_cast<std::size_t>(Kind::count)> ids;

    std::map<Id, Record> transformations; ///< *DEFINE_TRANSFORMATION
    std::vector<std::pair<const Block*, Index>>
        moved_nodes;                                   ///< first node of each block that an include moves
    std::map<const IncludeTransform*, Affine> motions; ///< of the includes that move what they hold
    std::vector<std::pair<Index, const UnitFactors*>> foreign_curves,
        foreign_tables; ///< of includes with units of their own
    std::map<Id, std::vector<CurveUse>>
        curve_uses; ///< by the number of a curve or table; filled when there are such
    std::vector<PendingSet> pending_sets;
    std::vector<PendingStandIns> pending_stand_ins;
    std::vector<Record> node_transforms; ///< *NODE_TRANSFORM, until the sets are known
    std::vector<PendingBody> pending_bodies;
    std::vector<Index> parts_without_section, parts_without_material; ///< SECID, MID left at zero
    std::vector<Index> body_load_parts;                               ///< of *LOAD_BODY_PARTS
    bool heat_only = false; ///< *CONTROL_SOLUTION SOLN = 1: parts need no structural material
    ContactDefaults contact_defaults;

    std::unordered_set<Id> used[static_cast<std::size_t>(Kind::count)]; ///< numbers that something refers to

    /// Nodes and elements are not counted this way: there may be millions.
    void use(Kind kind, Id id)
    {
        if (kind > Kind::seatbelt) used[static_cast<std::size_t>(kind)].insert(id);
    }
    /// Where a curve may stand, a table may stand as well.
    bool is_used(Kind kind, Id id) const
    {
        return used[static_cast<std::size_t>(kind)].contains(id) ||
               (kind == Kind::table && is_used(Kind::curve, id));
    }

    /// Position of the thing that a definition refers to; `none` when there is no such.
    Index look_up(Kind kind, Id id)
    {
        use(kind, id);
        return table(kind).find(id);
    }

    IdTable& table(Kind kind) { return ids[static_cast<std::size_t>(kind)]; }

    /// The nodes N1 to N4 of a segment; a triangle (N4 = 0) repeats the third. Nothing where one is missing,
    /// which is reported with all references.
    std::optional<std::array<Index, 4>> find_segment(const Record& record);

    /// Position of the thing that an id field names; `none` when the field is empty or names nothing
    /// (dangling references are reported for all keywords alike, not here).
    Index find(const Record& record, std::string_view field, Kind kind)
    {
        const Id id = record.integer(field);
        return id == 0 ? none : look_up(kind, id);
    }

    /// Body with a number: a part or a nodal rigid body; `none` for zero and where there is neither.
    BodyNumber find_body(Id id);

    /// What the include of a block does to its points and directions.
    Affine motion_of(const Block& block) const
    {
        const auto found = motions.find(block.transform);
        return found == motions.end() ? Affine{} : found->second;
    }

    /// Warns of a coefficient of hourglass control of type IHQ that does not damp or does so too fast:
    /// viscous and stiffness forms (0 to 5) are meant for up to 0.15 (LS-DYNA manual, QM of *HOURGLASS).
    void check_hourglass(const Record& record, std::string_view field);
    void error(const Record& record, std::string_view field, std::string text);
    void warning(const Record& record, std::string_view field, std::string text);
};

/// Turns one definition of a keyword into the Model.
using Translate = void (*)(const Record& record, const Block& block, Reading& reading);

/// Turns a whole block into the Model without Records: the fast path of long lists.
using TranslateBlock = void (*)(const Block& block, Reading& reading);

/// One line of a family's list of keywords.
struct Translator {
    std::string_view keyword; ///< canonical name; a trailing `*` stands for any ending
    Phase phase;
    Translate definition = nullptr;
    TranslateBlock block = nullptr;
};

/// The keyword families, one function for each file of parser/keywords.
std::span<const Translator> node_keywords();
std::span<const Translator> solid_keywords();
std::span<const Translator> shell_keywords();
std::span<const Translator> element_keywords();
std::span<const Translator> property_keywords();
std::span<const Translator> part_keywords();
std::span<const Translator> curve_keywords();
std::span<const Translator> geometry_keywords();
std::span<const Translator> set_keywords();
std::span<const Translator> boundary_keywords();
std::span<const Translator> load_keywords();
std::span<const Translator> damping_keywords();
std::span<const Translator> termination_keywords();
std::span<const Translator> initial_keywords();
std::span<const Translator> rigid_wall_keywords();
std::span<const Translator> contact_keywords();
std::span<const Translator> control_keywords();
std::span<const Translator> constrained_keywords();
std::span<const Translator> database_keywords();
std::span<const Translator> ale_keywords();
std::span<const Translator> adaptive_keywords();
std::span<const Translator> airbag_keywords();
std::span<const Translator> blast_keywords();

/// Moves the nodes of includes as their transformations say.
void move_included_nodes(Reading& reading);
/// Moves the node sets of *NODE_TRANSFORM, in the order of the deck; wants the sets.
void move_node_sets(Reading& reading);

/// What needs the whole deck: curves of tables, members of sets, *LOAD_BODY_PARTS, *CONTROL_CONTACT.
void finish_tables(Reading& reading);
void finish_sets(Reading& reading);
/// Puts the particles of *DEFINE_ADAPTIVE_SOLID_TO_SPH into the Model; wants the part sets.
void make_stand_ins(Reading& reading);
void finish_loads(Reading& reading);
void finish_nodal_rigid_bodies(Reading& reading);
void finish_contacts(Reading& reading);
/// Parts that a switch sets free are no rigid parts of the Model, also where *DEFORMABLE_TO_RIGID makes them
/// rigid at the start.
void finish_switched_parts(Reading& reading);

/// Brings the points of curves and tables of includes with other units into those of the deck.
void convert_foreign_curves(Reading& reading);
/// The mass properties that *PART_INERTIA and its kin share; `system_field` names a coordinate system, or
/// none.
PartInertia read_inertia(const Record& record, const Block& block, std::string_view system_field,
                         Reading& reading);

/// Nodes of the elements of some parts, each once, in rising order.
std::vector<Index> nodes_of_parts(const Model& model, const std::vector<Index>& parts);

/// Every node of the Model.
std::vector<Index> all_nodes(const Model& model);

/// The translator of a keyword; nullptr when it goes into Model::others as it is.
const Translator* find_translator(std::string_view keyword);

/// A field where 0 stands for the default.
inline double real_or(const Record& record, std::string_view field, double default_value)
{
    return value_or(record.real(field), default_value);
}

/// Three fields as a vector.
inline Vec3 vector_of(const Record& record, std::string_view x, std::string_view y, std::string_view z)
{
    return {record.real(x), record.real(y), record.real(z)};
}

} // namespace plash

// *CONTACT family: which surfaces act on each other, and how. The rest of the name tells the kind.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace plash {
namespace {

bool holds(std::string_view name, std::string_view part)
{
    return name.find(part) != std::string_view::npos;
}

/// The first of two names under which releases of the format know one field.
std::string_view one_of(const Record& record, std::string_view newer, std::string_view older)
{
    return record.peek(newer) ? newer : older;
}

/// LS-DYNA takes a zero for "as by default".
Contact::Kind kind_of(std::string_view name)
{
    using Kind = Contact::Kind;
    if (holds(name, "FORCE_TRANSDUCER")) return Kind::transducer;
    if (holds(name, "INTERIOR") && !holds(name, "GENERAL")) return Kind::interior;
    if (holds(name, "GENERAL")) return Kind::general;
    if (holds(name, "SINGLE_SURFACE") || holds(name, "SINGLE_EDGE")) return Kind::single_surface;
    if (holds(name, "TIEBREAK_NODES_ONLY")) return Kind::tied;
    if (name.starts_with("CONTACT_TIED_") || name.starts_with("CONTACT_SPOTWELD")) return Kind::tied;
    if (holds(name, "NODES_TO") || holds(name, "ONE_WAY") || holds(name, "BEAMS_TO")) return Kind::one_way;
    // LS-DYNA runs all surface-to-surface contacts of forming tools with the nodes of the sheet only.
    return Kind::two_way;
}

Tie tie_of(const Record& record, Contact::Kind kind)
{
    const std::string_view name = record.keyword;
    Tie tie;
    if (kind == Contact::Kind::tied || holds(name, "_TIED")) {
        tie.method = holds(name, "CONSTRAINED_OFFSET") ? Tie::Method::constrained_offset
                     : holds(name, "OFFSET")           ? Tie::Method::penalty
                                                       : Tie::Method::constrained;
        if (name.starts_with("CONTACT_AUTOMATIC")) tie.method = Tie::Method::penalty;
        tie.rotations = holds(name, "SHELL_EDGE") || holds(name, "SPOTWELD");
        tie.moment_offset = holds(name, "BEAM_OFFSET");
    }
    if (holds(name, "_FAILURE")) { // strengths stand in the place of the friction coefficients
        tie.method = Tie::Method::penalty;
        tie.failure = 2;
        tie.normal_strength = record.real("FS");
        tie.shear_strength = record.real("FD");
    }
    if (!holds(name, "TIEBREAK")) return tie;
    tie.method = Tie::Method::penalty;
    tie.moment_offset = holds(name, "BEAM_OFFSET");
    tie.failure = static_cast<int>(record.integer("OPTION"));
    tie.by_force = record.peek("NFLF") != nullptr;
    tie.normal_strength = tie.by_force ? record.real("NFLF") : record.real("NFLS");
    tie.shear_strength = tie.by_force ? record.real("SFLF") : record.real("SFLS");
    if (!record.peek("OPTION")) tie.failure = 2;
    tie.normal_exponent = real_or(record, "NEN", 2);
    tie.shear_exponent = real_or(record, "MES", 2);
    tie.parameter = record.real("PARAM");
    tie.normal_energy = record.real("ERATEN");
    tie.shear_energy = record.real("ERATES");
    tie.stiffness_ratio = real_or(record, "CT2CN", 1);
    tie.normal_stiffness = record.real("CN");
    return tie;
}

class SideReader {
public:
    SideReader(const Record& record, const Block& block, Reading& reading)
        : record_(record), block_(block), reading_(reading)
    {}

    /// `id` names what `type` says: 0 segment set, 1 shell set, 2 part set, 3 part, 4 node set, 5 everything,
    /// 6 everything but a part set.
    ContactSide read(std::string_view id, std::string_view type, std::string_view box)
    {
        ContactSide side;
        const Model& model = reading_.model;
        if (const Index index = reading_.find(record_, box, Kind::box); index != none)
            side.box = model.boxes[index].box;
        const Id number = record_.integer(id), way = record_.integer(type);
        if (way == 5 || number == 0) {
            side.kind = way == 5 ? ContactSide::Kind::all : ContactSide::Kind::none;
            return side;
        }
        constexpr Kind kinds[] = {Kind::segment_set, Kind::shell_set, Kind::part_set, Kind::part,
                                  Kind::node_set,    Kind::none,      Kind::part_set};
        if (way < 0 || way > 6) {
            reading_.error(record_, type,
                           fmt::format("{} is not supported; 0 segment set, 1 shell set, 2 part set, 3 part, "
                                       "4 node set, 5 everything, 6 everything but a part set are",
                                       way));
            return side;
        }
        const Index index = reading_.look_up(kinds[way], block_.number(kinds[way], number));
        if (index == none) {
            reading_.error(record_, id, fmt::format("there is no {} {}", to_string(kinds[way]), number));
            return side;
        }
        switch (way) {
        case 0:
            side.kind = ContactSide::Kind::segments;
            side.segments = model.segment_sets[index].segments;
            break;
        case 1:
            side.kind = ContactSide::Kind::shells;
            side.shells = model.shell_sets[index].elements;
            break;
        case 4:
            side.kind = ContactSide::Kind::nodes;
            side.nodes = model.node_sets[index].nodes;
            break;
        default:
            side.kind = ContactSide::Kind::parts;
            side.parts = parts_of(way, index);
            break;
        }
        return side;
    }

private:
    std::vector<Index> parts_of(Id way, Index index) const
    {
        const Model& model = reading_.model;
        if (way == 3) return {index};
        const std::vector<Index>& members = model.part_sets[index].parts;
        if (way == 2) return members;
        std::vector<Index> others;
        for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part)
            if (std::find(members.begin(), members.end(), part) == members.end()) others.push_back(part);
        return others;
    }

    const Record& record_;
    const Block& block_;
    Reading& reading_;
};

void read_sides(const Record& record, const Block& block, Contact& contact, Reading& reading)
{
    SideReader sides(record, block, reading);
    contact.slave = sides.read(one_of(record, "SURFA", "SSID"), one_of(record, "SURFATYP", "SSTYP"),
                               one_of(record, "SABOXID", "SBOXID"));
    contact.master = sides.read(one_of(record, "SURFB", "MSID"), one_of(record, "SURFBTYP", "MSTYP"),
                                one_of(record, "SBBOXID", "MBOXID"));
    const bool single =
        contact.kind == Contact::Kind::single_surface || contact.kind == Contact::Kind::general;
    if (single && contact.slave.kind == ContactSide::Kind::none &&
        record.integer(one_of(record, "SURFA", "SSID")) == 0)
        contact.slave.kind = ContactSide::Kind::all;
    const auto is_missing = [&](const ContactSide& side, std::string_view field) {
        return side.kind == ContactSide::Kind::none && record.integer(field) == 0;
    };
    const std::string_view first = one_of(record, "SURFA", "SSID"), second = one_of(record, "SURFB", "MSID");
    if (is_missing(contact.slave, first)) reading.error(record, first, "the contact has no first surface");
    const bool needs_two =
        !single && contact.kind != Contact::Kind::transducer && contact.kind != Contact::Kind::interior;
    if (needs_two && is_missing(contact.master, second))
        reading.error(record, second, "the contact has no second surface");

    contact.slave.stiffness_scale = real_or(record, one_of(record, "SFSA", "SFS"), 1);
    contact.master.stiffness_scale = real_or(record, one_of(record, "SFSB", "SFM"), 1);
    contact.slave.thickness = record.real(one_of(record, "SAST", "SST"));
    contact.master.thickness = record.real(one_of(record, "SBST", "MST"));
    contact.slave.thickness_scale = real_or(record, one_of(record, "SFSAT", "SFST"), 1);
    contact.master.thickness_scale = real_or(record, one_of(record, "SFSBT", "SFMT"), 1);
}

/// SOFT = 2 with a DEPTH of 3, 5 or these and tens: edges of segments are looked at beside their corners
/// (keyword manual, *CONTACT, optional card A).
bool segments_meet_at_edges(const Record& record, const Contact& contact)
{
    if (record.integer("SOFT") != 2) return false;
    if (contact.kind != Contact::Kind::single_surface && contact.kind != Contact::Kind::two_way) return false;
    const Id kind = record.integer("DEPTH", 2) % 10;
    return kind == 3 || kind == 5;
}

/// What only SOFT = 2 knows is not read without it, and so listed as ignored.
void read_segment_based(const Record& record, Contact& contact, Reading& reading)
{
    contact.stiffness_of_nodes = record.integer("PSTIFF") == 1;
    contact.larger_part_scale = record.integer("SSFTYP") == 1;
    contact.friction_stiffness_scale = real_or(record, "FRICSF", 1);
    contact.baseline_decay = record.real("DPRFAC");
    if (contact.baseline_decay >= 0 && contact.baseline_decay <= 1) return;
    reading.error(record, "DPRFAC",
                  fmt::format("{} is not supported; a share from 0 to 1 per cycle is, a curve is not",
                              contact.baseline_decay));
}

void read_optional_cards(const Record& record, Contact& contact, Reading& reading)
{
    contact.solid_thickness = record.real("SLDTHK");
    if (contact.soft != 2) contact.solid_modulus = record.real("SLDSTF");
    contact.drop_symmetry_faces = record.integer("ISYM") == 1;
    if (record.integer("ISYM") < 0) {
        reading.error(
            record, "ISYM",
            "node sets of symmetry planes are not supported; 1 finds the planes by the fixed nodes");
    }
    if (contact.soft == 2 && contact.edges) contact.edge_stiffness_scale = real_or(record, "EDGEK", 1);
    if (presses_by_segments(contact)) read_segment_based(record, contact, reading);
}

void read_contact(const Record& record, const Block& block, Reading& reading)
{
    const std::string_view name = record.keyword;
    Contact contact;
    contact.id = record.id;
    contact.title = record.title;
    contact.keyword = record.keyword;
    contact.where = record.where;
    contact.kind = kind_of(name);
    contact.automatic = holds(name, "AUTOMATIC") || holds(name, "AIRBAG") || holds(name, "ERODING");
    contact.eroding = holds(name, "ERODING");
    contact.constraint = holds(name, "CONSTRAINT_");
    contact.tie = tie_of(record, contact.kind);
    constexpr int options[] = {0, 1, 2, 3, 4, 6, 8};
    const bool tiebreak =
        holds(name, "_SURFACE_TIEBREAK") && name.ends_with("TIEBREAK") && !holds(name, "SINGLE");
    if (tiebreak &&
        std::find(std::begin(options), std::end(options), contact.tie.failure) == std::end(options)) {
        reading.error(record, "OPTION",
                      fmt::format("{} is not supported; 1, 2, 3, 4, 6 and 8 are", contact.tie.failure));
    }
    read_sides(record, block, contact, reading);

    contact.static_friction = record.real("FS");
    contact.dynamic_friction = record.real("FD");
    contact.friction_decay = record.real("DC");
    contact.friction_stress = real_or(record, "VSF", 1) * record.real("VC");
    contact.friction_scale = real_or(record, "FSF", 1);
    contact.damping = record.real("VDC");
    contact.birth = record.real("BT");
    const double death = record.real("DT", forever);
    contact.death = death == 0 || death >= 1e20 ? forever : death;

    contact.soft = static_cast<int>(record.integer("SOFT"));
    contact.soft_scale = real_or(record, "SOFSCL", 0.1);
    const double stiffness_step = record.real("DTSTIF");
    if (stiffness_step < 0) reading.warning(record, "DTSTIF", "only positive values change the stiffness");
    contact.soft_step = std::max(0.0, stiffness_step);
    contact.largest_penetration = record.real("PENMAX");
    contact.square_edges = record.integer("SHLEDG") == 1;
    contact.thickness_option = static_cast<int>(record.integer("SHLTHK"));
    const Id beams = record.integer("CPARM8"); // that of the _MPP card speaks to LS-DYNA's MPP alone
    contact.spot_weld_beams = beams == 2;
    contact.exclude_same_part_beams = beams == 1;
    contact.edges = contact.kind == Contact::Kind::general || segments_meet_at_edges(record, contact);
    contact.inner_edges = contact.kind == Contact::Kind::general && holds(name, "INTERIOR");
    contact.initial_penetration = static_cast<int>(record.integer("IGNORE"));
    if (contact.kind != Contact::Kind::tied && contact.kind != Contact::Kind::transducer)
        read_optional_cards(record, contact, reading);
    if (name.ends_with("_MORTAR")) {
        reading.warning(record, {},
                        "acts as the penalty contact of nodes on segments, not as a mortar contact");
    }
    reading.model.contacts.push_back(std::move(contact));
}

/// *CONTROL_CONTACT: what all contacts take unless they say otherwise.
void read_contact_control(const Record& record, const Block&, Reading& reading)
{
    ContactDefaults& defaults = reading.contact_defaults;
    defaults.penalty_scale = real_or(record, "SLSFAC", 0.1);
    defaults.penalty_option = static_cast<int>(record.integer("PENOPT", 1));
    defaults.thickness_option = static_cast<int>(record.integer("SHLTHK"));
    defaults.keep_eroded_nodes = record.integer("ENMASS") != 0;
    defaults.limit_thickness = record.integer("SSTHK") == 0;
    defaults.initial_penetration = static_cast<int>(record.integer("IGNORE"));
    defaults.square_edges = record.integer("SHLEDG") == 1;
    defaults.one_way_erosion = record.integer("NSEROD") == 1;
    defaults.of_parts.static_friction = record.real("SFRIC");
    defaults.of_parts.dynamic_friction = record.real("DFRIC");
    defaults.of_parts.friction_decay = record.real("EDC");
    defaults.of_parts.friction_stress = record.real("VFC");
    defaults.of_parts.thickness = record.real("TH");
    defaults.of_parts.thickness_scale = real_or(record, "TH_SF", 1);
    defaults.of_parts.stiffness_scale = real_or(record, "PEN_SF", 1);
    defaults.drop_symmetry_faces = record.integer("ISYM") == 1;
    defaults.friction_energy = record.integer("FRCENG") != 0;
    defaults.stiffness_of_nodes = record.integer("PSTIFF") == 1;
}

/// *CONTROL_CONTACT: values of parts where *PART_CONTACT gives none.
void give_parts_defaults(const PartContact& defaults, Model& model)
{
    if (defaults == PartContact{}) return;
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        PartContact& own = model.part_contacts[static_cast<Index>(part)];
        const auto fill = [&](double PartContact::*value, double not_given) {
            if (own.*value == not_given) own.*value = defaults.*value;
        };
        fill(&PartContact::static_friction, 0);
        fill(&PartContact::dynamic_friction, 0);
        fill(&PartContact::friction_decay, 0);
        fill(&PartContact::friction_stress, 0);
        fill(&PartContact::thickness, 0);
        fill(&PartContact::thickness_scale, 1);
        fill(&PartContact::stiffness_scale, 1);
    }
}

/// Contacts without a number get that of their place in the deck, as LS-DYNA counts them, or the next that is
/// free.
void number_contacts(std::vector<Contact>& contacts)
{
    std::set<Id> taken;
    for (const Contact& contact : contacts) taken.insert(contact.id);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (contacts[i].id != 0) continue;
        contacts[i].id = static_cast<Id>(i) + 1;
        while (!taken.insert(contacts[i].id).second) ++contacts[i].id;
    }
}

constexpr Translator contact_table[] = {
    {"CONTROL_CONTACT", Phase::conditions, read_contact_control},
    {"CONTACT_AIRBAG_SINGLE_SURFACE", Phase::conditions, read_contact},
    {"CONTACT_AUTOMATIC_*", Phase::conditions, read_contact},
    {"CONTACT_CONSTRAINT_*", Phase::conditions, read_contact},
    {"CONTACT_ERODING_*", Phase::conditions, read_contact},
    {"CONTACT_FORCE_TRANSDUCER_*", Phase::conditions, read_contact},
    {"CONTACT_FORMING_*", Phase::conditions, read_contact},
    {"CONTACT_NODES_TO_SURFACE", Phase::conditions, read_contact},
    {"CONTACT_ONE_WAY_SURFACE_TO_SURFACE", Phase::conditions, read_contact},
    {"CONTACT_SINGLE_SURFACE", Phase::conditions, read_contact},
    {"CONTACT_SPOTWELD*", Phase::conditions, read_contact},
    {"CONTACT_SURFACE_TO_SURFACE", Phase::conditions, read_contact},
    {"CONTACT_TIEBREAK_*", Phase::conditions, read_contact},
    {"CONTACT_TIED_*", Phase::conditions, read_contact},
};

} // namespace

std::span<const Translator> contact_keywords()
{
    return contact_table;
}

void finish_contacts(Reading& reading)
{
    const ContactDefaults& defaults = reading.contact_defaults;
    number_contacts(reading.model.contacts);
    for (Contact& contact : reading.model.contacts) {
        contact.penalty_scale = defaults.penalty_scale;
        contact.penalty_option = defaults.penalty_option;
        contact.keep_eroded_nodes = defaults.keep_eroded_nodes;
        contact.limit_thickness = defaults.limit_thickness;
        contact.square_edges = contact.square_edges || defaults.square_edges;
        // A node set has no segments to be touched.
        if (contact.keyword == "CONTACT_ERODING_NODES_TO_SURFACE" && !defaults.one_way_erosion &&
            contact.slave.kind != ContactSide::Kind::nodes)
            contact.kind = Contact::Kind::two_way;
        // Automatic contacts always count the thickness of shells.
        if (contact.automatic)
            contact.thickness_option = 2;
        else if (contact.thickness_option == 0)
            contact.thickness_option = defaults.thickness_option;
        if (contact.initial_penetration == 0) contact.initial_penetration = defaults.initial_penetration;
        contact.drop_symmetry_faces = contact.drop_symmetry_faces || defaults.drop_symmetry_faces;
        contact.stiffness_of_nodes = contact.stiffness_of_nodes || defaults.stiffness_of_nodes;
        contact.friction_energy = defaults.friction_energy;
    }
    give_parts_defaults(defaults.of_parts, reading.model);
}

} // namespace plash

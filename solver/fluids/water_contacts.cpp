#include "solver/fluids/water_contacts.h"

#include "ale/coupling/coupling_options.h"
#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

using Kind = ContactSide::Kind;

/// What of a contact's side is water and what is structure.
struct Split {
    bool water = false;
    std::vector<Index> water_parts; ///< empty where the side names segments or nodes
    ContactSide structure;          ///< kind none: there is no structure
};

/// Nodes of elements that are no water.
std::vector<bool> structure_nodes(const Model& model, const Water& water)
{
    std::vector<bool> marks(model.nodes.size());
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (water.is_water[elements.part[i]]) continue;
            for (Index node : elements.nodes[i])
                if (node != none) marks[node] = true;
        }
    });
    return marks;
}

std::vector<bool> used_parts(const Model& model)
{
    std::vector<bool> used(model.parts.size());
    for_each_topology(model, [&](const auto& elements) {
        for (Index part : elements.part) used[part] = true;
    });
    for (Index part : model.particles.part) used[part] = true;
    return used;
}

Split split(const Model& model, const Water& water, const ContactSide& side)
{
    Split result;
    result.structure = side;
    const auto take_parts = [&](const std::vector<Index>& parts) {
        result.structure.kind = Kind::parts;
        result.structure.parts.clear();
        for (Index part : parts) {
            if (water.is_water[part])
                result.water_parts.push_back(part);
            else
                result.structure.parts.push_back(part);
        }
        result.water = !result.water_parts.empty();
        if (result.structure.parts.empty()) result.structure.kind = Kind::none;
    };
    switch (side.kind) {
    case Kind::none:
    case Kind::shells:
        break;
    case Kind::all: {
        const std::vector<bool> used = used_parts(model);
        std::vector<Index> all;
        for (std::size_t part = 0; part < used.size(); ++part)
            if (used[part]) all.push_back(static_cast<Index>(part));
        take_parts(all);
        break;
    }
    case Kind::parts:
        take_parts(side.parts);
        break;
    case Kind::segments:
    case Kind::nodes: {
        const std::vector<bool> other = structure_nodes(model, water);
        const auto is_wet = [&](Index node) { return water.has_node[node] && !other[node]; };
        const std::size_t before = side.segments.size() + side.nodes.size();
        std::erase_if(result.structure.segments, [&](const std::array<Index, 4>& segment) {
            return std::any_of(segment.begin(), segment.end(), is_wet);
        });
        std::erase_if(result.structure.nodes, is_wet);
        const std::size_t after = result.structure.segments.size() + result.structure.nodes.size();
        result.water = after < before;
        if (after == 0) result.structure.kind = Kind::none;
        break;
    }
    }
    return result;
}

std::string contact_name(const Contact& contact)
{
    return contact.title.empty() ? fmt::format("contact {}", contact.id)
                                 : fmt::format("contact {} '{}'", contact.id, contact.title);
}

std::string side_name(const Model& model, const ContactSide& side)
{
    if (side.kind != Kind::parts) return side.kind == Kind::segments ? "its segments" : "its shells";
    std::string text = side.parts.size() == 1 ? "part" : "parts";
    for (std::size_t i = 0; i < side.parts.size() && i < 5; ++i)
        text += fmt::format(" {}", model.parts[side.parts[i]].id);
    return text + (side.parts.size() > 5 ? " ..." : "");
}

Id add_part_set(Model& model, const std::vector<Index>& parts)
{
    PartSet set;
    set.id = free_id(model.part_sets);
    set.parts = parts;
    model.part_sets.push_back(std::move(set));
    return model.part_sets.back().id;
}

Id add_segment_set(Model& model, std::vector<std::array<Index, 4>> segments)
{
    SegmentSet set;
    set.id = free_id(model.segment_sets);
    set.segments = std::move(segments);
    model.segment_sets.push_back(std::move(set));
    return model.segment_sets.back().id;
}

double smallest_piece(const Water& water, Index part)
{
    double size = 1e300;
    for (const WaterPiece& piece : water.pieces)
        if (piece.part == part) size = std::min(size, piece.size);
    return size;
}

} // namespace

WaterContacts::WaterContacts(const Model& model, const Water& water)
{
    for (std::size_t index = 0; index < model.contacts.size(); ++index) read_contact(model, water, index);
    if (water.mesh) read_couplings(model);
    read_shared_nodes(model, water);
}

void WaterContacts::read_contact(const Model& model, const Water& water, std::size_t index)
{
    const Contact& contact = model.contacts[index];
    if (contact.kind == Contact::Kind::transducer || contact.kind == Contact::Kind::interior) return;
    const Split slave = split(model, water, contact.slave), master = split(model, water, contact.master);
    if (!slave.water && !master.water) return;
    const bool single =
        contact.kind == Contact::Kind::single_surface || contact.kind == Contact::Kind::general;
    const bool dry_slave = slave.structure.kind != Kind::none,
               dry_master = master.structure.kind != Kind::none;
    const auto meet = [&](const Split& structure, const Split& wet, bool structure_is_slave) {
        Meeting meeting;
        meeting.id = contact.id;
        meeting.name = contact_name(contact);
        meeting.title = contact.title;
        meeting.where = contact.where;
        meeting.structure = structure.structure;
        meeting.water_parts = wet.water_parts;
        meeting.structure_is_slave = structure_is_slave;
        meeting.sticks = contact.tie.method != Tie::Method::none;
        meeting.friction = contact.static_friction;
        meeting.birth = contact.birth;
        meeting.death = contact.death;
        meeting.contact = index;
        meeting.from_contact = true;
        // A structure's contact with itself stays.
        meeting.replaced = !single && !(dry_slave && dry_master);
        meetings_.push_back(std::move(meeting));
    };
    if (single) {
        if (dry_slave)
            meet(slave, slave, false);
        else
            among_water_.push_back(index);
        return;
    }
    if (slave.water && dry_master) meet(master, slave, false);
    if (master.water && dry_slave) meet(slave, master, true);
    if (!dry_slave && !dry_master) among_water_.push_back(index);
}

void WaterContacts::read_couplings(const Model& model)
{
    for (const CouplingOptions& coupling : coupling_options_of(model, deck_groups_of(model))) {
        Meeting meeting;
        meeting.id = coupling.id;
        meeting.name = fmt::format("coupling {}", coupling.id);
        meeting.where = coupling.where;
        meeting.structure = coupling.structure;
        meeting.sticks = coupling.direction == CouplingOptions::Direction::all;
        meeting.friction = coupling.friction;
        meeting.birth = coupling.start;
        meeting.death = coupling.end;
        meetings_.push_back(std::move(meeting));
    }
}

void WaterContacts::read_shared_nodes(const Model& model, const Water& water)
{
    std::vector<bool> meets(model.parts.size());
    const auto look = [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (water.is_water[elements.part[i]]) continue;
            int shared = 0;
            for (Index node : elements.nodes[i]) shared += node != none && water.has_node[node];
            if (shared >= 3) meets[elements.part[i]] = true;
        }
    };
    look(model.shells);
    look(model.solids);
    for (std::size_t part = 0; part < meets.size(); ++part) {
        if (!meets[part]) continue;
        Meeting meeting;
        meeting.name = fmt::format("shared nodes of part {} and the water", model.parts[part].id);
        meeting.where = model.parts[part].where;
        meeting.structure.kind = Kind::parts;
        meeting.structure.parts = {static_cast<Index>(part)};
        meetings_.push_back(std::move(meeting));
    }
}

std::vector<Vec3> WaterContacts::structure_points(const Model& model) const
{
    std::vector<bool> parts(model.parts.size()), marks(model.nodes.size());
    for (const Meeting& meeting : meetings_) {
        for (Index part : meeting.structure.parts) parts[part] = true;
        for (const auto& segment : meeting.structure.segments)
            for (Index node : segment) marks[node] = true;
        for (Index shell : meeting.structure.shells)
            for (Index node : model.shells.nodes[shell]) marks[node] = true;
    }
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (parts[elements.part[i]])
                for (Index node : elements.nodes[i])
                    if (node != none) marks[node] = true;
    });
    std::vector<Vec3> points;
    for (std::size_t node = 0; node < marks.size(); ++node)
        if (marks[node]) points.push_back(model.nodes.position[node]);
    return points;
}

void WaterContacts::add_coupling(Model& model, const Meeting& meeting, const NewWater& made,
                                 std::vector<std::string>& lines) const
{
    Record record = made_record("CONSTRAINED_LAGRANGE_IN_SOLID", meeting.where,
                                {{"ALESTYP", 0},
                                 {"CTYPE", 4},
                                 // Contacts press and do not pull; ties hold in all directions.
                                 {"DIREC", meeting.sticks ? 3.0 : 2.0},
                                 {"PFAC", 0.1},
                                 {"FRCMIN", 0.5},
                                 {"START", meeting.birth},
                                 {"FRIC", std::max(meeting.friction, 0.0)},
                                 {"ILEAK", 2},
                                 {"PLEAK", 0.1},
                                 {"BOTHSIDES", 1}});
    const auto set = [&](const char* field, double value) {
        record.fields.push_back({field, value, {}, true, true, meeting.where});
    };
    if (meeting.death < forever) set("END", meeting.death);
    set("ALESID", static_cast<double>(add_part_set(model, made.mesh_parts)));
    switch (meeting.structure.kind) {
    case Kind::parts:
        set("LSTRSID", static_cast<double>(add_part_set(model, meeting.structure.parts)));
        set("LSTRSTYP", 0);
        break;
    case Kind::shells: {
        std::vector<std::array<Index, 4>> segments;
        for (Index shell : meeting.structure.shells) segments.push_back(model.shells.nodes[shell]);
        set("LSTRSID", static_cast<double>(add_segment_set(model, std::move(segments))));
        set("LSTRSTYP", 2);
        break;
    }
    case Kind::segments:
        set("LSTRSID", static_cast<double>(add_segment_set(model, meeting.structure.segments)));
        set("LSTRSTYP", 2);
        break;
    default:
        throw DeckError(meeting.where,
                        fmt::format("{}: its structure is a list of nodes, which has no surface that "
                                    "could be coupled with an Eulerian mesh; give a part or segments",
                                    meeting.name));
    }
    std::string line =
        fmt::format("{} with {} became a coupling by penalty{}", meeting.name,
                    side_name(model, meeting.structure), meeting.sticks ? " in all directions" : "");
    if (meeting.from_contact) {
        record.id = meeting.id;
        set("CONTACT", static_cast<double>(meeting.structure_is_slave ? -meeting.id : meeting.id));
        line += fmt::format("; its force stands in rcforc under {}", meeting.id);
    }
    model.others.push_back(std::move(record));
    lines.push_back(std::move(line));
}

void WaterContacts::add_contact(Model& model, const Meeting& meeting, FluidForm form, const Water& water,
                                const NewWater& made, std::vector<std::string>& lines) const
{
    if (meeting.structure.kind == Kind::nodes)
        throw DeckError(meeting.where,
                        fmt::format("{}: its structure is a list of nodes, which has no surface that "
                                    "the water could touch; give a part or segments",
                                    meeting.name));
    Contact contact;
    if (meeting.from_contact) contact = model.contacts[meeting.contact];
    const bool particles = form == FluidForm::sph;
    contact.id = meeting.id != 0 ? meeting.id : free_id(model.contacts);
    if (!meeting.from_contact || !meeting.replaced)
        for (const Contact& other : model.contacts)
            if (other.id == contact.id) contact.id = free_id(model.contacts);
    contact.title = meeting.title;
    contact.where = meeting.where;
    contact.keyword = "CONTACT_AUTOMATIC_NODES_TO_SURFACE";
    contact.kind = Contact::Kind::one_way;
    contact.automatic = true;
    contact.constraint = false;
    contact.tie = {};
    contact.static_friction = std::max(meeting.friction, 0.0);
    contact.birth = meeting.birth;
    contact.death = meeting.death;
    contact.initial_penetration = 1;
    // The stiffness of water tells nothing of that of the contact: it follows from masses and step.
    contact.soft = 1;
    contact.soft_scale = 0.1;
    ContactSide wet;
    wet.kind = Kind::parts;
    wet.parts = meeting.water_parts.empty() ? water.parts : meeting.water_parts;
    if (particles) wet.thickness = made.spacing > 0 ? made.spacing : water.smallest_size;
    contact.slave = wet;
    contact.master = meeting.structure;
    lines.push_back(fmt::format("{} with {} became contact {} of the {} with it{}", meeting.name,
                                side_name(model, meeting.structure), contact.id,
                                particles ? "particles" : "water's nodes",
                                meeting.sticks ? ", where they no longer stick" : ""));
    if (meeting.from_contact && meeting.replaced)
        model.contacts[meeting.contact] = std::move(contact);
    else
        model.contacts.push_back(std::move(contact));
}

void WaterContacts::translate(Model& model, FluidForm form, const Water& water,
                              const std::vector<bool>& changed, const NewWater& made,
                              std::vector<std::string>& lines) const
{
    std::vector<bool> gone(model.contacts.size());
    const auto touches_changed = [&](const std::vector<Index>& parts) {
        return parts.empty() ||
               std::any_of(parts.begin(), parts.end(), [&](Index part) { return changed[part]; });
    };
    for (const Meeting& meeting : meetings_) {
        if (!touches_changed(meeting.water_parts)) {
            lines.push_back(fmt::format("{} stays as it is", meeting.name));
            continue;
        }
        if (form == FluidForm::ale)
            add_coupling(model, meeting, made, lines);
        else
            add_contact(model, meeting, form, water, made, lines);
        if (!meeting.from_contact) continue;
        if (meeting.replaced) {
            gone[meeting.contact] = form == FluidForm::ale;
            continue;
        }
        Contact& contact = model.contacts[meeting.contact];
        if (contact.slave.kind == Kind::all || contact.slave.kind == Kind::parts)
            contact.slave = split(model, water, contact.slave).structure;
        if (contact.master.kind == Kind::all || contact.master.kind == Kind::parts)
            contact.master = split(model, water, contact.master).structure;
        lines.push_back(fmt::format("{} stays for the structures alone", meeting.name));
    }
    for (std::size_t index : among_water_) {
        Contact& contact = model.contacts[index];
        if (form == FluidForm::lagrange) {
            const auto parts_of = [&](const ContactSide& side) {
                return side.kind == Kind::parts ? side.parts : std::vector<Index>{};
            };
            std::vector<Index> fine = parts_of(contact.slave), coarse = parts_of(contact.master);
            if (fine.empty() || coarse.empty())
                throw DeckError(contact.where,
                                fmt::format("{} joins parts of the water, but does not name them as "
                                            "parts; so it cannot become a tie of solids",
                                            contact_name(contact)));
            if (smallest_piece(water, fine.front()) > smallest_piece(water, coarse.front()))
                std::swap(fine, coarse);
            Contact tied;
            tied.id = contact.id;
            tied.title = contact.title;
            tied.where = contact.where;
            tied.keyword = "CONTACT_TIED_NODES_TO_SURFACE";
            tied.kind = Contact::Kind::tied;
            tied.tie.method = Tie::Method::constrained;
            tied.slave.kind = tied.master.kind = Kind::parts;
            tied.slave.parts = std::move(fine);
            tied.master.parts = std::move(coarse);
            lines.push_back(fmt::format("{} between parts of the water became a tie", contact_name(contact)));
            contact = std::move(tied);
            continue;
        }
        gone[index] = true;
        lines.push_back(fmt::format("{} between parts of the water went: they are one {} now",
                                    contact_name(contact),
                                    form == FluidForm::ale ? "mesh" : "body of particles"));
    }
    std::size_t index = 0;
    std::erase_if(model.contacts, [&](const Contact&) { return index < gone.size() && gone[index++]; });
}

} // namespace plash

#include "contact/surface.h"

#include "contact/solid_faces.h"
#include "contact/symmetry_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace plash {

namespace {

using Corners = std::array<Index, 4>;

/// Shells and solid faces of the Model by their nodes, to find the element beneath a segment of a set.
class ElementFinder {
public:
    ElementFinder(const Model& model, const std::vector<SolidFace>& faces) : faces_(faces)
    {
        for (std::size_t i = 0; i < model.shells.size(); ++i) {
            shells_.push_back({face_key(model.shells.nodes[i]), static_cast<Index>(i)});
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            solid_faces_.push_back({face_key(faces[i].nodes), static_cast<Index>(i)});
        }
        std::sort(shells_.begin(), shells_.end());
        std::sort(solid_faces_.begin(), solid_faces_.end());
    }

    Index shell_under(const Corners& nodes) const { return find(shells_, nodes); }
    /// The face of a solid (preferably an exterior one), or nullptr.
    const SolidFace* face_under(const Corners& nodes) const
    {
        const Index face = find(solid_faces_, nodes);
        return face == none ? nullptr : &faces_[face];
    }

private:
    using Keys = std::vector<std::pair<Corners, Index>>;
    const std::vector<SolidFace>& faces_;
    Keys shells_, solid_faces_;

    static Index find(const Keys& keys, const Corners& nodes)
    {
        const Corners key = face_key(nodes);
        const auto place = std::lower_bound(keys.begin(), keys.end(), std::pair(key, Index{0}));
        return place != keys.end() && place->first == key ? place->second : none;
    }
};

/// Builds the segments of one side.
class SurfaceBuilder {
public:
    SurfaceBuilder(const Model& model, const std::vector<PartData>& parts, const ContactSide& side,
                   const SurfaceOptions& options)
        : model_(model), parts_(parts), side_(side), options_(options)
    {
        if (side.kind != ContactSide::Kind::shells) faces_ = solid_faces(model);
        collect_segments();
        if (options.drop_symmetry_faces) drop_symmetry_faces(model, surface_.segments);
        if (side.box) drop_outside_box();
        drop_duplicates();
        for (Segment& segment : surface_.segments) measure(segment);
        if (options_.limit_thickness) even_out_thickness();
        collect_nodes();
    }

    Surface take() { return std::move(surface_); }

private:
    const Model& model_;
    const std::vector<PartData>& parts_;
    const ContactSide& side_;
    const SurfaceOptions& options_;
    std::vector<SolidFace> faces_;
    Surface surface_;
    std::vector<Index> beams_;
    std::vector<Index> particles_;
    std::vector<double> node_thickness_; ///< half of it by node of the Model; empty unless it is limited

    void add_shell(Index shell)
    {
        Segment segment;
        segment.nodes = model_.shells.nodes[shell];
        segment.part = model_.shells.part[shell];
        segment.shell = shell;
        segment.one_sided = options_.orient_by_deck;
        surface_.segments.push_back(segment);
    }

    void add_face(const SolidFace& face)
    {
        Segment segment;
        segment.nodes = face.nodes;
        segment.part = brick_part(model_, face.solid);
        segment.solid = face.solid;
        segment.covered_by = face.neighbour;
        segment.one_sided = true;
        surface_.segments.push_back(segment);
    }

    void collect_segments()
    {
        using Kind = ContactSide::Kind;
        if (side_.kind == Kind::all || side_.kind == Kind::parts) {
            std::vector<bool> wanted(model_.parts.size(), side_.kind == Kind::all);
            for (Index part : side_.parts) wanted[part] = true;
            for (std::size_t i = 0; i < model_.shells.size(); ++i) {
                if (wanted[model_.shells.part[i]]) add_shell(static_cast<Index>(i));
            }
            for (const SolidFace& face : faces_) {
                if (!wanted[brick_part(model_, face.solid)]) continue;
                if (face.neighbour == none || options_.inner_faces) add_face(face);
            }
            for (std::size_t i = 0; options_.with_beams && i < model_.beams.size(); ++i) {
                const Index part = model_.beams.part[i];
                if (wanted[part] && (options_.spot_weld_beams || !parts_[part].spot_weld))
                    beams_.push_back(static_cast<Index>(i));
            }
        }
        if (options_.with_particles && side_.kind == Kind::parts) {
            std::vector<bool> wanted(model_.parts.size());
            for (Index part : side_.parts) wanted[part] = true;
            for (std::size_t i = 0; i < model_.particles.size(); ++i) {
                if (wanted[model_.particles.part[i]]) particles_.push_back(static_cast<Index>(i));
            }
        }
        if (side_.kind == Kind::shells) {
            for (Index shell : side_.shells) add_shell(shell);
        }
        if (side_.kind == Kind::segments) collect_set_segments();
    }

    /// Segments of a set keep the deck's order of nodes, but in automatic contact those on solids are turned
    /// so that they point outward.
    void collect_set_segments()
    {
        const ElementFinder finder(model_, faces_);
        for (const Corners& nodes : side_.segments) {
            const Index shell = finder.shell_under(nodes);
            const SolidFace* face = shell == none ? finder.face_under(nodes) : nullptr;
            if (shell != none) {
                add_shell(shell);
            } else if (face) {
                add_face(*face);
            } else {
                Segment loose;
                loose.nodes = nodes;
                loose.one_sided = options_.orient_by_deck;
                surface_.segments.push_back(loose);
            }
            if (options_.orient_by_deck) surface_.segments.back().nodes = nodes;
        }
    }

    void drop_outside_box()
    {
        const std::vector<Vec3>& position = model_.nodes.position;
        const auto outside = [&](Index node) { return !side_.box->holds(position[node]); };
        std::erase_if(surface_.segments, [&](const Segment& segment) {
            return std::any_of(segment.nodes.begin(), segment.nodes.end(), outside);
        });
        std::erase_if(beams_, [&](Index beam) {
            const auto& nodes = model_.beams.nodes[beam];
            return outside(nodes[0]) || outside(nodes[1]);
        });
        std::erase_if(particles_, [&](Index particle) { return outside(model_.particles.node[particle]); });
    }

    /// The first of several segments on the same nodes stays: a shell before the face of a solid. Faces of
    /// two solids on one another are not duplicates: each shows when the other has gone.
    void drop_duplicates()
    {
        std::vector<Segment>& segments = surface_.segments;
        using Key = std::tuple<Corners, Index, std::size_t>;
        std::vector<Key> keys;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Index owner = segments[i].covered_by == none ? none : segments[i].solid;
            keys.emplace_back(face_key(segments[i].nodes), owner, i);
        }
        std::sort(keys.begin(), keys.end());
        std::vector<bool> again(segments.size());
        for (std::size_t i = 1; i < keys.size(); ++i) {
            const bool same = std::get<0>(keys[i]) == std::get<0>(keys[i - 1]) &&
                              std::get<1>(keys[i]) == std::get<1>(keys[i - 1]);
            again[std::get<2>(keys[i])] = same;
        }
        std::size_t number = 0;
        std::erase_if(segments, [&](const Segment&) { return again[number++]; });
    }

    double element_thickness(const Segment& segment) const
    {
        if (segment.shell == none) return 0;
        const bool own = !model_.shells.thickness.empty() && model_.shells.thickness[segment.shell][0] > 0;
        if (!own) return parts_[segment.part].thickness;
        const auto& t = model_.shells.thickness[segment.shell];
        return 0.25 * (t[0] + t[1] + t[2] + t[3]);
    }

    const PartContact* part_contact(Index part) const
    {
        const auto found = model_.part_contacts.find(part);
        return found == model_.part_contacts.end() ? nullptr : &found->second;
    }

    double contact_thickness(const Segment& segment) const
    {
        if (options_.thickness_option == 0) return 0;
        if (options_.thickness_option == 1 && segment.part != none && parts_[segment.part].rigid) return 0;
        const PartContact* own = part_contact(segment.part);
        if (own && own->thickness > 0) return own->thickness;
        if (segment.shell != none && side_.thickness > 0) return side_.thickness;
        if (segment.solid != none) return options_.solid_thickness;
        const double scale = own && own->thickness_scale != 1 ? own->thickness_scale : side_.thickness_scale;
        const double thickness = scale * element_thickness(segment);
        if (!options_.limit_thickness) return thickness;
        double shortest = std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 4; ++corner) {
            const Vec3 side = model_.nodes.position[segment.nodes[(corner + 1) % 4]] -
                              model_.nodes.position[segment.nodes[corner]];
            if (norm(side) > 0) shortest = std::min(shortest, norm(side));
        }
        return std::min(thickness, 0.4 * shortest);
    }

    void measure(Segment& segment) const
    {
        const std::vector<Vec3>& position = model_.nodes.position;
        const double area = segment_area(segment.nodes, position);
        double bulk = segment.part == none ? 0 : parts_[segment.part].bulk_modulus;
        if (segment.solid != none && options_.solid_modulus > 0) bulk = options_.solid_modulus;
        const PartContact* own = part_contact(segment.part);
        const double scale = side_.stiffness_scale * (own ? own->stiffness_scale : 1);
        const Vec3 diagonal = position[segment.nodes[2]] - position[segment.nodes[0]];
        const Vec3 other = position[segment.nodes[3]] - position[segment.nodes[1]];
        const double longest = std::max(norm(diagonal), norm(other));
        segment.half_thickness = 0.5 * contact_thickness(segment);
        segment.size = std::sqrt(area);
        segment.rigid = segment.part != none && parts_[segment.part].rigid;
        if (segment.solid != none) {
            // A triangle between mid-side nodes has its own eighth of a ten-node tetrahedron behind it.
            const double share = ten_nodes(model_, segment.solid) ? 0.125 : 1;
            const double volume = share * solid_volume(brick_nodes(model_, segment.solid), position);
            segment.stiffness = volume > 0 ? scale * bulk * area * area / volume : 0;
            const double thickness = area > 0 ? volume / area : 0;
            segment.area_mass = 0.5 * parts_[segment.part].density * thickness;
            segment.depth =
                options_.penetration_factor > 0 ? options_.penetration_factor * thickness : 0.5 * thickness;
        } else {
            segment.stiffness = longest > 0 ? scale * bulk * area / longest : 0;
            if (segment.shell != none)
                segment.area_mass = parts_[segment.part].density * element_thickness(segment);
            segment.depth = options_.penetration_factor > 0
                                ? options_.penetration_factor * 2 * segment.half_thickness
                                : 0.25 * longest;
        }
    }

    /// LS-DYNA's single surface contacts keep the thickness by node: that of a shell at the node, 40 % of
    /// whose shortest side limit it. Here it is the thinnest shell at the node, and a segment is as thin as
    /// its thinnest corner: the head of LS-DYNA's bolt then meets its plate where it does there
    /// (docs/results/bolt.md).
    void even_out_thickness()
    {
        const auto own = [&](const Segment& segment) {
            const PartContact* given = part_contact(segment.part);
            return segment.shell == none || (given && given->thickness > 0);
        };
        std::vector<double> thinnest(model_.nodes.size(), std::numeric_limits<double>::infinity());
        for (const Segment& segment : surface_.segments) {
            if (own(segment)) continue;
            for (Index node : segment.nodes)
                thinnest[node] = std::min(thinnest[node], segment.half_thickness);
        }
        for (Segment& segment : surface_.segments) {
            if (own(segment)) continue;
            for (Index node : segment.nodes) {
                segment.half_thickness = std::min(segment.half_thickness, thinnest[node]);
            }
        }
        node_thickness_ = std::move(thinnest);
    }

    void collect_nodes()
    {
        std::vector<ContactNode> entries;
        for (const Segment& segment : surface_.segments) {
            for (Index node : segment.nodes) {
                const bool by_node = !node_thickness_.empty() && std::isfinite(node_thickness_[node]);
                const double half = by_node ? node_thickness_[node] : segment.half_thickness;
                entries.push_back({node, segment.part, half, segment.stiffness});
            }
        }
        for (Index beam : beams_) {
            const Index part = model_.beams.part[beam];
            const PartContact* own = part_contact(part);
            const double radius = own && own->thickness > 0 ? 0.5 * own->thickness : parts_[part].beam_radius;
            const auto& ends = model_.beams.nodes[beam];
            const double length = norm(model_.nodes.position[ends[1]] - model_.nodes.position[ends[0]]);
            const double axial = length > 0 ? parts_[part].bulk_modulus * parts_[part].beam_area / length : 0;
            for (int end = 0; end < 2; ++end) {
                entries.push_back({ends[end], part, radius, side_.stiffness_scale * axial});
            }
        }
        for (Index particle : particles_) entries.push_back(particle_node(particle));
        std::stable_sort(entries.begin(), entries.end(),
                         [](const ContactNode& a, const ContactNode& b) { return a.node < b.node; });
        for (const ContactNode& entry : entries) {
            if (surface_.nodes.empty() || surface_.nodes.back().node != entry.node) {
                surface_.nodes.push_back(entry);
                continue;
            }
            ContactNode& joined = surface_.nodes.back();
            joined.half_thickness = std::max(joined.half_thickness, entry.half_thickness);
            joined.stiffness = std::max(joined.stiffness, entry.stiffness);
        }
        if (side_.kind == ContactSide::Kind::nodes) take_listed_nodes();
    }

    ContactNode particle_node(Index particle) const
    {
        const Index part = model_.particles.part[particle];
        const PartContact* own = part_contact(part);
        const double mass = model_.particles.mass[particle], density = parts_[part].density;
        const double volume = mass < 0 ? -mass : density > 0 ? mass / density : 0;
        const double edge = std::cbrt(volume);
        double thickness = side_.thickness > 0 ? side_.thickness : particles_have_thickness() ? edge : 0;
        if (own && own->thickness > 0) thickness = own->thickness;
        const double scale = side_.stiffness_scale * (own ? own->stiffness_scale : 1);
        return {model_.particles.node[particle], part, 0.5 * thickness,
                scale * parts_[part].bulk_modulus * edge};
    }

    /// ITHK of *CONTROL_SPH.
    bool particles_have_thickness() const
    {
        for (const Record& record : model_.others) {
            if (record.keyword == "CONTROL_SPH" && record.integer("ITHK") == 1) return true;
        }
        return false;
    }

    /// A node set: thickness and stiffness are those of the elements at the node, whatever their part.
    void take_listed_nodes()
    {
        ContactSide everything = side_;
        everything.kind = ContactSide::Kind::all;
        everything.nodes.clear();
        everything.box.reset();
        const Surface whole = make_surface(model_, parts_, everything, options_);
        std::vector<Index> wanted = side_.nodes;
        std::sort(wanted.begin(), wanted.end());
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        std::vector<ContactNode> listed = whole.nodes;
        if (options_.with_particles && model_.particles.size() > 0) {
            for (std::size_t i = 0; i < model_.particles.size(); ++i) {
                listed.push_back(particle_node(static_cast<Index>(i)));
            }
            std::stable_sort(listed.begin(), listed.end(),
                             [](const ContactNode& a, const ContactNode& b) { return a.node < b.node; });
        }
        auto known = listed.cbegin();
        for (Index node : wanted) {
            if (side_.box && !side_.box->holds(model_.nodes.position[node])) continue;
            while (known != listed.cend() && known->node < node) ++known;
            const bool found = known != listed.cend() && known->node == node;
            surface_.nodes.push_back(found ? *known : ContactNode{node, none, 0, 0});
            if (side_.thickness > 0) surface_.nodes.back().half_thickness = 0.5 * side_.thickness;
        }
    }
};

} // namespace

SurfaceOptions surface_options(const Contact& contact)
{
    SurfaceOptions options;
    options.inner_faces = contact.eroding;
    options.orient_by_deck = !contact.automatic;
    const bool single =
        contact.kind == Contact::Kind::single_surface || contact.kind == Contact::Kind::general;
    options.limit_thickness = single && contact.limit_thickness;
    options.thickness_option = contact.thickness_option;
    options.with_beams =
        contact.kind == Contact::Kind::general || contact.keyword.find("BEAMS_TO") != std::string::npos;
    options.spot_weld_beams = contact.spot_weld_beams || contact.kind != Contact::Kind::general;
    options.with_particles = !single;
    options.penetration_factor = contact.largest_penetration;
    options.solid_thickness = contact.solid_thickness;
    options.solid_modulus = contact.solid_modulus;
    options.drop_symmetry_faces = contact.drop_symmetry_faces;
    return options;
}

Surface make_surface(const Model& model, const std::vector<PartData>& parts, const ContactSide& side,
                     const SurfaceOptions& options)
{
    return SurfaceBuilder(model, parts, side, options).take();
}

} // namespace plash

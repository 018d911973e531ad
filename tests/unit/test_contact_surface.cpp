#include "contact/contact_mesh.h"
#include "contact/solid_faces.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

using testing::ContactModel;

Surface surface_of_all(const Model& model, const SurfaceOptions& options = {})
{
    ContactSide side;
    side.kind = ContactSide::Kind::all;
    return make_surface(model, part_data(model), side, options);
}

Vec3 normal_of(const Model& model, const Segment& segment)
{
    const auto p = [&](int i) { return model.nodes.position[segment.nodes[i]]; };
    return unit(cross(p(2) - p(0), segment.nodes[3] == segment.nodes[2] ? p(2) - p(1) : p(3) - p(1)));
}

Vec3 center_of(const Model& model, const Segment& segment)
{
    Vec3 sum{};
    for (Index node : segment.nodes) sum += 0.25 * model.nodes.position[node];
    return sum;
}

} // namespace

TEST(ContactSurface, FindsTheExteriorFacesOfABlockPointingOutward)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 0);
    mesh.add_block(part, {0, 0, 0}, {3, 2, 2}, {6, 4, 4});
    const Surface surface = surface_of_all(mesh.model);
    EXPECT_EQ(surface.segments.size(), 2u * (6 * 4 + 4 * 4 + 6 * 4));
    for (const Segment& segment : surface.segments) {
        EXPECT_GT(dot(normal_of(mesh.model, segment), center_of(mesh.model, segment) - Vec3{1.5, 1, 1}), 0);
        EXPECT_TRUE(segment.one_sided);
        EXPECT_EQ(segment.covered_by, none);
        // K A^2 / V of a cube of 0.5: K times 0.5; K = E / (3 (1 - 2 nu)).
        EXPECT_NEAR(segment.stiffness, 210 / (3 * 0.4) * 0.5, 1e-9);
    }
    // All nodes but the inner ones.
    EXPECT_EQ(surface.nodes.size(), 7u * 5 * 5 - 5 * 3 * 3);
}

TEST(ContactSurface, InnerFacesAppearTwiceAndShowWhenTheirNeighbourHasGone)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 0);
    mesh.add_block(part, {0, 0, 0}, {2, 1, 1}, {2, 1, 1});
    SurfaceOptions options;
    options.inner_faces = true;
    const Surface surface = surface_of_all(mesh.model, options);
    EXPECT_EQ(surface.segments.size(), 12u);
    State state = mesh.state();
    const auto exposed = [&] {
        return std::count_if(surface.segments.begin(), surface.segments.end(),
                             [&](const Segment& segment) { return is_exposed(segment, state); });
    };
    EXPECT_EQ(exposed(), 10);
    state.deleted_solids = {1, 0};
    EXPECT_EQ(exposed(), 6);
}

TEST(ContactSurface, DegenerateSolidsHaveTheirOwnFaces)
{
    std::vector<SolidFace> faces;
    append_faces({0, 1, 2, 3, 3, 3, 3, 3}, 0, faces);
    EXPECT_EQ(faces.size(), 4u) << "tetrahedron";
    faces.clear();
    append_faces({0, 1, 2, 3, 4, 4, 5, 5}, 0, faces);
    EXPECT_EQ(faces.size(), 5u) << "wedge";
    faces.clear();
    append_faces({0, 1, 2, 3, 4, 4, 4, 4}, 0, faces);
    EXPECT_EQ(faces.size(), 5u) << "pyramid";
    // Two tetrahedra on one face know each other.
    Model model;
    model.solids.id = {1, 2};
    model.solids.part = {0, 0};
    model.solids.nodes = {{0, 1, 2, 3, 3, 3, 3, 3}, {0, 2, 1, 4, 4, 4, 4, 4}};
    int inner = 0;
    for (const SolidFace& face : solid_faces(model)) inner += face.neighbour != none;
    EXPECT_EQ(inner, 2);
}

TEST(ContactSurface, ThicknessComesFromWhereTheManualSays)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 2.0);
    mesh.add_sheet(part, 2, 1, [](double u, double v) { return Vec3{2 * u, v, 0}; });
    SurfaceOptions options;
    options.thickness_option = 2;
    const auto half = [&](const ContactSide& side) {
        return make_surface(mesh.model, part_data(mesh.model), side, options).segments[0].half_thickness;
    };
    ContactSide side;
    side.kind = ContactSide::Kind::all;
    EXPECT_DOUBLE_EQ(half(side), 1.0);
    side.thickness_scale = 0.5;
    EXPECT_DOUBLE_EQ(half(side), 0.5);
    options.limit_thickness = true; // 40 % of the shortest edge, which is 1
    EXPECT_DOUBLE_EQ(half(side), 0.2);
    side.thickness = 0.6; // SST is not limited
    EXPECT_DOUBLE_EQ(half(side), 0.3);
    mesh.model.part_contacts[part].thickness = 0.8; // OPTT takes precedence
    EXPECT_DOUBLE_EQ(half(side), 0.4);
    options.thickness_option = 0;
    EXPECT_DOUBLE_EQ(half(side), 0);
}

/// SLDTHK and SLDSTF: solids touch as if shells covered them, and with another modulus.
TEST(ContactSurface, SolidsTakeThicknessAndModulusOfTheContact)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 0);
    mesh.add_block(part, {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    SurfaceOptions options;
    EXPECT_EQ(surface_of_all(mesh.model, options).segments[0].half_thickness, 0);
    options.solid_thickness = 0.06;
    options.solid_modulus = 40;
    const Surface surface = surface_of_all(mesh.model, options);
    for (const Segment& segment : surface.segments) {
        EXPECT_DOUBLE_EQ(segment.half_thickness, 0.03);
        EXPECT_NEAR(segment.stiffness, 40 * 0.5, 1e-12); // K A^2 / V of a cube of 0.5
    }
    for (const ContactNode& node : surface.nodes) EXPECT_DOUBLE_EQ(node.half_thickness, 0.03);
    options.thickness_option = 0;
    EXPECT_EQ(surface_of_all(mesh.model, options).segments[0].half_thickness, 0);
}

/// ISYM: faces whose nodes are all held along the normal, by global or by local axes, show no face; a face
/// that is clamped at one side only does.
TEST(ContactSurface, NoFacesInPlanesOfSymmetry)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 0);
    mesh.add_block(part, {0, 0, 0}, {2, 1, 1}, {2, 1, 1});
    const auto nodes_where = [&](auto&& holds) {
        std::vector<Index> nodes;
        for (Index i = 0; i < static_cast<Index>(mesh.model.nodes.size()); ++i)
            if (holds(mesh.model.nodes.position[i])) nodes.push_back(i);
        return nodes;
    };
    FixedNodes at_x, at_y;
    at_x.nodes = nodes_where([](const Vec3& place) { return place.x == 0; });
    at_x.freedoms = 1;
    at_y.nodes = nodes_where([](const Vec3& place) { return place.y == 0; });
    at_y.freedoms = 4; // z of axes that are turned
    at_y.local = true;
    at_y.axes = {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
    mesh.model.fixed_nodes = {at_x, at_y};
    SurfaceOptions options;
    EXPECT_EQ(surface_of_all(mesh.model, options).segments.size(), 10u);
    options.drop_symmetry_faces = true;
    const Surface surface = surface_of_all(mesh.model, options);
    EXPECT_EQ(surface.segments.size(), 7u) << "one face at x = 0 and two at y = 0 are left out";
    for (const Segment& segment : surface.segments) {
        const Vec3 center = center_of(mesh.model, segment);
        EXPECT_GT(center.x, 0.1);
        EXPECT_GT(center.y, 0.1);
    }
    mesh.model.fixed_nodes[0].birth = 1; // free at the start
    EXPECT_EQ(surface_of_all(mesh.model, options).segments.size(), 8u);
}

TEST(ContactMesh, KnowsWhoActsOnWhom)
{
    ContactModel mesh;
    const Index upper = mesh.add_part(1, 210, 1.0), lower = mesh.add_part(1, 210, 1.0);
    mesh.add_sheet(upper, 2, 2, [](double u, double v) { return Vec3{u, v, 1}; });
    mesh.add_sheet(lower, 2, 2, [](double u, double v) { return Vec3{u, v, 0}; });
    ContactSide slave, master;
    slave.kind = master.kind = ContactSide::Kind::parts;
    slave.parts = {upper};
    master.parts = {lower};
    Contact contact;
    const auto facets_with = [&](Contact::Kind kind) {
        contact.kind = kind;
        const auto parts = part_data(mesh.model);
        const Surface a = make_surface(mesh.model, parts, slave, {});
        const Surface b = make_surface(mesh.model, parts, master, {});
        return make_contact_mesh(contact, a, b, mesh.model.nodes.position);
    };
    const ContactMesh one_way = facets_with(Contact::Kind::one_way);
    EXPECT_EQ(one_way.facets.size(), 4u);
    const ContactMesh two_way = facets_with(Contact::Kind::two_way);
    EXPECT_EQ(two_way.facets.size(), 8u);
    for (const auto& node : two_way.nodes) {
        for (const auto& facet : two_way.facets) {
            EXPECT_EQ((node.acts_on & facet.belongs) != 0, node.part != facet.part);
        }
    }
    // 2 x 2 facets: 12 edges, 4 of them between two facets.
    int between = 0;
    for (std::size_t edge = 0; edge < one_way.edge_corner.size(); ++edge) {
        between += one_way.facets_at_edge(static_cast<Index>(edge)).size() == 2;
    }
    EXPECT_EQ(one_way.edge_corner.size(), 12u);
    EXPECT_EQ(between, 4);
}

/// LS-DYNA's single surface contacts: 40 % of the shortest side limits the thickness, node by node.
TEST(ContactSurface, ShortSidesLimitTheThicknessAroundTheirNodes)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1, 210, 1.0);
    // A row of three shells, 1, 4 and 4 long, all 4 wide.
    const double place[] = {0, 1, 5, 9};
    mesh.add_sheet(part, 3, 1, [&](double u, double v) {
        return Vec3{place[static_cast<int>(3 * u + 0.5)], 4 * v, 0};
    });
    SurfaceOptions options;
    options.limit_thickness = true;
    const Surface surface = surface_of_all(mesh.model, options);
    for (const ContactNode& node : surface.nodes) {
        const bool short_side = mesh.model.nodes.position[node.node].x < 2;
        EXPECT_DOUBLE_EQ(node.half_thickness, short_side ? 0.2 : 0.5);
    }
    ASSERT_EQ(surface.segments.size(), 3u);
    EXPECT_DOUBLE_EQ(surface.segments[0].half_thickness, 0.2);
    EXPECT_DOUBLE_EQ(surface.segments[1].half_thickness, 0.2) << "as its thinnest corner";
    EXPECT_DOUBLE_EQ(surface.segments[2].half_thickness, 0.5);
}

} // namespace plash

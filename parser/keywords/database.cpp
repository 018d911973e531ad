// *DATABASE family: which results, how often, for which nodes and elements.

#include "parser/reading.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {
namespace {

std::string lower(std::string_view text)
{
    std::string result(text);
    for (char& character : result)
        if (character >= 'A' && character <= 'Z') character += 'a' - 'A';
    return result;
}

OutputRequest request_of(const Record& record, std::string_view curve, Reading& reading)
{
    OutputRequest request;
    request.where = record.where;
    request.interval = record.real("DT");
    if (request.interval < 0) reading.error(record, "DT", "the interval is negative");
    if (record.peek("BINARY")) request.binary = static_cast<int>(record.integer("BINARY"));
    if (!curve.empty()) request.interval_curve = reading.find(record, curve, Kind::curve);
    return request;
}

void read_ascii(const Record& record, const Block&, Reading& reading)
{
    const std::string name =
        lower(std::string_view(record.keyword).substr(std::string_view("DATABASE_").size()));
    reading.model.controls.output.ascii[name] = request_of(record, "LCUR", reading);
}

/// NPLTC asks for a number of states instead of an interval.
OutputRequest state_request_of(const Record& record, Reading& reading)
{
    OutputRequest request = request_of(record, "LCDT", reading);
    request.states = static_cast<int>(record.integer("NPLTC"));
    return request;
}

void read_d3plot(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.output.d3plot = state_request_of(record, reading);
}

void read_d3thdt(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.output.ascii["d3thdt"] = state_request_of(record, reading);
}

void read_intfor(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.output.ascii["intfor"] = state_request_of(record, reading);
}

void read_intfor_file(const Record& record, const Block& block, Reading& reading)
{
    read_intfor(record, block, reading);
    reading.warning(record, "FILENAME", "interface.pvd is the name of what Plash writes");
}

/// The interval of restart files counts cycles. Decks write it as a real number, and one so large that it
/// means never.
long cycles_between(const Record& record, Reading& reading)
{
    const double cycles = record.real("CYCL");
    if (cycles < 0) reading.error(record, "CYCL", "the number of cycles is negative");
    return cycles < 1e15 ? static_cast<long>(cycles) : 0;
}

void read_d3dump(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.output.restart.dump_cycles = cycles_between(record, reading);
}

/// CYCL counts the looks of dynamic relaxation at its convergence.
void read_d3drlf(const Record& record, const Block&, Reading& reading)
{
    reading.model.controls.output.relaxation_states = cycles_between(record, reading);
}

void read_runrsf(const Record& record, const Block&, Reading& reading)
{
    RestartRequest& request = reading.model.controls.output.restart;
    request.running_cycles = cycles_between(record, reading);
    request.running_files = static_cast<int>(record.integer("NR"));
}

void read_extent(const Record& record, const Block&, Reading& reading)
{
    // What output/d3plot_layout.cpp takes into account; other fields stay unread and are reported.
    for (const char* field :
         {"NEIPH", "NEIPS", "MAXINT", "STRFLG", "SIGFLG", "EPSFLG", "RLTFLG", "ENGFLG", "IEVERP", "BEAMIP"})
        reading.model.controls.output.extent[field] = record.real(field);
}

/// Positions of the nodes or elements that a history names, directly or by sets.
void read_history(const Record& record, Kind kind, Kind set_kind, std::vector<Index>& chosen,
                  Reading& reading)
{
    const Table* table = record.table("ID");
    if (!table) return;
    const bool sets = record.keyword.ends_with("_SET");
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const Id id = static_cast<Id>(table->at(row, 0));
        if (id == 0) continue;
        const Index found = reading.look_up(sets ? set_kind : kind, id);
        if (found == none) continue; // reported with all references
        if (!sets) {
            chosen.push_back(found);
            continue;
        }
        const Model& model = reading.model;
        const std::vector<Index>& members = set_kind == Kind::node_set    ? model.node_sets[found].nodes
                                            : set_kind == Kind::shell_set ? model.shell_sets[found].elements
                                            : set_kind == Kind::beam_set  ? model.beam_sets[found].elements
                                            : set_kind == Kind::tshell_set
                                                ? model.thick_shell_sets[found].elements
                                                : model.solid_sets[found].elements;
        chosen.insert(chosen.end(), members.begin(), members.end());
    }
}

void read_node_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::node, Kind::node_set, reading.model.controls.output.history_nodes, reading);
}

/// A particle has the number of its node.
void read_particle_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::node, Kind::node_set, reading.model.controls.output.history_particles,
                 reading);
}

void read_shell_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::shell, Kind::shell_set, reading.model.controls.output.history_shells, reading);
}

void read_thick_shell_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::tshell, Kind::tshell_set, reading.model.controls.output.history_thick_shells,
                 reading);
}

void read_beam_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::beam, Kind::beam_set, reading.model.controls.output.history_beams, reading);
}

void read_solid_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::solid, Kind::solid_set, reading.model.controls.output.history_solids, reading);
}

void read_force_group(const Record& record, const Block&, Reading& reading)
{
    NodalForceGroup group;
    group.id = record.id;
    group.title = record.title;
    group.where = record.where;
    const Index set = reading.find(record, "NSID", Kind::node_set);
    if (set != none) group.nodes = reading.model.node_sets[set].nodes;
    group.system = reading.find(record, "CID", Kind::coordinate);
    if (!group.nodes.empty()) reading.model.nodal_force_groups.push_back(std::move(group));
}

/// What *DATABASE_CROSS_SECTION_PLANE cuts: an endless plane, a rectangle from its tail, or a circle around
/// it.
struct CutPlane {
    Vec3 tail{}, normal{}, edge{};
    double length_l = 0, length_m = 0, radius = 0;

    double height(const Vec3& place) const { return dot(place - tail, normal); }
    bool within(const Vec3& place) const
    {
        const Vec3 arm = place - tail;
        const double l = dot(arm, edge), m = dot(arm, cross(normal, edge));
        if (radius > 0) return norm(arm - dot(arm, normal) * normal) <= radius;
        return (length_l == 0 || (l >= 0 && l <= length_l)) && (length_m == 0 || (m >= 0 && m <= length_m));
    }
};

/// Area of the convex polygon in which a plane cuts an element: from all pairs of corners on both sides,
/// which includes the edges, and whose other points lie inside.
double cut_area(const CutPlane& cut, const std::vector<Vec3>& corners)
{
    std::vector<std::pair<double, double>> points; // in the plane
    const Vec3 helper = std::abs(cut.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 a = unit(cross(cut.normal, helper)), b = cross(cut.normal, a);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double hi = cut.height(corners[i]), hj = cut.height(corners[j]);
            if ((hi > 0) == (hj > 0)) continue;
            const Vec3 place = corners[i] + (hi / (hi - hj)) * (corners[j] - corners[i]);
            points.emplace_back(dot(place - cut.tail, a), dot(place - cut.tail, b));
        }
    }
    // Convex hull by Andrew's monotone chain; twice its area by the shoelace formula.
    std::sort(points.begin(), points.end());
    std::vector<std::pair<double, double>> hull;
    const auto turn = [](const auto& o, const auto& p, const auto& q) {
        return (p.first - o.first) * (q.second - o.second) - (p.second - o.second) * (q.first - o.first);
    };
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const auto& point : points) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        if (!hull.empty()) hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const auto& p = hull[i];
        const auto& q = hull[(i + 1) % hull.size()];
        twice += p.first * q.second - q.first * p.second;
    }
    return 0.5 * twice;
}

/// Elements of a topology that the plane cuts, and their nodes on the side of its tail.
template <class Elements>
void cut_elements(const CutPlane& cut, const Elements& elements, const std::vector<bool>& wanted,
                  const Model& model, std::vector<Index>& chosen, CrossSection& section)
{
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!wanted[elements.part[i]]) continue;
        std::vector<Vec3> corners;
        std::vector<Index> behind;
        for (Index node : elements.nodes[i]) {
            if (node == none) continue;
            corners.push_back(model.nodes.position[node]);
            if (cut.height(corners.back()) <= 0) behind.push_back(node);
        }
        if (behind.empty() || behind.size() == corners.size()) continue;
        Vec3 centre{};
        for (const Vec3& corner : corners) centre += (1.0 / static_cast<double>(corners.size())) * corner;
        if (!cut.within(centre)) continue;
        chosen.push_back(static_cast<Index>(i));
        section.nodes.insert(section.nodes.end(), behind.begin(), behind.end());
        if (corners.size() == 8) section.area += cut_area(cut, corners);
    }
}

bool has_room(const Record& record, Reading& reading)
{
    if (reading.model.cross_sections.size() < 64) return true;
    reading.error(record, "", "there are more than 64 cross sections");
    return false;
}

void keep_section(const Record& record, CrossSection section, Reading& reading)
{
    // The number of the suffix _ID stands before a field of the same name on the card itself.
    const auto numbers = std::count_if(record.fields.begin(), record.fields.end(),
                                       [](const Record::Field& field) { return field.name == "ID"; });
    section.id = numbers == 2 && record.integer("ID") != 0
                     ? record.integer("ID")
                     : static_cast<Id>(reading.model.cross_sections.size()) + 1;
    section.title = record.title;
    section.where = record.where;
    std::sort(section.nodes.begin(), section.nodes.end());
    section.nodes.erase(std::unique(section.nodes.begin(), section.nodes.end()), section.nodes.end());
    const bool elements = !section.solids.empty() || !section.shells.empty() || !section.beams.empty() ||
                          !section.thick_shells.empty() || !section.discretes.empty();
    if (!elements || section.nodes.empty()) reading.warning(record, "", "the cross section meets no element");
    if (has_room(record, reading)) reading.model.cross_sections.push_back(std::move(section));
}

void read_section_plane(const Record& record, const Block& block, Reading& reading)
{
    const Model& model = reading.model;
    const Affine motion = reading.motion_of(block);
    CutPlane cut;
    cut.tail = motion.point({record.real("XCT"), record.real("YCT"), record.real("ZCT")});
    cut.normal = unit(motion.point({record.real("XCH"), record.real("YCH"), record.real("ZCH")}) - cut.tail);
    if (norm(cut.normal) < 0.5) {
        reading.error(record, "XCH",
                      "the head (XCH, YCH, ZCH) and tail (XCT, YCT, ZCT) of the normal are one point");
        return;
    }
    cut.radius = record.real("RADIUS");
    cut.length_l = record.real("LENL");
    cut.length_m = record.real("LENM");
    if (cut.radius == 0 && (cut.length_l > 0 || cut.length_m > 0)) {
        const Vec3 edge =
            motion.point({record.real("XHEV"), record.real("YHEV"), record.real("ZHEV")}) - cut.tail;
        cut.edge = unit(edge - dot(edge, cut.normal) * cut.normal);
        if (norm(cut.edge) < 0.5)
            reading.error(record, "XHEV",
                          "the edge vector (XHEV, YHEV, ZHEV) has no direction across the normal");
    }
    std::vector<bool> wanted(model.parts.size(), record.integer("PSID") == 0);
    if (const Index set = reading.find(record, "PSID", Kind::part_set); set != none) {
        for (Index part : model.part_sets[set].parts) wanted[part] = true;
    }
    CrossSection section;
    cut_elements(cut, model.solids, wanted, model, section.solids, section);
    cut_elements(cut, model.shells, wanted, model, section.shells, section);
    cut_elements(cut, model.thick_shells, wanted, model, section.thick_shells, section);
    BeamElements beams = model.beams; // their third node only turns them
    for (auto& nodes : beams.nodes) nodes[2] = none;
    cut_elements(cut, beams, wanted, model, section.beams, section);
    keep_section(record, std::move(section), reading);
}

void read_section_set(const Record& record, const Block&, Reading& reading)
{
    const Model& model = reading.model;
    CrossSection section;
    if (const Index set = reading.find(record, "NSID", Kind::node_set); set != none)
        section.nodes = model.node_sets[set].nodes;
    const auto take = [&](std::string_view field, Kind kind, const std::vector<ElementSet>& sets,
                          std::vector<Index>& elements) {
        if (const Index set = reading.find(record, field, kind); set != none) elements = sets[set].elements;
    };
    take("HSID", Kind::solid_set, model.solid_sets, section.solids);
    take("BSID", Kind::beam_set, model.beam_sets, section.beams);
    take("SSID", Kind::shell_set, model.shell_sets, section.shells);
    take("TSID", Kind::tshell_set, model.thick_shell_sets, section.thick_shells);
    take("DSID", Kind::discrete_set, model.discrete_sets, section.discretes);
    keep_section(record, std::move(section), reading);
}

/// Kept as it is; says what output/dbfsi.cpp leaves out of its rows.
void read_fluid_surfaces(const Record& record, const Block&, Reading& reading)
{
    constexpr std::pair<std::size_t, const char*> unused[] = {{3, "SWID"}, {4, "CONVID"}, {5, "NDSETID"}};
    if (const Table* table = record.table("DBFSI_ID")) {
        for (const auto& [column, name] : unused)
            for (std::size_t row = 0; row < table->rows(); ++row)
                if (table->at(row, column) != 0) {
                    reading.warning(record, name,
                                    "dbfsi shows pressure and force; it has no switched mass, no temperature "
                                    "and no moments");
                    break;
                }
    }
    reading.model.others.push_back(record);
}

constexpr Translator database_table[] = {
    {"DATABASE_FSI", Phase::conditions, read_fluid_surfaces},
    {"DATABASE_DEFORC", Phase::conditions, read_ascii},
    {"DATABASE_DISBOUT", Phase::conditions, read_ascii},
    {"DATABASE_NODFOR", Phase::conditions, read_ascii},
    {"DATABASE_NODAL_FORCE_GROUP", Phase::conditions, read_force_group},
    {"DATABASE_SECFORC", Phase::conditions, read_ascii},
    {"DATABASE_CROSS_SECTION_PLANE", Phase::conditions, read_section_plane},
    {"DATABASE_CROSS_SECTION_SET", Phase::conditions, read_section_set},
    {"DATABASE_GLSTAT", Phase::conditions, read_ascii},
    {"DATABASE_MATSUM", Phase::conditions, read_ascii},
    {"DATABASE_NODOUT", Phase::conditions, read_ascii},
    {"DATABASE_ELOUT", Phase::conditions, read_ascii},
    {"DATABASE_RWFORC", Phase::conditions, read_ascii},
    {"DATABASE_RCFORC", Phase::conditions, read_ascii},
    {"DATABASE_SLEOUT", Phase::conditions, read_ascii},
    {"DATABASE_NCFORC", Phase::conditions, read_ascii},
    {"DATABASE_SPCFORC", Phase::conditions, read_ascii},
    {"DATABASE_BNDOUT", Phase::conditions, read_ascii},
    {"DATABASE_RBDOUT", Phase::conditions, read_ascii},
    {"DATABASE_JNTFORC", Phase::conditions, read_ascii},
    {"DATABASE_RCFORC", Phase::conditions, read_ascii},
    {"DATABASE_SLEOUT", Phase::conditions, read_ascii},
    {"DATABASE_NCFORC", Phase::conditions, read_ascii},
    {"DATABASE_SPHOUT", Phase::conditions, read_ascii},
    {"DATABASE_ABSTAT", Phase::conditions, read_ascii},
    {"DATABASE_TRHIST", Phase::conditions, read_ascii},
    {"DATABASE_BINARY_D3PLOT", Phase::conditions, read_d3plot},
    {"DATABASE_BINARY_D3THDT", Phase::conditions, read_d3thdt},
    {"DATABASE_BINARY_INTFOR", Phase::conditions, read_intfor},
    {"DATABASE_BINARY_INTFOR_FILE", Phase::conditions, read_intfor_file},
    {"DATABASE_BINARY_D3DUMP", Phase::conditions, read_d3dump},
    {"DATABASE_BINARY_D3DRLF", Phase::conditions, read_d3drlf},
    {"DATABASE_BINARY_RUNRSF", Phase::conditions, read_runrsf},
    {"DATABASE_EXTENT_BINARY", Phase::conditions, read_extent},
    {"DATABASE_HISTORY_NODE", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_NODE_ID", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_NODE_SET", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_SHELL", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_SHELL_ID", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_SHELL_SET", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_BEAM", Phase::conditions, read_beam_history},
    {"DATABASE_HISTORY_BEAM_ID", Phase::conditions, read_beam_history},
    {"DATABASE_HISTORY_BEAM_SET", Phase::conditions, read_beam_history},
    {"DATABASE_SWFORC", Phase::conditions, read_ascii},
    {"DATABASE_HISTORY_SPH", Phase::conditions, read_particle_history},
    {"DATABASE_HISTORY_SPH_SET", Phase::conditions, read_particle_history},
    {"DATABASE_HISTORY_TSHELL", Phase::conditions, read_thick_shell_history},
    {"DATABASE_HISTORY_TSHELL_ID", Phase::conditions, read_thick_shell_history},
    {"DATABASE_HISTORY_TSHELL_SET", Phase::conditions, read_thick_shell_history},
    {"DATABASE_HISTORY_SOLID", Phase::conditions, read_solid_history},
    {"DATABASE_HISTORY_SOLID_ID", Phase::conditions, read_solid_history},
    {"DATABASE_HISTORY_SOLID_SET", Phase::conditions, read_solid_history},
};

} // namespace

std::span<const Translator> database_keywords()
{
    return database_table;
}

} // namespace plash

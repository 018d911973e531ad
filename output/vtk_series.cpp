#include "output/vtk_series.h"

#include "core/run_error.h"
#include "model/eulerian.h"
#include "output/nodal_motion.h"
#include "output/result_file.h"
#include "output/vtu_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace plash {

namespace {

using Stress = SymmetricTensor<double>;

constexpr int layers = 3;                ///< middle, innermost, outermost
constexpr std::uint8_t hidden_cell = 32; ///< vtkDataSetAttributes::HIDDENCELL

void put(std::vector<float>& values, const Vec3& v)
{
    for (double x : {v.x, v.y, v.z}) values.push_back(static_cast<float>(x));
}

void put(std::vector<float>& values, const Stress& s)
{
    for (double x : {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}) values.push_back(static_cast<float>(x));
}

template <int Corners>
void put_numbers(const Elements<Corners>& elements, const Model& model, std::vector<std::int64_t>& ids,
                 std::vector<std::int64_t>& parts)
{
    ids.insert(ids.end(), elements.id.begin(), elements.id.end());
    for (Index part : elements.part) parts.push_back(model.parts[part].id);
}

void add_nodes(VtuFile& file, const Snapshot& snapshot)
{
    const NodalMotion motion(snapshot, false);
    const auto count = static_cast<Index>(snapshot.state.size());
    std::vector<float> displacement, velocity;
    for (Index node = 0; node < count; ++node) {
        put(file.points, motion.position(node));
        put(displacement, motion.displacement(node));
        put(velocity, motion.velocity(node));
    }
    file.add_point_array("node_id", 1, snapshot.model.nodes.id);
    file.add_point_array("displacement", 3, displacement);
    file.add_point_array("velocity", 3, velocity);
}

void add_element_numbers(VtuFile& file, const Model& model)
{
    std::vector<std::int64_t> ids, parts;
    put_numbers(model.shells, model, ids, parts);
    put_numbers(model.solids, model, ids, parts);
    put_numbers(model.thick_shells, model, ids, parts);
    for (Index node : model.particles.node) ids.push_back(model.nodes.id[node]);
    for (Index part : model.particles.part) parts.push_back(model.parts[part].id);
    file.add_cell_array("element_id", 1, ids);
    file.add_cell_array("part_id", 1, parts);
}

ElementResults collect_results(const Snapshot& snapshot)
{
    const std::size_t shells = snapshot.model.shells.size(), solids = snapshot.model.solids.size();
    ElementResults r;
    r.shell_layers = layers;
    r.shell_stress.resize(shells * layers);
    r.shell_plastic_strain.resize(shells * layers);
    r.shell_thickness.resize(shells);
    r.shell_deleted.resize(shells);
    r.solid_stress.resize(solids);
    r.solid_plastic_strain.resize(solids);
    r.solid_deleted.resize(solids);
    const std::size_t thick_shells = snapshot.model.thick_shells.size();
    r.thick_shell_layers = layers;
    r.thick_shell_stress.resize(thick_shells * layers);
    r.thick_shell_plastic_strain.resize(thick_shells * layers);
    r.thick_shell_deleted.resize(thick_shells);
    if (!snapshot.model.contacts.empty()) {
        r.contact_force.resize(snapshot.model.nodes.size());
        r.contact_pressure.resize(snapshot.model.nodes.size());
    }
    r.particles.resize(snapshot.model.particles.size());
    if (has_eulerian_mesh(snapshot.model)) {
        r.solid_density.resize(solids);
        r.solid_fraction.assign(multi_material_groups(snapshot.model), std::vector<double>(solids));
    }
    snapshot.collect(r);
    return r;
}

void add_element_results(VtuFile& file, const ElementResults& r)
{
    const std::size_t shells = r.shell_deleted.size(), solids = r.solid_deleted.size();
    const std::size_t thick_shells = r.thick_shell_deleted.size();
    std::vector<float> stress[layers], mises, plastic, thickness;
    std::vector<std::uint8_t> eroded(r.shell_deleted), ghost;
    const auto put_layers = [&](const Stress* layer_stress, const double* layer_strain) {
        double largest_mises = 0, largest_strain = 0;
        for (int layer = 0; layer < layers; ++layer) {
            put(stress[layer], layer_stress[layer]);
            largest_mises = std::max(largest_mises, von_mises_stress(layer_stress[layer]));
            largest_strain = std::max(largest_strain, layer_strain[layer]);
        }
        mises.push_back(static_cast<float>(largest_mises));
        plastic.push_back(static_cast<float>(largest_strain));
    };
    for (std::size_t e = 0; e < shells; ++e) {
        put_layers(&r.shell_stress[e * layers], &r.shell_plastic_strain[e * layers]);
        thickness.push_back(static_cast<float>(r.shell_thickness[e]));
    }
    for (std::size_t e = 0; e < solids; ++e) {
        for (auto& layer : stress) put(layer, r.solid_stress[e]);
        mises.push_back(static_cast<float>(von_mises_stress(r.solid_stress[e])));
        plastic.push_back(static_cast<float>(r.solid_plastic_strain[e]));
        thickness.push_back(0);
    }
    eroded.insert(eroded.end(), r.solid_deleted.begin(), r.solid_deleted.end());
    for (std::size_t e = 0; e < thick_shells; ++e) {
        put_layers(&r.thick_shell_stress[e * layers], &r.thick_shell_plastic_strain[e * layers]);
        thickness.push_back(0); // that of the mesh
    }
    eroded.insert(eroded.end(), r.thick_shell_deleted.begin(), r.thick_shell_deleted.end());
    for (const ElementResults::Particle& particle : r.particles) {
        for (auto& layer : stress) put(layer, particle.stress);
        mises.push_back(static_cast<float>(von_mises_stress(particle.stress)));
        plastic.push_back(static_cast<float>(particle.plastic_strain));
        thickness.push_back(0);
        eroded.push_back(particle.active ? 0 : 1);
    }
    for (std::uint8_t gone : eroded) ghost.push_back(gone ? hidden_cell : 0);
    file.add_cell_array("eroded", 1, eroded);
    file.add_cell_array("vtkGhostType", 1, ghost);
    file.add_cell_array("stress", 6, stress[0]);
    if (shells + thick_shells > 0) {
        file.add_cell_array("stress_inner", 6, stress[1]);
        file.add_cell_array("stress_outer", 6, stress[2]);
    }
    file.add_cell_array("von_mises", 1, mises);
    file.add_cell_array("plastic_strain", 1, plastic);
    file.add_cell_array("thickness", 1, thickness);
}

/// What contacts do to the nodes; nothing in a deck without contacts.
void add_contact_results(VtuFile& file, const ElementResults& r)
{
    if (r.contact_force.empty()) return;
    std::vector<float> force, pressure(r.contact_pressure.begin(), r.contact_pressure.end());
    for (const Vec3& f : r.contact_force) put(force, f);
    file.add_point_array("contact_force", 3, force);
    file.add_point_array("contact_pressure", 1, pressure);
}

/// By cell: zero for shells, then solids, zero for thick shells, then particles; either list may be empty.
template <class ParticleValue>
std::vector<float> by_cell(const ElementResults& r, const std::vector<double>& of_solids,
                           ParticleValue&& of_particle)
{
    std::vector<float> values(r.shell_deleted.size());
    values.insert(values.end(), of_solids.begin(), of_solids.end());
    values.resize(r.shell_deleted.size() + r.solid_deleted.size() + r.thick_shell_deleted.size());
    for (const ElementResults::Particle& particle : r.particles)
        values.push_back(static_cast<float>(of_particle(particle)));
    return values;
}

/// What only fluids have: cells of an Eulerian mesh and particles.
void add_fluid_results(VtuFile& file, const ElementResults& r)
{
    if (r.solid_density.empty() && r.particles.empty()) return;
    using Particle = ElementResults::Particle;
    std::vector<double> pressure;
    if (!r.solid_density.empty()) {
        for (const Stress& s : r.solid_stress) pressure.push_back(-(s.xx + s.yy + s.zz) / 3);
    }
    const auto add = [&](const std::string& name, const std::vector<double>& of_solids, auto&& of_particle) {
        file.add_cell_array(name, 1, by_cell(r, of_solids, of_particle));
    };
    add("density", r.solid_density, [](const Particle& particle) { return particle.density; });
    add("pressure", pressure, [](const Particle& particle) { return particle.pressure; });
    for (std::size_t group = 0; group < r.solid_fraction.size(); ++group)
        add(fmt::format("volume_fraction_{}", group + 1), r.solid_fraction[group],
            [](const Particle&) { return 0; });
    if (r.particles.empty()) return;
    add("smoothing_length", {}, [](const Particle& particle) { return particle.smoothing; });
    add("internal_energy", {}, [](const Particle& particle) { return particle.internal_energy; });
    add("neighbours", {}, [](const Particle& particle) { return particle.neighbours; });
}

/// Makes the folder, and removes the states that an earlier run left in it.
void prepare_folder(const std::string& folder)
{
    namespace fs = std::filesystem;
    try {
        fs::create_directories(folder);
        std::vector<fs::path> old_states;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("result_") && name.ends_with(".vtu")) old_states.push_back(entry.path());
        }
        for (const fs::path& state : old_states) fs::remove(state);
    } catch (const fs::filesystem_error& error) {
        throw RunError(fmt::format("result folder {} cannot be used: {}", folder, error.code().message()));
    }
}

} // namespace

VtkSeries::VtkSeries(const Model& model, Schedule schedule, const ResultPath& directory)
    : ScheduledRecorder(std::move(schedule)), directory_(directory.path), walls_(!model.rigid_walls.empty())
{
    for (const auto& nodes : model.shells.nodes) cells_.push_back(shell_cell(nodes));
    for (Index solid = 0; solid < static_cast<Index>(model.solids.size()); ++solid) {
        const auto* ten = ten_nodes(model, solid);
        cells_.push_back(ten ? tetrahedron_cell(*ten) : solid_cell(model.solids.nodes[solid]));
    }
    for (const auto& nodes : model.thick_shells.nodes) cells_.push_back(solid_cell(nodes));
    for (Index node : model.particles.node) cells_.push_back(vertex_cell(node));
    if (directory.resume) {
        std::filesystem::create_directories(directory_ + "/vtk");
        return;
    }
    prepare_folder(directory_ + "/vtk");
    write_index();
}

void VtkSeries::serialise_files(Archive& archive)
{
    archive(files_);
    if (archive.loading()) write_index();
}

void VtkSeries::write_state(const Snapshot& snapshot)
{
    VtuFile file;
    for (const Cell& cell : cells_) file.add_cell(cell);
    add_nodes(file, snapshot);
    add_element_numbers(file, snapshot.model);
    const ElementResults results = collect_results(snapshot);
    add_element_results(file, results);
    add_contact_results(file, results);
    add_fluid_results(file, results);
    const std::string name = fmt::format("vtk/result_{:04}.vtu", files_.size());
    file.write(directory_ + "/" + name, snapshot.clock.time);
    files_.emplace_back(snapshot.clock.time, name);
    write_index();
}

void VtkSeries::write_index() const
{
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& [time, name] : files_) {
        fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time,
                       name);
        if (!walls_) continue;
        fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" part=\"1\" file=\"walls.vtu\"/>\n",
                       time);
    }
    replace_file(directory_ + "/result.pvd", text + "</Collection>\n</VTKFile>\n");
}

void write_walls(const Model& model, const std::string& directory)
{
    if (model.rigid_walls.empty()) return;
    Vec3 low{}, high{};
    if (!model.nodes.position.empty()) low = high = model.nodes.position[0];
    for (const Vec3& x : model.nodes.position) {
        low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
        high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    const Vec3 center = 0.5 * (low + high);
    const double half_side = 0.6 * norm(high - low);

    VtuFile file;
    std::vector<std::int64_t> ids;
    for (const RigidWall& wall : model.rigid_walls) {
        const Vec3 foot = center - dot(center - wall.tail, wall.normal) * wall.normal;
        const Vec3 helper = std::abs(wall.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 a = half_side * unit(cross(wall.normal, helper));
        const Vec3 b = cross(wall.normal, a);
        const auto first = static_cast<Index>(file.points.size() / 3);
        for (const Vec3& corner : {foot - a - b, foot + a - b, foot + a + b, foot - a + b})
            put(file.points, corner);
        file.add_cell(shell_cell({first, first + 1, first + 2, first + 3}));
        ids.push_back(wall.id);
    }
    file.add_cell_array("wall_id", 1, ids);
    file.write(directory + "/walls.vtu", 0);
}

} // namespace plash

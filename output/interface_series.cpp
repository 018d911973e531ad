#include "output/interface_series.h"

#include "core/run_error.h"
#include "output/nodal_motion.h"
#include "output/vtu_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace plash {

namespace {

void put_vector(std::vector<float>& values, const Vec3& v)
{
    for (double x : {v.x, v.y, v.z}) values.push_back(static_cast<float>(x));
}

void remove_old_interfaces(const std::string& folder)
{
    namespace fs = std::filesystem;
    try {
        fs::create_directories(folder);
        std::vector<fs::path> old;
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().filename().string().starts_with("interface_")) old.push_back(entry.path());
        for (const fs::path& file : old) fs::remove(file);
    } catch (const fs::filesystem_error& error) {
        throw RunError(fmt::format("result folder {} cannot be used: {}", folder, error.code().message()));
    }
}

} // namespace

InterfaceSeries::InterfaceSeries(const Model&, Schedule schedule, const ResultPath& directory)
    : ScheduledRecorder(std::move(schedule)), directory_(directory.path)
{
    if (directory.resume) {
        std::filesystem::create_directories(directory_ + "/vtk");
        return;
    }
    remove_old_interfaces(directory_ + "/vtk");
    write_index();
}

void InterfaceSeries::serialise_files(Archive& archive)
{
    archive(files_);
    if (archive.loading()) write_index();
}

/// Only the nodes of the segments are written.
void InterfaceSeries::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.contact_faces_wanted = true;
    snapshot.collect(results);
    const NodalMotion motion(snapshot, false);
    std::vector<Index> number(snapshot.state.size(), none);
    VtuFile file;
    std::vector<std::int64_t> node_id, contact, part;
    std::vector<std::int32_t> surface;
    std::vector<float> displacement, pressure, shear, shear_size, penetration, friction_energy;
    const auto& contacts = snapshot.model.contacts;
    const bool with_friction_energy =
        std::any_of(contacts.begin(), contacts.end(), [](const Contact& one) { return one.friction_energy; });
    for (const ElementResults::ContactFace& face : results.contact_faces) {
        auto nodes = face.nodes;
        for (Index& node : nodes) {
            if (number[node] == none) {
                number[node] = static_cast<Index>(node_id.size());
                node_id.push_back(snapshot.model.nodes.id[node]);
                put_vector(file.points, motion.position(node));
                put_vector(displacement, motion.displacement(node));
            }
            node = number[node];
        }
        file.add_cell(shell_cell(nodes));
        contact.push_back(face.contact);
        part.push_back(face.part == none ? 0 : snapshot.model.parts[face.part].id);
        surface.push_back(face.sides);
        pressure.push_back(static_cast<float>(face.pressure));
        put_vector(shear, face.shear);
        shear_size.push_back(static_cast<float>(norm(face.shear)));
        penetration.push_back(static_cast<float>(face.penetration));
        friction_energy.push_back(static_cast<float>(face.friction_energy));
    }
    file.add_point_array("node_id", 1, node_id);
    file.add_point_array("displacement", 3, displacement);
    file.add_cell_array("contact_id", 1, contact);
    file.add_cell_array("surface", 1, surface);
    file.add_cell_array("part_id", 1, part);
    file.add_cell_array("pressure", 1, pressure);
    file.add_cell_array("shear", 3, shear);
    file.add_cell_array("shear_size", 1, shear_size);
    file.add_cell_array("penetration", 1, penetration);
    if (with_friction_energy) file.add_cell_array("friction_energy", 1, friction_energy);
    const std::string name = fmt::format("vtk/interface_{:04}.vtu", files_.size());
    file.write(directory_ + "/" + name, snapshot.clock.time);
    files_.emplace_back(snapshot.clock.time, name);
    write_index();
}

void InterfaceSeries::write_index() const
{
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& [time, name] : files_)
        fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time,
                       name);
    replace_file(directory_ + "/interface.pvd", text + "</Collection>\n</VTKFile>\n");
}

} // namespace plash

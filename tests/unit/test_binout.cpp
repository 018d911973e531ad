#include "output/binout.h"
#include "output/history_file.h"
#include "output/lsda_file.h"
#include "output/recorders.h"
#include "tests/support/lsda_reader.h"
#include "tests/support/snapshot_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <hdf5.h>
#include <iterator>

namespace plash {

namespace {

using testing::read_lsda;
using testing::TemporaryFolder;

std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Shape and numbers of an HDF5 array.
struct H5Array {
    std::vector<hsize_t> shape;
    std::vector<double> values;
};

H5Array read_h5(const std::string& path, const char* name)
{
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    H5Array array;
    array.shape.resize(H5Sget_simple_extent_ndims(space));
    H5Sget_simple_extent_dims(space, array.shape.data(), nullptr);
    array.values.resize(H5Sget_simple_extent_npoints(space));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data());
    H5Sclose(space);
    H5Dclose(set);
    H5Fclose(file);
    return array;
}

/// Two nodes with a history, asked for every 0.5 into ASCII and binout.
testing::SnapshotFixture two_nodes()
{
    testing::SnapshotFixture fixture;
    fixture.model.title = "two nodes";
    fixture.model.nodes.id = {11, 12};
    fixture.model.nodes.position = {{0, 0, 0}, {1, 0, 0}};
    fixture.model.controls.output.history_nodes = {0, 1};
    OutputRequest request;
    request.interval = 0.5;
    request.binary = 3;
    fixture.model.controls.output.ascii["nodout"] = request;
    fixture.model.controls.output.ascii["glstat"] = request;
    fixture.start();
    fixture.clock.step = fixture.clock.last_step = 0.25;
    return fixture;
}

/// Runs the recorders as the loop does, `cycles` steps of 0.25.
void record(std::vector<std::unique_ptr<Recorder>>& recorders, testing::SnapshotFixture& fixture, int cycles)
{
    for (int cycle = 0; cycle < cycles; ++cycle) {
        for (auto& recorder : recorders) {
            if (fixture.clock.time + fixture.clock.step > recorder->next_time())
                recorder->write(fixture.snapshot());
        }
        fixture.state.position[1].x += 0.25;
        fixture.clock.time += 0.25;
        ++fixture.clock.cycle;
    }
}

/// Paths of the arrays as a reader finds them that walks the records from the first to the last and looks at
/// changes of the folder and data alone, not at tables (dynareadout is one).
std::vector<std::string> arrays_by_walking(const std::string& bytes)
{
    std::vector<std::string> found;
    std::string folder;
    for (std::size_t place = 8; place + 9 <= bytes.size();) {
        std::uint64_t length = 0;
        std::memcpy(&length, &bytes[place], 8);
        const int command = bytes[place + 8];
        const std::string content = bytes.substr(place + 9, length - 9);
        if (command == 2) folder = content;
        if (command == 3) {
            EXPECT_FALSE(folder.empty()) << "an array in no folder";
            found.push_back(folder + "/" + content.substr(2, static_cast<unsigned char>(content[1])));
        }
        place += length;
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

TEST(Lsda, HoldsWhatWasPutAndGrowsByWholeStates)
{
    const TemporaryFolder folder;
    const std::string path = folder / "binout0000";
    LsdaFile file{ResultPath(path)};
    const std::vector<double> values{1.5, -2.25, 1e300};
    file.folder("/a/metadata");
    file.put("title", std::string_view("bolt"));
    file.commit();
    const std::size_t after_first = read_lsda(bytes_of(path)).size();
    file.folder("/a/d000001");
    file.put("x", values);
    file.folder("/b/c/d000001");
    file.put_whole("cycle", 7);
    EXPECT_EQ(read_lsda(bytes_of(path)).size(), after_first); // not yet part of the file
    file.commit();
    auto arrays = read_lsda(bytes_of(path));
    EXPECT_EQ(arrays.size(), 3u);
    EXPECT_EQ(arrays["/a/metadata/title"].bytes, "bolt");
    EXPECT_EQ(arrays["/a/d000001/x"].reals(), values);
    EXPECT_EQ(arrays["/b/c/d000001/cycle"].wholes(), std::vector<long>{7});
    file.folder("/a/d000002");
    file.put("x", values);
    file.commit();
    EXPECT_EQ(arrays_by_walking(bytes_of(path)),
              (std::vector<std::string>{"/a/d000001/x", "/a/d000002/x", "/a/metadata/title",
                                        "/b/c/d000001/cycle"}));
}

TEST(Binout, HasTheStatesOfTheAsciiFilesAndTheHdf5HistoryToo)
{
    const TemporaryFolder folder;
    testing::SnapshotFixture fixture = two_nodes();
    auto recorders = make_recorders(fixture.model, folder.path().string());
    record(recorders, fixture, 5);
    for (auto& recorder : recorders) recorder->finish(fixture.snapshot());
    auto arrays = read_lsda(bytes_of(folder / "binout0000"));
    EXPECT_EQ(arrays["/nodout/metadata/ids"].wholes(), (std::vector<long>{11, 12}));
    // As the ASCII files: in the last cycle before 0.5 and 1.0 is passed.
    const std::vector<double> times{0, 0.5, 1};
    for (int state = 0; state < 3; ++state) {
        const std::string place = "/nodout/d00000" + std::to_string(state + 1);
        ASSERT_TRUE(arrays.contains(place + "/time")) << place;
        EXPECT_EQ(arrays[place + "/time"].reals(), std::vector<double>{times[state]});
        EXPECT_EQ(arrays[place + "/x_displacement"].reals(), (std::vector<double>{0, times[state]}));
    }
    EXPECT_FALSE(arrays.contains("/nodout/d000004/time"));
    EXPECT_TRUE(arrays.contains("/glstat/d000003/kinetic_energy"));
    EXPECT_TRUE(std::filesystem::exists(folder / "nodout"));

    const H5Array displacement = read_h5(folder / "history.h5", "/nodout/x_displacement");
    EXPECT_EQ(displacement.shape, (std::vector<hsize_t>{3, 2}));
    EXPECT_EQ(displacement.values, (std::vector<double>{0, 0, 0, 0.5, 0, 1}));
    EXPECT_EQ(read_h5(folder / "history.h5", "/nodout/time").values, times);
    EXPECT_EQ(read_h5(folder / "history.h5", "/nodout/ids").values, (std::vector<double>{11, 12}));
}

TEST(HistoryFile, FillsRowsUpThatHaveBecomeShorter)
{
    const TemporaryFolder folder;
    HistoryFile file{ResultPath(folder / "history.h5")};
    std::vector<double> values{1, 2, 3};
    std::vector<Id> ids{7, 8, 9};
    for (const char* state : {"/elout/shell/d000001", "/elout/shell/d000002"}) {
        file.folder(state);
        file.put("sig_xx", values);
        file.put("ids", ids);
        values.pop_back();
        ids.pop_back();
    }
    file.close();
    const H5Array stress = read_h5(folder / "history.h5", "/elout/shell/sig_xx");
    EXPECT_EQ(stress.shape, (std::vector<hsize_t>{2, 3}));
    EXPECT_EQ(stress.values[4], 2);
    EXPECT_TRUE(std::isnan(stress.values[5]));
    EXPECT_EQ(read_h5(folder / "history.h5", "/elout/shell/ids").values[5], -1);
}

} // namespace plash

/// Reads the results of a run with dynareadout (github.com/PucklaJ/dynareadout), a reader that is not
/// Plash's: every real number of binout against history.h5, and of d3plot the stresses, plastic strains and
/// strains (STRFLG) of the elements in elout, at the times that both have. Nothing of dynareadout is part of
/// Plash; build and run by hand:
///
///     gcc -O1 -w -DNO_THREAD_SAFETY -c -I CHECKOUT/src CHECKOUT/src/*.c
///     g++ -std=c++20 -DNO_THREAD_SAFETY -I CHECKOUT/src bench/check_dynareadout.cpp *.o $(pkg-config
///     --cflags --libs hdf5) -o check
///     ./check RESULTS
///
/// Prints how many numbers were compared and the largest difference over the largest number of a quantity.

#include <algorithm>
#include <array>
#include <binout.h>
#include <binout_defines.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <d3plot.h>
#include <hdf5.h>
#include <memory>
#include <string>
#include <vector>

namespace {

struct Difference {
    std::size_t count = 0;
    double largest = 0, of = 0;

    void add(double a, double b)
    {
        ++count;
        largest = std::max(largest, std::abs(a - b));
        of = std::max(of, std::abs(b));
    }
    void print(const std::string& what) const
    {
        std::printf("| %s | %zu | %.1e |\n", what.c_str(), count, of > 0 ? largest / of : largest);
    }
};

std::vector<double> history_array(hid_t file, const std::string& name)
{
    if (H5Lexists(file, name.substr(0, name.rfind('/')).c_str(), H5P_DEFAULT) <= 0 ||
        H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0)
        return {};
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<double> values(H5Sget_simple_extent_npoints(space));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
}

std::vector<std::string> children_of(binout_file& file, const std::string& path)
{
    std::size_t count = 0;
    char** children = binout_get_children(&file, path.c_str(), &count);
    std::vector<std::string> names(children, children + count);
    binout_free_children(children);
    return names;
}

/// A quantity over all states, one behind the other; empty when states differ in length.
std::vector<double> timed(binout_file& file, const std::string& variable, std::size_t* states = nullptr)
{
    std::size_t values = 0, times = 0;
    double* data = binout_read_timed_f64(&file, variable.c_str(), &values, &times);
    std::vector<double> result;
    if (data) result.assign(data, data + values * times);
    if (states) *states = times;
    std::free(data);
    return result;
}

/// Folders with states below `path`.
void compare_folder(binout_file& file, hid_t history, const std::string& path)
{
    const std::vector<std::string> names = children_of(file, path);
    const auto state = std::find(names.begin(), names.end(), "d000001");
    if (state == names.end()) {
        for (const std::string& name : names)
            if (name != "metadata") compare_folder(file, history, path + "/" + name);
        return;
    }
    Difference all;
    for (const std::string& name : children_of(file, path + "/d000001")) {
        if (binout_get_type_id(&file, (path + "/d000001/" + name).c_str()) != BINOUT_TYPE_FLOAT64) continue;
        const std::vector<double> read = timed(file, path + "/" + name);
        const std::vector<double> wanted = history_array(history, path + "/" + name);
        if (read.empty() || read.size() != wanted.size()) continue;
        for (std::size_t i = 0; i < read.size(); ++i) all.add(read[i], wanted[i]);
    }
    all.print("binout: " + path.substr(1));
}

constexpr const char* components[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

void add_tensor(Difference& difference, const d3plot_tensor& found, const std::array<double, 6>& wanted)
{
    const double values[] = {found.x, found.y, found.z, found.xy, found.yz, found.zx};
    for (int i = 0; i < 6; ++i) difference.add(values[i], wanted[i]);
}

/// Elements of elout in d3plot.
/// read   the tensors that d3plot has of element `index`: stress, then strains (one, or lower and upper)
template <class Read>
void compare_elements(binout_file& binout, d3plot_file& plot, const std::string& kind, const d3_word* ids,
                      std::size_t id_count, Read&& read)
{
    const std::string path = "/elout/" + kind;
    std::size_t states = 0;
    const std::vector<double> times = timed(binout, path + "/time", &states);
    if (states == 0) return;
    std::size_t count = 0, id_states = 0;
    std::int64_t* wanted = binout_read_timed_i64(&binout, (path + "/ids").c_str(), &count, &id_states);
    Difference stress, strain;
    std::size_t plot_states = 0;
    double* plot_times = d3plot_read_all_time(&plot, &plot_states);
    for (std::size_t state = 0; state < states; ++state) {
        std::size_t same = 0;
        while (same < plot_states &&
               std::abs(plot_times[same] - times[state]) > 1e-6 * (1e-12 + times[state]))
            ++same;
        if (same == plot_states) continue;
        for (std::size_t row = 0; row < count; ++row) {
            const std::size_t index = d3plot_index_for_id(wanted[state * count + row], ids, id_count);
            const std::size_t points = timed(binout, path + "/sig_xx").size() / states / count;
            const auto tensor = [&](const std::string& prefix, std::size_t entry, std::size_t entries) {
                std::array<double, 6> values{};
                for (int c = 0; c < 6; ++c) {
                    const auto all = timed(binout, path + "/" + prefix + components[c]);
                    if (!all.empty()) values[c] = all[state * entries + entry];
                }
                return values;
            };
            const std::vector<d3plot_tensor> found = read(same, index);
            // Shells: the lowest point, which d3plot calls the inner one.
            add_tensor(stress, found[0], tensor("sig_", row * points, count * points));
            if (found.size() == 2) add_tensor(strain, found[1], tensor("eps_", row, count));
            if (found.size() == 3) {
                add_tensor(strain, found[1], tensor("lower_eps_", row, count));
                add_tensor(strain, found[2], tensor("upper_eps_", row, count));
            }
        }
    }
    stress.print("d3plot: stresses of elout's " + kind + "s");
    strain.print("d3plot: strains of elout's " + kind + "s");
    std::free(wanted);
    std::free(plot_times);
}

} // namespace

int main(int count, char** arguments)
{
    if (count != 2) return std::fprintf(stderr, "usage: %s RESULTS\n", arguments[0]), 2;
    const std::string folder = arguments[1];
    binout_file binout = binout_open((folder + "/binout*").c_str());
    const hid_t history = H5Fopen((folder + "/history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    std::printf("| quantity | numbers | largest difference / largest number |\n|---|---|---|\n");
    for (const std::string& name : children_of(binout, "/")) compare_folder(binout, history, "/" + name);

    d3plot_file plot = d3plot_open((folder + "/d3plot").c_str());
    if (plot.error_string) return std::fprintf(stderr, "%s\n", plot.error_string), 1;
    std::size_t ids = 0;
    d3_word* numbers = d3plot_read_solid_element_ids(&plot, &ids);
    compare_elements(binout, plot, "solid", numbers, ids, [&](std::size_t state, std::size_t index) {
        std::size_t solids = 0;
        d3plot_solid* all = d3plot_read_solids_state(&plot, state, &solids);
        std::vector<d3plot_tensor> tensors{all[index].sigma, all[index].epsilon};
        std::free(all);
        return tensors;
    });
    std::free(numbers);
    numbers = d3plot_read_shell_element_ids(&plot, &ids);
    compare_elements(binout, plot, "shell", numbers, ids, [&](std::size_t state, std::size_t index) {
        std::size_t shells = 0;
        d3plot_shell* all = d3plot_read_shells_state(&plot, state, &shells);
        std::vector<d3plot_tensor> tensors{all[index].inner.sigma, all[index].inner_epsilon,
                                           all[index].outer_epsilon};
        d3plot_free_shells_state(all);
        return tensors;
    });
    std::free(numbers);
    d3plot_close(&plot);
    binout_close(&binout);
    H5Fclose(history);
}

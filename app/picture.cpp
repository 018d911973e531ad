#include "app/picture.h"

#include "app/commands.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plash {

namespace {

/// The program that draws. It stands beside this one; pictures have a program of their own because the
/// drawing library takes long to load and nobody else needs it.
std::string drawing_program()
{
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "plash-picture").string();
}

/// Becomes the program that draws.
int draw(std::vector<std::string> arguments)
{
    const std::string program = drawing_program();
    std::vector<char*> words = {const_cast<char*>(program.c_str())};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    fmt::print(stderr, "{} cannot be started: {}\n", program, std::strerror(errno));
    return 2;
}

/// Runs the program that draws and waits for it; false when it failed.
bool run_drawing_program(std::vector<std::string> arguments)
{
    std::string program = drawing_program();
    std::vector<char*> words = {program.data()};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_t child = 0;
    int status = 0;
    const int fault = posix_spawn(&child, program.c_str(), nullptr, nullptr, words.data(), environ);
    if (fault != 0) {
        fmt::print(stderr, "{} cannot be started: {}\n", program, std::strerror(fault));
        return false;
    }
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

bool draw_picture(const std::string& directory)
{
    return run_drawing_program({directory});
}

bool draw_diagrams(const std::string& file, const std::string& png)
{
    return run_drawing_program({file, "--diagrams", "-o", png, "--width", "1500"});
}

void add_picture(CLI::App& program, int& exit_code)
{
    CLI::App* command =
        program.add_subcommand("picture", "Draw a run's model at several times into one PNG file");
    command->set_help_flag(); // options, --help among them, are for the drawing program
    command->prefix_command();
    command->callback([command, &exit_code] { exit_code = draw(command->remaining()); });
}

} // namespace plash

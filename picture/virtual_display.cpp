#include "picture/virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace plash {

namespace {

/// Starts Xvfb on a display number of its own choice, which it writes into `number_pipe`; errors go nowhere.
[[noreturn]] void become_server(int number_pipe)
{
    const std::string pipe_name = std::to_string(number_pipe);
    std::freopen("/dev/null", "w", stderr);
    execlp("Xvfb", "Xvfb", "-displayfd", pipe_name.c_str(), "-screen", "0", "1280x1024x24", "-nolisten",
           "tcp", static_cast<char*>(nullptr));
    _exit(127);
}

/// What the server writes once it is ready; empty when it ends instead.
std::string read_line(int pipe)
{
    std::string line;
    char character = 0;
    while (read(pipe, &character, 1) == 1 && character != '\n') line += character;
    return line;
}

} // namespace

VirtualDisplay::VirtualDisplay()
{
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to be had for Xvfb");
    server_ = fork();
    if (server_ == 0) {
        close(ends[0]);
        become_server(ends[1]);
    }
    close(ends[1]);
    const std::string number = read_line(ends[0]);
    close(ends[0]);
    if (!number.empty()) {
        setenv("DISPLAY", (":" + number).c_str(), 1);
        return;
    }
    waitpid(server_, nullptr, 0);
    server_ = -1;
    if (!std::getenv("DISPLAY")) {
        throw std::runtime_error("pictures need an X server to draw on: install the package xvfb");
    }
}

VirtualDisplay::~VirtualDisplay()
{
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

} // namespace plash

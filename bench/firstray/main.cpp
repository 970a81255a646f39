#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "bench/firstray/command.h"

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return firstray::command::run(arguments, {std::cout, std::cerr, isatty(STDERR_FILENO) != 0});
}

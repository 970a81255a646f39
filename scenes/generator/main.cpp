#include <iostream>
#include <string>
#include <vector>

#include "scenes/generator/command.h"

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return firstray::scenes::run(arguments, std::cout, std::cerr);
}

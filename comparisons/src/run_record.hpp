#pragma once

#include "arguments.hpp"

#include <mpi.h>

#include <string>

namespace comparisons {

/// Versions of this program, the library, Zoltan and MPI, a line each.
std::string versions();

/// The words a program was started with.
std::string command_line(int argc, char** argv);

/// What is needed to repeat a run: versions, command, ranks, parameters of every method.
std::string run_record(const Arguments& arguments, const std::string& command, MPI_Comm comm);

/// What the columns of a table mean, in a few lines.
std::string definitions();

}  // namespace comparisons

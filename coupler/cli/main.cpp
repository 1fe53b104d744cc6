// dipper: the command. Exit status: 0 done; 2 bad usage or input; 3 a run failed; 4 interrupted.
#include <exception>

#include "common/input_error.hpp"
#include "coupler/cli/command_line.hpp"
#include "coupler/cli/console.hpp"
#include "coupler/cli/environment.hpp"

int main(int argc, char** argv) {
  dipper::cli::Console console;
  try {
    dipper::cli::read_environment();
    return dipper::cli::command_line({argv + 1, argv + argc}, console);
  } catch (const dipper::InputError& e) {
    console.error(e.what());
    return 2;
  } catch (const std::exception& e) {
    console.error(e.what());
    return 3;
  }
}

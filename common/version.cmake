# Writes OUT, the source of dipper::version(), when its contents change. Runs at every build.
#   cmake -D SOURCE=FOLDER -D VERSION=0.1.0 -D OUT=FILE -P version.cmake
cmake_minimum_required(VERSION 3.25)
set(text "${VERSION}")
# A tarball unpacked in another repository is not of that repository's commit.
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-prefix --short=7 HEAD
                OUTPUT_VARIABLE said RESULT_VARIABLE failed ERROR_QUIET)
if(NOT failed AND said MATCHES "^\n([0-9a-f]+)\n$")
  string(APPEND text "+g${CMAKE_MATCH_1}")
  execute_process(COMMAND git --no-optional-locks -C "${SOURCE}" status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    string(APPEND text ".dirty")
  endif()
endif()
file(CONFIGURE OUTPUT "${OUT}" @ONLY CONTENT
     "#include \"common/version.hpp\"

std::string dipper::version() { return \"@text@\"; }
")

# Writes OUT, the source of dipper::source_hash(), when its contents change. Runs at every build.
#   cmake -D SOURCE=FOLDER -D OUT=FILE -P source_hash.cmake
cmake_minimum_required(VERSION 3.25)
set(text "")
foreach(folder common machine analysis coupler dem mbs dem_in)
  file(GLOB_RECURSE files RELATIVE "${SOURCE}" "${SOURCE}/${folder}/*.cpp" "${SOURCE}/${folder}/*.hpp"
       "${SOURCE}/${folder}/*.h" "${SOURCE}/${folder}/*.in")
  list(SORT files)
  foreach(name IN LISTS files)
    file(SHA256 "${SOURCE}/${name}" hash)
    string(APPEND text "${name} ${hash}\n")
  endforeach()
endforeach()
string(SHA256 text "${text}")
file(CONFIGURE OUTPUT "${OUT}" @ONLY CONTENT
     "#include \"common/source_hash.hpp\"

std::string dipper::source_hash() { return \"@text@\"; }
")

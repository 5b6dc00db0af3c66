# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ source with the bytes of FILES (separated by |): a string literal could end too early, and
# configure_file() would change what looks like its own.
string(REPLACE "|" ";" files "${FILES}")
set(arrays "")
set(entries "")
set(number 0)
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char file_${number}[] = {${bytes}};\n")
  string(APPEND entries
         "    if (name == \"${name}\")\n"
         "        return {reinterpret_cast<const char*>(file_${number}), sizeof file_${number}};\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT}
"// Written by embed.cmake.
#include <stdexcept>
#include <string>
#include <string_view>

namespace spam::view {

${arrays}
std::string_view embedded(std::string_view name);
std::string_view embedded(std::string_view name) {
${entries}    throw std::out_of_range(std::string(name));
}

}  // namespace spam::view
")

# Most of the compilers' time goes into Eigen's, pybind11's and OpenCASCADE's headers, and into the templates that every
# file makes anew. So a folder is compiled as one unit, whose text is a list of #include: 2 to 4 times as fast in all.
option(MPM_UNITY "Compile the files of a folder as one unit" ON)

# mpm_units(TARGET BASE FILE... [ALONE FILE...]) gives the files to TARGET, those of a folder as one unit. BASE: the
# include directory that the files lie below. ALONE: files whose unnamed namespace clashes with their neighbours', with
# one of a whole class, say; constants better get a telling name.
#
# The files one by one are the target TARGET_files. It is never built unasked: it is what compile_commands.json tells
# clang-tidy and editors, and what finds a missing #include.
function(mpm_units target base)
  cmake_parse_arguments(PARSE_ARGV 2 MPM "" "" "ALONE")
  set(files ${MPM_UNPARSED_ARGUMENTS})
  add_library(${target}_files OBJECT EXCLUDE_FROM_ALL ${files})
  target_include_directories(${target}_files PRIVATE ${base})
  if(NOT MPM_UNITY)
    target_sources(${target} PRIVATE ${files})
    return()
  endif()
  set(folders "")
  foreach(file IN LISTS files)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${base} OUTPUT_VARIABLE name)
    if(name IN_LIST MPM_ALONE)
      target_sources(${target} PRIVATE ${file})
      continue()
    endif()
    cmake_path(GET name PARENT_PATH folder)
    list(APPEND folders ${folder})
    string(APPEND text_of_${folder} "#include \"${name}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    set(unit ${CMAKE_CURRENT_BINARY_DIR}/units/${folder}.cpp)
    file(CONFIGURE OUTPUT ${unit} CONTENT "${text_of_${folder}}" @ONLY)
    target_sources(${target} PRIVATE ${unit})
  endforeach()
  target_include_directories(${target} PRIVATE ${base})
  set_target_properties(${target} PROPERTIES EXPORT_COMPILE_COMMANDS OFF)
endfunction()
